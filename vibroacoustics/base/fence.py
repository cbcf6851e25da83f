"""One fence around third parties' code: what fails in it becomes one line with file and line.

`registry` puts it around every method and function of a thing that is not built in.
"""

import inspect
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dis import opmap
from functools import wraps
from pathlib import Path
from traceback import walk_tb
from types import FunctionType
from typing import Any, Final

from .errors import ParameterError, StorageError
from .fault import FaultError, Owner, cut
from .fitting import attribute_hints, misfit, result_hint

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
