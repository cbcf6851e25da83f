"""Numbers, text, arrays and records of this package as bytes and back, equal in every bit.

Bytes are a JSON text and the arrays behind it. Reading them calls no code that they name: a record
is a dataclass or a named tuple of this package, whose fields are set without its constructor.
"""

import json
import math
import sys
from dataclasses import fields, is_dataclass
from importlib import import_module
from io import BytesIO
from typing import Any, Final

import numpy as np

from .arrays import Array

_PACKAGE: Final = __package__.partition(".")[0]
_SELF_EVIDENT: Final = (type(None), bool, int, float, str)
"""Types that JSON gives back."""
_NUMBERS: Final = "biufcUS"
"""Kinds of arrays: numbers and text, no objects."""
_LENGTH: Final = 8


def to_bytes(value: Any) -> bytes:
    """Return a value as bytes.

    Parameters
    ----------
    value : numbers, text, arrays, None, and lists, tuples, dicts, dataclasses and named tuples of
        them, at any depth

    Raises
    ------
    TypeError
        Something in it is of another type.
    """
    arrays: list[bytes] = []
    text = json.dumps(_plain(value, arrays), separators=(",", ":")).encode()
    return b"".join([len(text).to_bytes(_LENGTH, "little"), text, *arrays])


def from_bytes(content: bytes) -> Any:
    """Return the value of `to_bytes`.

    Raises
    ------
    ValueError
        The bytes are no such value.
    """
    stream = BytesIO(content)
    try:
        text = stream.read(int.from_bytes(stream.read(_LENGTH), "little"))
        return _value(json.loads(text), stream)
    except (TypeError, LookupError, AttributeError, ImportError) as error:
        raise ValueError(f"no stored value: {error}") from None


def _plain(value: Any, arrays: list[bytes]) -> Any:
    """Return the JSON form of a value; the content of its arrays is appended to a list."""
    kind = type(value)
    if kind in _SELF_EVIDENT:
        return value
    if kind is complex:
        return ["complex", value.real, value.imag]
    if kind in (list, tuple):
        return [kind.__name__, *(_plain(part, arrays) for part in value)]
    if kind is dict:
        pairs = value.items()
        return ["dict", *([_plain(key, arrays), _plain(part, arrays)] for key, part in pairs)]
    if (kind is np.ndarray or isinstance(value, np.generic)) and value.dtype.kind in _NUMBERS:
        order = "F" if value.flags.f_contiguous and not value.flags.c_contiguous else "C"
        arrays.append(value.tobytes(order))
        name = "array" if kind is np.ndarray else "scalar"
        return [name, value.dtype.str, list(value.shape), order]
    names = _field_names(kind)
    return [
        f"{kind.__module__}:{kind.__qualname__}",
        *(_plain(getattr(value, name), arrays) for name in names),
    ]


def _value(plain: Any, stream: BytesIO) -> Any:
    """Return the value of a JSON form; arrays are read from a stream in their order."""
    if type(plain) is not list:
        return plain
    name, *parts = plain
    if name == "complex":
        return complex(*parts)
    if name == "dict":
        return {_value(key, stream): _value(part, stream) for key, part in parts}
    if name in ("array", "scalar"):
        array = _array(stream, *parts)
        return array if name == "array" else array[()]
    values = [_value(part, stream) for part in parts]
    sequence = {"list": list, "tuple": tuple}.get(name)
    return sequence(values) if sequence else _record(name, values)


def _array(stream: BytesIO, type_name: str, shape: list[int], order: Any) -> Array:
    dtype = np.dtype(type_name)
    if dtype.kind not in _NUMBERS:
        raise ValueError(f"no stored array: {type_name}")
    content = stream.read(dtype.itemsize * math.prod(shape))
    array: Array = np.empty(shape, dtype, order)
    array[...] = np.ndarray(shape, dtype, content, order=order)
    return array


def _record(name: str, values: list[Any]) -> Any:
    """Make a record without a call of its constructor."""
    module, _, qualified = name.partition(":")
    if not module.startswith(f"{_PACKAGE}."):
        raise ValueError(f"no record of this package: {name}")
    import_module(module)
    kind: Any = getattr(sys.modules[module], qualified)
    names = _field_names(kind)
    if len(names) != len(values):
        raise ValueError(f"another record: {name}")
    if issubclass(kind, tuple):
        return tuple.__new__(kind, values)
    record = object.__new__(kind)
    for field, value in zip(names, values, strict=True):
        object.__setattr__(record, field, value)
    return record


def _field_names(kind: type) -> list[str]:
    """Return the names of the fields of a class of records.

    Raises
    ------
    TypeError
        It is none of this package.
    """
    if kind.__module__.startswith(f"{_PACKAGE}.") and isinstance(kind, type):
        if is_dataclass(kind):
            return [field.name for field in fields(kind)]
        if issubclass(kind, tuple) and hasattr(kind, "_fields"):
            return list(kind._fields)
    raise TypeError(f"{kind.__module__}.{kind.__qualname__}: cannot be stored")
