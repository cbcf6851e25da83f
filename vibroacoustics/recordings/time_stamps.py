"""Time stamps of ISO 8601, as loggers write them: date and time of day in one field."""

import re
from typing import Final

import numpy as np

_STAMP: Final = re.compile(
    r"\s*\"?(?P<date>[0-9]{4}-[0-9]{2}-[0-9]{2})[T ]"
    r"(?P<time>[0-9]{2}:[0-9]{2}(?::[0-9]{2}(?:[.,][0-9]+)?)?)"
    r"(?P<zone>Z|[+-][0-9]{2}:?[0-9]{2})?\"?\s*"
)


def is_stamp(field: str) -> bool:
    """Whether a field of a table is a time stamp."""
    return _STAMP.fullmatch(field) is not None


def stamp_text(field: str) -> str:
    """A time stamp as ISO 8601 writes it, with `T` and a point."""
    match = _STAMP.fullmatch(field)
    if match is None:
        raise ValueError(f"{field!r} is no time stamp")
    return f"{match['date']}T{match['time'].replace(',', '.')}{match['zone'] or ''}"


def stamp_ns(field: str) -> int:
    """Nanoseconds of a time stamp since 1970, of UTC where it states its offset.

    Raises
    ------
    ValueError
        The field is no time stamp.
    """
    match = _STAMP.fullmatch(field)
    if match is None:
        raise ValueError(f"{field!r} is no time stamp")
    local = np.datetime64(f"{match['date']}T{match['time'].replace(',', '.')}", "ns")
    return int(local.astype(np.int64)) - 60_000_000_000 * _offset_minutes(match["zone"] or "Z")


def _offset_minutes(zone: str) -> int:
    if zone == "Z":
        return 0
    minutes = 60 * int(zone[1:3]) + int(zone[-2:])
    return -minutes if zone[0] == "-" else minutes
