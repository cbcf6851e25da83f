"""Numbers, text, arrays and records as bytes and back, equal in every bit; hashes of content."""

import hashlib
import json
import math
from collections.abc import Callable
from dataclasses import fields, is_dataclass
from importlib import import_module
from io import BytesIO
from itertools import chain
from typing import Any, BinaryIO, Final

import numpy as np


def canonical_json(value: Any) -> str:
    """ASCII JSON with sorted keys: the same text for the same content."""
    return json.dumps(value, sort_keys=True, separators=(",", ":"), allow_nan=False)


def sha256(content: bytes) -> str:
    """SHA-256 of the content, in hexadecimal."""
    return hashlib.sha256(content).hexdigest()


def file_sha256(file: BinaryIO) -> str:
    """SHA-256 of the rest of an open file, in hexadecimal."""
    return hashlib.file_digest(file, "sha256").hexdigest()  # type: ignore[arg-type]


_OF_JSON: Final = (type(None), bool, int, float, str)
_KINDS: Final[dict[str, Callable[[list[Any]], Any]]] = {
    "list": list,
    "tuple": tuple,
    "complex": lambda parts: complex(*parts),
    "dict": lambda parts: dict(zip(parts[::2], parts[1::2], strict=True)),
}
_NUMBERS: Final = "biufcUS"
"""Kinds of arrays: numbers and text, no objects."""


def to_bytes(value: Any) -> bytes:
    """Return a value as bytes.

    Parameters
    ----------
    value : numbers, text, arrays, None, and lists, tuples, dicts and records of them
    """
    arrays: list[bytes] = []
    text = json.dumps(_plain(value, arrays), separators=(",", ":"))
    return b"".join([text.encode(), b"\n", *arrays])


def from_bytes(content: bytes) -> Any:
    """Return the value of `to_bytes`."""
    stream = BytesIO(content)
    return _value(json.loads(stream.readline()), stream)


def _plain(value: Any, arrays: list[bytes]) -> Any:
    """Return the JSON form of a value; the content of its arrays is appended to a list."""
    kind, name = type(value), type(value).__name__
    if kind in _OF_JSON:
        return value
    if isinstance(value, np.generic) or kind is np.ndarray:
        _check(value.dtype)
        order = "F" if value.flags.f_contiguous and not value.flags.c_contiguous else "C"
        arrays.append(value.tobytes(order))
        return ["array", kind is np.ndarray, value.dtype.str, order, *value.shape]
    if kind in (list, tuple):
        parts = value
    elif kind is dict:
        parts = chain.from_iterable(value.items())
    elif kind is complex:
        parts = value.real, value.imag
    else:
        name = f"{kind.__module__}:{kind.__qualname__}"
        parts = [getattr(value, field) for field in _field_names(kind)]
    return [name, *(_plain(part, arrays) for part in parts)]


def _value(plain: Any, stream: BytesIO) -> Any:
    """Return the value of a JSON form; arrays are read from a stream in their order."""
    if type(plain) is not list:
        return plain
    name, *parts = plain
    if name == "array":
        is_array, type_name, order, *shape = parts
        _check(dtype := np.dtype(type_name))
        content = stream.read(dtype.itemsize * math.prod(shape))
        array: Any = np.ndarray(shape, dtype, content, order=order).copy(order)
        return array if is_array else array[()]
    values = [_value(part, stream) for part in parts]
    return _KINDS[name](values) if name in _KINDS else _record(name, values)


def _check(dtype: np.dtype[Any]) -> None:
    if dtype.kind not in _NUMBERS:
        raise TypeError(f"array of {dtype}: cannot be stored")


def _record(name: str, values: list[Any]) -> Any:
    module, _, qualified_name = name.partition(":")
    if not module.startswith(f"{__package__.partition('.')[0]}."):
        raise TypeError(f"{name}: cannot be read")
    kind = getattr(import_module(module), qualified_name)
    named = zip(_field_names(kind), values, strict=True)
    if issubclass(kind, tuple):
        return tuple.__new__(kind, [value for _, value in named])
    record = object.__new__(kind)
    for field, value in named:
        object.__setattr__(record, field, value)
    return record


def _field_names(kind: Any) -> list[str]:
    """Return the names of the fields of a class of records of this package."""
    if kind.__module__.startswith(f"{__package__.partition('.')[0]}."):
        if isinstance(kind, type) and is_dataclass(kind):
            return [field.name for field in fields(kind)]
        if isinstance(kind, type) and issubclass(kind, tuple):
            return list(kind._fields)  # type: ignore[attr-defined]
    raise TypeError(f"{kind.__module__}.{kind.__qualname__}: cannot be stored")
