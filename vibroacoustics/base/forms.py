"""Whether a value that was read has the type that a function is annotated to return."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import is_dataclass
from types import UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin, get_type_hints

import numpy as np


def returned(function: Callable[..., Any]) -> Any:
    """Type that a function is annotated to return; `Any` where it is not known."""
    try:
        return get_type_hints(function, include_extras=True).get("return", Any)
    except (NameError, TypeError):  # names for type checkers alone, or no function
        return Any


def has_form(value: Any, form: Any) -> bool:
    """Whether a value is of a type, with all that it holds: kinds of arrays, fields of records.

    Examples
    --------
    >>> from vibroacoustics.base.forms import has_form
    >>> has_form((1.0, "a"), tuple[float, str]), has_form([1.0], list[str])
    (True, False)
    """
    origin, parts = get_origin(form), get_args(form)
    if origin in (Union, UnionType):
        return any(has_form(value, part) for part in parts)
    if origin is Annotated:
        if np.floating in parts[1:]:
            return isinstance(value, np.ndarray) and np.issubdtype(value.dtype, np.floating)
        return has_form(value, parts[0])
    if origin is Literal:
        return value in parts
    return _is_of(value, form) if origin is None else _has_parts(value, origin, parts)


def _is_of(value: Any, form: Any) -> bool:
    """Whether a value is of a class without parts, and its fields, if any, of theirs."""
    if form is Any or not isinstance(form, type):  # such as a variable of types
        return True
    if form is float:
        return isinstance(value, int | float) and not isinstance(value, bool)
    is_record = is_dataclass(form) or hasattr(form, "_fields")
    fields = _fields(form) if is_record else {}
    return isinstance(value, form) and all(
        has_form(getattr(value, name, None), part) for name, part in fields.items()
    )


def _fields(form: type) -> dict[str, Any]:
    try:
        return get_type_hints(form, include_extras=True)
    except NameError:
        return {}


def _has_parts(value: Any, origin: Any, parts: tuple[Any, ...]) -> bool:
    """Whether a container, or an array, holds what its type says."""
    if origin is np.ndarray:
        (kind,) = get_args(parts[1]) or (Any,)
        kind = get_origin(kind) or kind
        return isinstance(value, np.ndarray) and (kind is Any or np.issubdtype(value.dtype, kind))
    if origin is tuple and parts[-1:] != (...,):
        return (
            isinstance(value, tuple)
            and len(value) == len(parts)
            and all(map(has_form, value, parts))
        )
    if issubclass(origin, Mapping):
        return isinstance(value, dict) and all(
            has_form(key, parts[0]) and has_form(each, parts[1]) for key, each in value.items()
        )
    if issubclass(origin, Sequence) or origin is tuple:
        return isinstance(value, list | tuple) and all(has_form(each, parts[0]) for each in value)
    return True
