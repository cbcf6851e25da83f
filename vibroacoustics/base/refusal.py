"""Lines of errors with their parts: file, field, value, unit and allowed range.

Who builds a line from its parts keeps them in a `Refusal`; the parts of another line are read from
its words, which have the form `file: field = value unit: reason; allowed range`.
"""

import re
from math import isfinite
from typing import Any, Final, NamedTuple, Self

_SUFFIXES: Final = (
    "toml|nc|csv|txt|json|py|html|md|pdf|svg|log|wav|flac|uff|unv|lvm|tdms|mat|npz|npy|h5|hdf5?"
    "|asc|dat|xlsx|stl|pem|bin|sha256"
)
_FILE: Final = re.compile(rf"(?!--)((?:(?! = ).)+?\.(?:{_SUFFIXES})): (.*)", re.IGNORECASE)
_PATH: Final = re.compile(r"(?!--|\w+ \w+://)([^=]*?/[^=:]*): (.*)")
_LOST: Final = re.compile(
    r"(?!--)([^:=]+): ((?:no such file|cannot be (?:read|written)|is no.? ).*)"
)
"""Name of any form, by what is said of it."""
_NUMBER: Final = r"[-+]?\d+\.?\d*(?:e[-+]?\d+)?"
_UNIT: Final = r"[A-Za-zµ°%Ω][\w/().²³µ·^-]*(?: [\w/().²³µ·^-]+){0,2}"
_QUOTED: Final = r"'(?:[^'\\]|\\.)*'|\"(?:[^\"\\]|\\.)*\""
_FIELD: Final = r"--[\w-]+(?:, \w+)?|(?:[\w*+\[\]-]|\"[^\"]*\"|\.(?! ))+"
_VALUE: Final = rf"(?:{_QUOTED}|\[[^\]]*\]|\{{[^}}]*\}}|[^:]|:(?! ))+?"
_EQUALS: Final = re.compile(
    rf"(?:({_FIELD}): )?({_FIELD}|[a-z]+ [a-z]+) = ({_VALUE})"
    rf"(?:,? (?:to )?[\w. ]+ = {_VALUE})?(?:: (.*)|$)"
)
"""Also two fields that contradict each other; the first is the one that is named."""
_NAMED: Final = re.compile(
    rf"(--[\w-]+|[A-Z]+|(?!line |row )[a-z_]+) ({_QUOTED}|{_NUMBER}(?: {_UNIT})?): (.*)"
)
_BARE: Final = re.compile(rf"({_FIELD}): (.*)")
_OPTION: Final = re.compile(r"(--[\w-]+) (.+?): (.*)")
_MEASURED: Final = re.compile(rf"({_NUMBER}|{_QUOTED}|\[.*\])(?: ({_UNIT}))?")
_ALLOWED: Final = (
    re.compile(r"\ballowed(?: are)? (.+?)(?:; |: |$)"),
    re.compile(r"\bmust be (.+?)(?:; |: |$)"),
    re.compile(r"\boutside its own range (.+?)(?:; |$)"),
)


class Parts(NamedTuple):
    """Subject of an error; None where a part does not apply or is not known.

    Attributes
    ----------
    file : file, as it was named
    field : key of the file, dotted, or option of the command line
    value : value as written
    unit : unit of the value
    allowed : range or choice, in the unit of the value
    """

    file: str | None = None
    field: str | None = None
    value: float | str | None = None
    unit: str | None = None
    allowed: str | None = None


class Refusal(str):
    """Line of an error that has kept its parts."""

    __slots__ = ("parts",)
    parts: Parts

    def __new__(cls, line: str, parts: Parts = Parts()) -> Self:  # noqa: B008 - a tuple
        """Return a line with its parts."""
        refusal = super().__new__(cls, line)
        refusal.parts = parts
        return refusal

    def reworded(self, line: str) -> "Refusal":
        """Return another line with the same parts."""
        return Refusal(line, self.parts)


def reworded(line: str, words: str) -> str:
    """Return other words of a line, with its parts where it has kept them."""
    return line.reworded(words) if isinstance(line, Refusal) else words


def refusal(
    file: object, field: str, reason: str, value: Any = None, unit: str = "", allowed: str = ""
) -> Refusal:
    """Build the line `file: field = value unit: reason; allowed range unit`.

    Parameters
    ----------
    file : path as it was named
    field : dotted key; empty where the line is about the whole file
    reason : fault in words
    value : value as written; None where there is none
    unit : unit of value and range
    allowed : range or choice
    """
    head = ": ".join(filter(None, (str(file), field)))
    shown = "" if value is None else f" = {_short(value)}"
    symbol = f" {unit}" if unit else ""
    limits = f"{allowed}{symbol}" if allowed else ""
    line = f"{head}{shown}{symbol if shown else ''}: {reason}{f'; allowed {limits}' * bool(limits)}"
    parts = Parts(str(file), field or None, _cell(value), unit or None, limits or None)
    return Refusal(line, parts if limits else parts._replace(allowed=_allowed(reason)))


def parts_of(line: str) -> Parts:
    """Parts of a line; those that it has not kept are read from its words.

    Examples
    --------
    >>> from vibroacoustics.base.refusal import parts_of
    >>> parts_of("a.toml: feet.mass_kg = -1 kg: must be 0 to 9 kg")
    Parts(file='a.toml', field='feet.mass_kg', value=-1.0, unit='kg', allowed='0 to 9 kg')
    """
    if isinstance(line, Refusal):
        return line.parts
    file, words = None, str(line)
    for pattern in (_FILE, _PATH, _LOST):
        if match := pattern.fullmatch(words):
            file, words = match.groups()
            break
    return _of_words(words)._replace(file=file)


def _of_words(words: str) -> Parts:
    """Parts of a line without its file."""
    if match := _EQUALS.fullmatch(words):
        table, key, value, reason = match.groups()
        field = key if table is None or key.startswith(f"{table}.") else f"{table}.{key}"
        return _measured(field, value, reason or "")
    if match := _NAMED.fullmatch(words) or _OPTION.fullmatch(words):
        return _measured(*match.groups())
    if match := _BARE.fullmatch(words):
        return Parts(field=match[1], allowed=_allowed(match[2]))
    return Parts(allowed=_allowed(words))


def _measured(field: str, value: str, reason: str) -> Parts:
    allowed = _allowed(reason)
    if value == "missing":
        return Parts(field=field, allowed=allowed)
    match = _MEASURED.fullmatch(value)
    if match is None:
        return Parts(None, field, value, None, allowed)
    words, unit = match.groups()
    number = words.strip("'\"") if words[0] in "['\"" else float(words)
    return Parts(None, field, number, unit, allowed)


def _allowed(reason: str) -> str | None:
    """Allowed range or choice that a reason states."""
    return next((match[1] for each in _ALLOWED if (match := each.search(reason))), None)


def _cell(value: Any) -> float | str | None:
    if isinstance(value, bool | str) or value is None:
        return value
    if isinstance(value, int | float) and abs(value) < 1e300 and isfinite(value):
        return value
    return _short(value)


def _short(value: Any) -> str:
    text = repr(list(value) if isinstance(value, tuple) else value)
    return text if len(text) <= 60 else text[:57] + "..."
