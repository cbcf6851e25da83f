"""Time stamps of loggers: date and clock in several forms, or a clock alone."""

import re
from typing import Final, NamedTuple

import numpy as np

_CLOCK: Final = (
    r"(?P<clock>[0-9]{1,2}:[0-9]{2}(?::[0-9]{2})?)(?:[.,:](?P<fraction>[0-9]{1,9}))?"
    r"(?: ?(?P<half>[AaPp])\.?[Mm]\.?)?(?P<zone>Z|[+-][0-9]{2}:?[0-9]{2})?"
)
_DATES: Final = (
    r"(?P<year>[0-9]{4})-(?P<month>[0-9]{2})-(?P<day>[0-9]{2})",
    r"(?P<year>[0-9]{4})/(?P<month>[0-9]{1,2})/(?P<day>[0-9]{1,2})",
    r"(?P<day>[0-9]{1,2})\.(?P<month>[0-9]{1,2})\.(?P<year>[0-9]{4})",
    r"(?P<day>[0-9]{1,2})[- ](?P<month>[A-Za-z]{3})[- ](?P<year>[0-9]{4})",
    r"(?P<first>[0-9]{1,2})/(?P<second>[0-9]{1,2})/(?P<year>[0-9]{4})",
)
_FORMS: Final = tuple(
    re.compile(rf"\s*\"?{date}{_CLOCK}\"?\s*") for date in (*(f"{d}[T ]+" for d in _DATES), "")
)
_MONTHS: Final = (
    "jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec",
)  # fmt: skip
_MONTHS_A_YEAR: Final = 12
DAY_NS: Final = 86_400 * 10**9


class Stamp(NamedTuple):
    """Time stamp.

    Attributes
    ----------
    date : ISO 8601; empty of a clock alone, or where day and month cannot be distinguished
    clock : hours, minutes, seconds and fraction
    zone : offset from UTC; empty where it is not stated
    day_ns : nanoseconds since 1970 of the day, which may have day and month exchanged
    clock_ns : nanoseconds of the clock since midnight
    """

    date: str
    clock: str
    zone: str
    day_ns: int
    clock_ns: int


def find_stamp(field: str) -> Stamp | None:
    """Time stamp of a field of a table; None where it is none.

    Parameters
    ----------
    field : `2026-11-28 10:00:00.5`, `28.11.2026 10:00:00,5`, `11/28/2026 10:00:00 AM`,
        `28-Nov-2026 10:00:00`, `10:00:00.001` and the like
    """
    if ":" not in field:
        return None
    match = next((match for form in _FORMS if (match := form.fullmatch(field))), None)
    return None if match is None else _stamp(match.groupdict(""))


def _stamp(parts: dict[str, str]) -> Stamp | None:
    date, is_sure = _date(parts)
    clock, fraction = parts["clock"], parts["fraction"]
    hours, minutes, seconds = (int(part) for part in f"{clock}:0".split(":")[:3])
    half = parts["half"].lower()
    hours = hours % 12 + 12 * (half == "p") if half else hours
    if not (hours < 24 and minutes < 60 and seconds < 61):
        return None
    try:
        day_ns = int(np.datetime64(date or "1970-01-01", "ns").astype(np.int64))
    except ValueError:
        return None
    clock_ns = 10**9 * (3600 * hours + 60 * minutes + seconds) + int(fraction.ljust(9, "0") or 0)
    text = clock if not half else f"{hours:02d}{clock[clock.index(':') :]}"
    text = text.zfill(8) if text.count(":") > 1 else text.zfill(5)
    text += f".{fraction}" if fraction else ""
    return Stamp(date if is_sure else "", text, parts["zone"], day_ns, clock_ns)


def _date(parts: dict[str, str]) -> tuple[str, bool]:
    """Date as ISO 8601, and whether day and month are known; empty of a clock alone."""
    if "year" not in parts:
        return "", False
    year, month, day, is_sure = parts["year"], parts.get("month", ""), parts.get("day", ""), True
    if "first" in parts:
        first, second = int(parts["first"]), int(parts["second"])
        is_day_first = first > _MONTHS_A_YEAR
        month, day = (str(second), str(first)) if is_day_first else (str(first), str(second))
        is_sure = is_day_first or second > _MONTHS_A_YEAR or first == second
    if month.lower() in _MONTHS:
        month = str(1 + _MONTHS.index(month.lower()))
    return f"{year}-{month.zfill(2)}-{day.zfill(2)}", is_sure


def is_stamp(field: str) -> bool:
    """Whether a field of a table is a time stamp."""
    return find_stamp(field) is not None


def stamp_text(field: str) -> str:
    """A time stamp as ISO 8601 writes it; empty where its date is not known."""
    stamp = _known(field)
    return f"{stamp.date}T{stamp.clock}{stamp.zone}" if stamp.date else ""


def stamp_ns(field: str) -> int:
    """Nanoseconds of a time stamp since 1970, of UTC where it states its offset."""
    stamp = _known(field)
    return stamp.day_ns + stamp.clock_ns - 60_000_000_000 * _offset_minutes(stamp.zone or "Z")


def _known(field: str) -> Stamp:
    stamp = find_stamp(field)
    if stamp is None:
        raise ValueError(f"{field!r} is no time stamp")
    return stamp


def _offset_minutes(zone: str) -> int:
    if zone == "Z":
        return 0
    minutes = 60 * int(zone[1:3]) + int(zone[-2:])
    return -minutes if zone[0] == "-" else minutes
