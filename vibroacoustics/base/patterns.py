"""Names of variables and patterns of names, beside types."""

from collections.abc import Collection
from fnmatch import fnmatchcase
from functools import cache
from typing import Final

_WILDCARDS: Final = frozenset("*?[")


def is_among(thing: str | type, things: Collection[str | type]) -> bool:
    """Return whether a variable or product is among others, by name or pattern, as `room_*`."""
    if thing in things or not isinstance(thing, str):
        return thing in things
    return any(fnmatchcase(thing, str(other)) for other in things if is_pattern(other))


@cache
def is_pattern(thing: str | type) -> bool:
    """Return whether a name stands for many, as `room_*`."""
    return isinstance(thing, str) and not _WILDCARDS.isdisjoint(thing)
