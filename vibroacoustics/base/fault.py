"""Faults of third parties' code, and what a command omits because of them or of broken files."""

import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Final, NamedTuple

from .errors import PluginError
from .refusal import Parts, Refusal, reworded

MOST_WORDS: Final = 300
"""Characters of a plug-in's own words that are shown."""


class Owner(NamedTuple):
    """Whose code runs.

    Attributes
    ----------
    noun, name : noun and name of the thing in its registry
    file : name of the file that holds it
    thing : class or object
    """

    noun: str
    name: str
    file: str
    thing: object = None


class FaultError(PluginError):
    """A plug-in's thing failed; the line names it, its file and the line of code.

    Attributes
    ----------
    noun, name : noun and name of the thing in its registry
    reason : file, line and words, without noun and name
    """

    noun: str = ""
    name: str = ""
    reason: str = ""

    @classmethod
    def at_line(cls, owner: Owner, line: int | None, words: str) -> "FaultError":
        """Return the fault of a thing at a line of its file."""
        where = owner.file if line is None else f"{owner.file}, line {line}"
        reason = f"{where}: {cut(words)}"
        field = f"{owner.noun} {owner.name}"
        fault = cls(Refusal(f"{field}: {reason}", Parts(owner.file, field)))
        fault.noun, fault.name, fault.reason = owner.noun, owner.name, reason
        return fault

    def with_hint(self, hint: str) -> "FaultError":
        """Return the same fault with what the user can do about it."""
        fault = type(self)(reworded(self.args[0], f"{self}; {hint}"))
        fault.noun, fault.name, fault.reason = self.noun, self.name, self.reason
        return fault


class LeftOutWarning(UserWarning):
    """Something is omitted because it failed: of a plug-in, or one of many files."""


def cut(words: str) -> str:
    """Return a plug-in's words in one line of at most 300 characters."""
    line = " ".join(words[: 10 * MOST_WORDS].split())
    return line if len(line) <= MOST_WORDS else f"{line[: MOST_WORDS - 2]} …"


def leave_out(fault: FaultError, what: str = "") -> None:
    """Report that a thing of a plug-in is omitted; see `omit`."""
    omit(what or f"{fault.noun} {fault.name}", fault.reason, fault.args[0])


def omit(what: str, reason: str, source: str = "") -> None:
    """Report that something is omitted: to all that collect, and once by a warning.

    Parameters
    ----------
    what : thing that is omitted
    reason : reason
    source : message whose file, field and value the line keeps
    """
    line = reworded(source or reason, f"{what} is omitted: {reason}")
    collecting = _COLLECTING.get()
    is_known = bool(collecting) and line in collecting[0]
    for lines in collecting:
        if line not in lines:
            lines.append(line)
    if not is_known:
        warnings.warn(line, LeftOutWarning, stacklevel=3)


@contextmanager
def collected() -> Iterator[list[str]]:
    """Collect a line on everything that is omitted."""
    lines: list[str] = []
    token = _COLLECTING.set((*_COLLECTING.get(), lines))
    try:
        yield lines
    finally:
        _COLLECTING.reset(token)


_COLLECTING: Final[ContextVar[Sequence[list[str]]]] = ContextVar("_COLLECTING", default=())
