"""Whether what a third party's code returns is of the type that is asked for, and finite."""

import dataclasses
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cache
from numbers import Real
from types import NoneType, UnionType
from typing import Annotated, Any, ClassVar, Final, Union, get_args, get_origin, get_type_hints

import numpy as np

MAY_BE_MISSING: Final = "figures"
"""Field whose values may be not a number: a reported figure that there is none of."""


@cache
def result_hint(base: type, name: str) -> Any:
    """Return the type that a method, property or function of a class gives by its annotation."""
    declared = vars(base).get(name)
    try:
        if declared is None or name in getattr(base, "__dataclass_fields__", ()):
            return get_args(get_type_hints(base)[name])[-1]
        function = getattr(declared, "fget", None) or getattr(declared, "__func__", declared)
        return get_type_hints(function).get("return", Any)
    except (NameError, KeyError, IndexError):
        return Any


@cache
def attribute_hints(base: type) -> dict[str, Any]:
    """Return the types of the attributes that a class declares, but not of functions in them."""
    try:
        hints = get_type_hints(base)
    except NameError:
        return {}
    declared = {name: hints[name] for name in vars(base).get("__annotations__", {})}
    if not dataclasses.is_dataclass(base):
        declared = {
            name: get_args(entry)[0]
            for name, entry in declared.items()
            if get_origin(entry) is ClassVar
        }
    return {name: entry for name, entry in declared.items() if get_origin(entry) is not Callable}


def misfit(value: Any, hint: Any, location: str = "") -> str:
    """Return why a value does not fit an annotation; empty where it does."""
    origin, arguments = get_origin(hint), get_args(hint)
    if origin is Annotated:
        return misfit(value, arguments[0], location)
    if origin in (Union, UnionType):
        reasons = [misfit(value, entry, location) for entry in arguments]
        return "" if "" in reasons else _of_union(value, arguments, reasons, location)
    wanted = NoneType if hint is None else origin or hint
    if not isinstance(wanted, type):
        return ""
    if not _is(value, wanted):
        return f"{_kind(value)}{location}, must be {getattr(wanted, '__name__', wanted)}"
    return _misfit_of_parts(value, arguments, location)


def _of_union(value: Any, hints: Sequence[Any], reasons: Sequence[str], location: str) -> str:
    """Return the reason of the alternative that the value is of; else all that are allowed."""
    for entry, reason in zip(hints, reasons, strict=True):
        wanted = get_origin(entry) or entry
        if isinstance(wanted, type) and _is(value, wanted):
            return reason
    allowed = " or ".join(
        getattr(get_origin(entry) or entry, "__name__", str(entry)) for entry in hints
    )
    return f"{_kind(value)}{location}, must be {allowed}"


def _is(value: Any, wanted: type) -> bool:
    """Whether a value is of a class; numbers and sequences by what they can do."""
    if wanted is float:
        return isinstance(value, Real) and not isinstance(value, bool | np.bool_)
    if wanted is bool:
        return isinstance(value, bool | np.bool_)
    if wanted in (tuple, Sequence, Iterable):
        return isinstance(value, Iterable) and not isinstance(value, str | bytes | Mapping)
    try:
        return isinstance(value, wanted)
    except TypeError:  # a protocol
        return True


def _misfit_of_parts(value: Any, arguments: Sequence[Any], location: str) -> str:
    """Return why a part of a value does not fit."""
    may_be_missing = location.endswith(f" in {MAY_BE_MISSING}")
    if isinstance(value, np.ndarray | float | np.number):
        return _of_numbers(np.asarray(value), location, may_be_missing)
    if isinstance(value, Mapping):
        parts = [(entry, arguments[-1], location) for entry in value.values()] if arguments else []
    elif isinstance(value, tuple | list) and not hasattr(value, "_fields"):
        parts = [(entry, arguments[0], location) for entry in value] if arguments else []
    elif dataclasses.is_dataclass(value) or hasattr(value, "_fields"):
        hints = _hints(value.__class__)
        parts = [(getattr(value, name), hint, f" in {name}") for name, hint in hints.items()]
    else:
        return ""
    return next(filter(None, (misfit(*part) for part in parts)), "")


def _of_numbers(numbers: Any, location: str, may_be_missing: bool) -> str:
    if numbers.dtype.kind not in "biufc":
        return f"no numbers{location}"
    if np.isinf(numbers).any() or (np.isnan(numbers).any() and not may_be_missing):
        return f"numbers that are not finite{location}"
    return ""


@cache
def _hints(kind: Any) -> dict[str, Any]:
    """Annotations of the fields of a dataclass or named tuple; none where they cannot be read."""
    try:
        return get_type_hints(kind)
    except NameError:
        return {}


def _kind(value: Any) -> str:
    return "None" if value is None else f"a {type(value).__name__}"
