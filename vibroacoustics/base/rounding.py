"""Numbers as a reader sees them: rounded, with a true minus sign, never rounding noise."""

import re
from collections.abc import Callable, Iterable
from itertools import repeat
from typing import Final

import numpy as np

from .arrays import Array

LEVEL_FLOOR_DB: Final = -40.0
"""Levels below are far under any hearing and next to rounding errors: shown as `< −40`."""

FORCE_FLOOR: Final = 1e-6
"""Forces (N) and moments (N m) below are rounding errors: shown as 0."""

_EXACT: Final = 22.0
"""Powers of ten up to this one are exact."""

NOTHING: Final = "–"
_SMALL: Final = 1e-3
_LARGE: Final = 1e6
_DECIMALS: Final = re.compile(r"\.(\d+)(?!\d*·)")
_RAISED: Final = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def significant(value: float, digits: int = 3) -> str:
    """A quantity to `digits` significant digits; 0 below FORCE_FLOOR."""
    if not np.isfinite(value):
        return NOTHING
    if abs(value) < FORCE_FLOOR:
        return "0"
    decimals = digits - 1 - int(np.floor(np.log10(abs(value))))
    return _minus(f"{value:.{max(decimals, 0)}f}")


def to_digits(values: Array, digits: int) -> Array:
    """Round values to significant digits, as their text would be read.

    Parameters
    ----------
    values : any values, shape (...)
    digits : number of digits
    """
    size = np.abs(np.where(values == 0.0, 1.0, values))
    power = digits - 1 - np.floor(np.log10(size))
    up, down = (10.0 ** np.clip(exponent, 0.0, _EXACT) for exponent in (power, -power))
    rounded = np.rint(values * up / down) / up * down
    inexact = np.abs(power) > _EXACT
    rounded[inexact] = [float(f"{value:.{digits}g}") for value in values[inexact]]
    return np.asarray(rounded)


def three_digits(value: float) -> str:
    """Any size to three digits: `0.0123`, `123000`, `1.2·10¹⁰`."""
    if not np.isfinite(value):
        return NOTHING
    if value == 0.0 or _SMALL <= abs(value) < _LARGE:
        return _minus(np.format_float_positional(float(f"{value:.3g}"), trim="-"))
    mantissa, _, power = f"{value:.2e}".partition("e")
    digits = mantissa.rstrip("0").rstrip(".")
    return _minus(f"{digits}·10") + str(int(power)).translate(_RAISED)


def fixed(value: float, decimals: int = 1) -> str:
    """A number with fixed decimals."""
    if not np.isfinite(value):
        return NOTHING
    return _minus(f"{round(value, decimals) + 0.0:.{decimals}f}")


def signed(value: float, decimals: int = 1) -> str:
    """A change with its sign; no sign where it rounds to zero."""
    rounded = round(value, decimals) if np.isfinite(value) else value
    return fixed(value, decimals) if not rounded > 0.0 else f"+{fixed(value, decimals)}"


def level(value_db: float) -> str:
    """A level to 0.1 dB, or that it lies below the floor."""
    if value_db < LEVEL_FLOOR_DB:
        return f"< {fixed(LEVEL_FLOOR_DB, 0)}"
    return fixed(value_db)


def level_change(change_db: float, level_db: float, reference_db: float) -> str:
    """A change of level; `–` where the reference is silent, `silent` where the line vanishes."""
    if reference_db < LEVEL_FLOOR_DB:
        return NOTHING
    return "silent" if level_db < LEVEL_FLOOR_DB else signed(change_db)


def unit_of_digits(error: float, finest: float) -> float:
    """Power of ten to which a value is written, 10^round(lg of its error); 0 without error.

    The first digit that the sampling leaves open is the last one written (Song & Schmeiser 2009,
    Operations Research 57, 1).

    Parameters
    ----------
    error : standard error
    finest : error that counts where the sampling error is smaller
    """
    counting = max(error, finest)
    return 10.0 ** round(np.log10(counting)) if counting > 0.0 else 0.0


def to_unit(value: float, unit: float, write: Callable[[float], str]) -> str:
    """A number rounded to a power of ten, without finer decimals; as `write` has it for unit 0."""
    if unit == 0.0 or not np.isfinite(value):
        return write(value)
    decimals = max(-round(np.log10(unit)), 0)
    text = write(float(unit * np.round(value / unit)) + 0.0)
    return _DECIMALS.sub(lambda match: f".{match[1][:decimals]}".rstrip("."), text)


def span(
    values: Iterable[float], write: Callable[[float], str], units: Iterable[float] = repeat(0.0)
) -> str:
    """`1.6 to 24.5`, each end in its unit, or one number where both ends read the same."""
    finite = sorted(pair for pair in zip(values, units, strict=False) if np.isfinite(pair[0]))
    if not finite:
        return NOTHING
    lowest, highest = (to_unit(value, unit, write) for value, unit in (finite[0], finite[-1]))
    return lowest if lowest == highest else f"{lowest} to {highest}"


def _minus(text: str) -> str:
    return text.replace("-", "−")
