"""Speeds of a study as `{ start, stop, step }`."""

from collections.abc import Mapping
from math import isfinite
from typing import Any, Final

MOST_SPEEDS: Final = 1000
KEYS: Final = ("start", "stop", "step")
DECIMALS: Final = 9
"""Of a speed in rpm; and a speed that misses `stop` by 1e-9 of a step counts as it."""


def speed_range(table: Mapping[str, Any]) -> tuple[float, ...]:
    """Speeds from start in equal steps, rpm; stop among them where a step meets it.

    Raises
    ------
    ValueError
        A key is missing or unknown, a value is no number, the step is not above zero, stop lies
        below start, or there are too many speeds.
    """
    for key in table:
        if key not in KEYS:
            raise ValueError(f"{key}: unknown key; allowed {', '.join(KEYS)}")
    start, stop, step = (_number(table, key) for key in KEYS)
    if step <= 0.0:
        raise ValueError(f"step = {step:g} rpm: must be above 0 rpm")
    if stop < start:
        raise ValueError(f"stop = {stop:g} rpm: must be at least start = {start:g} rpm")
    steps = (stop - start) / step + 10.0**-DECIMALS
    if steps >= MOST_SPEEDS:
        raise ValueError(f"step = {step:g} rpm: makes more than {MOST_SPEEDS} speeds")
    return tuple(round(start + number * step, DECIMALS) for number in range(int(steps) + 1))


def _number(table: Mapping[str, Any], key: str) -> float:
    value = table.get(key)
    if value is None:
        raise ValueError(f"{key}: is missing")
    if isinstance(value, bool) or not isinstance(value, int | float) or not isfinite(value):
        raise ValueError(f"{key} = {value}: must be a number of rpm")
    return float(value)
