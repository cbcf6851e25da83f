"""One fence around third parties' code: a failure is one line, a value has the type asked for."""

import dataclasses
import inspect
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dis import opmap
from functools import cache, wraps
from numbers import Real
from pathlib import Path
from traceback import walk_tb
from types import FunctionType, NoneType, UnionType
from typing import Annotated, Any, ClassVar, Final, Union, get_args, get_origin, get_type_hints

import numpy as np

from .errors import ParameterError, StorageError
from .fault import FaultError, Owner, cut

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


REFUSALS: Final = (ParameterError, StorageError)
"""Errors by which a plug-in refuses a value or a file of the user; they are not its faults."""


@contextmanager
def fence(owner: Owner, passing: tuple[type[Exception], ...] = ()) -> Iterator[None]:
    """Turn whatever a plug-in raises into a `FaultError`, `sys.exit` too; errors may pass, cut.

    A signal that ends the program while the plug-in's code runs is no fault of it.

    Raises
    ------
    FaultError
        The code raised anything else.
    """
    try:
        yield
    except FaultError:
        raise
    except passing as error:
        raise type(error)(*map(cut, map(str, error.args))) from None
    except BaseException as error:
        if not isinstance(error, Exception | SystemExit) and not _is_raised(owner, error):
            raise
        raise FaultError.at_line(owner, _line(owner, error), _words(error)) from error


def _is_raised(owner: Owner, error: BaseException) -> bool:
    """Whether a `raise` of the plug-in's file raised an error, and no signal that came there."""
    trace = error.__traceback__
    while trace is not None and trace.tb_next is not None:
        trace = trace.tb_next
    if trace is None or not _is_of(owner, trace.tb_frame.f_code.co_filename):
        return False
    return trace.tb_frame.f_code.co_code[trace.tb_lasti] == opmap["RAISE_VARARGS"]


def fenced(thing: Any, base: type, owner: Owner) -> None:
    """Put the fence around the methods of a class, or the functions of an object, in place.


    Raises
    ------
    PluginError
        The thing has no method where it needs one, or an attribute of the wrong type.
    """
    _check_attributes(thing, base, owner)
    if not isinstance(thing, type):
        for name, function in vars(thing).items():
            if callable(function):
                object.__setattr__(thing, name, _guarded(function, base, name, owner))
        return
    for name, verb in vars(base).items():
        if name.startswith("_") or not isinstance(verb, FunctionType | classmethod | property):
            continue
        defined = inspect.getattr_static(thing, name)
        if isinstance(defined, FunctionType):
            setattr(thing, name, _guarded(defined, base, name, owner))
        elif isinstance(defined, classmethod | staticmethod):
            setattr(thing, name, type(defined)(_guarded(defined.__func__, base, name, owner)))
        elif isinstance(defined, property) and defined.fget is not None:
            setattr(thing, name, property(_guarded(defined.fget, base, name, owner)))
        elif isinstance(verb, FunctionType) and not callable(defined):
            raise FaultError.at_line(owner, _first_line(thing), f"{name} is no method")


def _check_attributes(thing: Any, base: type, owner: Owner) -> None:
    """Refuse attributes that are not of the types that the base declares."""
    for name, hint in attribute_hints(base).items():
        reason = misfit(getattr(thing, name, None), hint)
        if reason:
            raise FaultError.at_line(owner, _first_line(thing), f"{name} is {reason}")


def _guarded(
    function: Callable[..., Any], base: type, name: str, owner: Owner
) -> Callable[..., Any]:
    """Return a function within the fence, whose results are checked."""
    if hasattr(function, "inside_fence"):
        return function

    @wraps(function)
    def guarded(*positional: Any, **named: Any) -> Any:
        with fence(owner, REFUSALS):
            result = function(*positional, **named)
            if inspect.isgenerator(result):
                result = tuple(result)
            reason = misfit(result, result_hint(base, name))
            if reason:
                raise FaultError.at_line(owner, _first_line(function), f"{name} returns {reason}")
            return result

    guarded.inside_fence = True  # type: ignore[attr-defined]
    return guarded


def _words(error: BaseException) -> str:
    """Return the kind of an error and its text, which may fail itself."""
    try:
        return f"{type(error).__name__}: {error}".removesuffix(": ")
    except Exception:
        return type(error).__name__


def _line(owner: Owner, error: BaseException) -> int | None:
    """Return the innermost line of the plug-in's file that an error comes from."""
    if isinstance(error, SyntaxError) and error.filename and _is_of(owner, error.filename):
        return error.lineno
    lines = [
        number
        for frame, number in walk_tb(error.__traceback__)
        if _is_of(owner, frame.f_code.co_filename)
    ]
    return lines[-1] if lines else _first_line(owner.thing)


def _is_of(owner: Owner, filename: str) -> bool:
    return Path(filename).name == owner.file


def _first_line(thing: Any) -> int | None:
    """Return the line at which a class or function begins."""
    defined = vars(thing).values() if hasattr(thing, "__dataclass_fields__") else ()
    functions = [getattr(entry, "__wrapped__", entry) for entry in defined if callable(entry)]
    try:
        return inspect.getsourcelines(functions[0] if functions else thing)[1]
    except (OSError, TypeError):
        return None
