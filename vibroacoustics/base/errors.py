"""Errors that a user can act on. Each message is one clear line; all of a file come at once."""

from collections.abc import Callable, Iterable
from typing import Final, TypeVar

from .refusal import reworded

Item = TypeVar("Item")
Result = TypeVar("Result")
LONGEST_LINE: Final = 300


class VibroacousticsError(Exception):
    """Base of every error raised on purpose; the command line prints it and exits with code 2.

    Examples
    --------
    >>> try:
    ...     va.load_study("missing.toml")
    ... except va.VibroacousticsError as error:
    ...     print(error)
    missing.toml: no such file
    """

    def __init__(self, *messages: str) -> None:
        # names and values may hold line breaks
        super().__init__(*(reworded(each, " ".join(each.splitlines())) for each in messages))

    def __str__(self) -> str:
        return "\n".join(map(str, self.args))


class ParameterError(VibroacousticsError):
    """An input value is missing, unknown, of the wrong type or outside its allowed range.

    Examples
    --------
    >>> va.NominalSpeed(-1.0)
    Traceback (most recent call last):
        ...
    vibroacoustics.base.errors.ParameterError: speed_rpm = -1 rpm: must be 0.1 to 1e+06 rpm
    """

    def __init__(self, *messages: str) -> None:
        super().__init__(*map(shortened, messages))


class PlatformError(VibroacousticsError):
    """The operating system, or what it allows this process, is not enough.

    Examples
    --------
    >>> from vibroacoustics.base.posix import check_memory
    >>> check_memory(700_000_000)  # no limit is set, or a higher one
    """


class SchemaError(VibroacousticsError):
    """A variable left a stage with the wrong dimensions or unit.

    Examples
    --------
    >>> va.stamp("warmth", 1.0)
    Traceback (most recent call last):
        ...
    vibroacoustics.base.errors.SchemaError: variable warmth is not in the vocabulary
    """


class SolverError(VibroacousticsError):
    """A computation did not converge or gave values that cannot be right.

    Examples
    --------
    >>> time = np.arange(4096) / 1024.0
    >>> recording = va.label_recording([np.cos(300.0 * time)], 1024.0, ["ring"], ["m/s²"])
    >>> va.track_orders(recording, va.NominalSpeed(3000.0), [1.0, 1.001], bandwidth_hz=2.0)
    Traceback (most recent call last):
        ...
    vibroacoustics.base.errors.SolverError: recording: track 0 (order 1, 50 Hz) and track 1 ...
    """


class StorageError(VibroacousticsError):
    """A file cannot be read or written, or its content does not match its hash.

    Examples
    --------
    >>> va.open_results("missing.nc")
    Traceback (most recent call last):
        ...
    vibroacoustics.base.errors.StorageError: ...missing.nc...
    """


class PluginError(VibroacousticsError):
    """A third party's option, machine, criterion, section or column is refused.

    Examples
    --------
    >>> va.register("a word")
    Traceback (most recent call last):
        ...
    vibroacoustics.base.errors.PluginError: 'a word': is none of ...
    """


def gathered(function: Callable[[Item], Result], items: Iterable[Item]) -> list[Result]:
    """Results of a function for all items; one error has the lines of all items that fail.

    Raises
    ------
    VibroacousticsError
        An item fails; a ParameterError where items fail by errors of several types.
    """
    results: list[Result] = []
    errors: list[VibroacousticsError] = []
    for item in items:
        try:
            results.append(function(item))
        except VibroacousticsError as error:
            errors.append(error)
    if len(errors) == 1:
        raise errors[0]
    if errors:
        kinds = {type(error) for error in errors}
        kind = kinds.pop() if len(kinds) == 1 else ParameterError
        raise kind(*dict.fromkeys(line for error in errors for line in error.args))
    return results


def shortened(line: str, most: int = LONGEST_LINE) -> str:
    """Return a line of at most some characters: its begin with the file's name, and its end.

    Both parts end at a space where one is near.
    """
    if len(line) <= most:
        return line
    length = 2 * most // 3
    begin, end = line[:length], line[length + 3 - most :]
    cut, start = begin.rfind(" ", length - 40), end.find(" ", 0, 40)
    return reworded(line, f"{begin[:cut] if cut > 0 else begin} … {end[start + 1 :]}")
