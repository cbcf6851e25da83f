"""PermitVerdict on units at a window: level by lines, spare, least distance, probability."""

from collections.abc import Mapping, Sequence
from decimal import ROUND_HALF_UP, Decimal
from typing import Final, NamedTuple

import numpy as np
from scipy.special import ndtr

from ..base.decibel import energy_sum, power_of_level
from .rule import CalculationLine, PermitRule, PermitUnit

NEAREST_M: Final = 0.3
FARTHEST_M: Final = 2000.0
_GRID: Final = np.geomspace(NEAREST_M, FARTHEST_M, 800)
_HALVINGS: Final = 40


class PermitVerdict(NamedTuple):
    """PermitVerdict of a rule on units at a window.

    Attributes
    ----------
    lines : calculation, by unit and then for all
    level_dba : level that is compared, not rounded
    limit_dba : limit
    is_met : whether the rounded level is at most the limit
    spare_db : limit less level, both as compared
    probability : that the limit is met, by the deviations of the units
    least_distance_m : beyond it the limit is met with all units at one distance; not a number
        where it is farther than 2 km
    tone_m : part of the least distance that the tones cost

    Examples
    --------
    >>> verdicts = va.judge_permit("heat_pump/permit.toml")
    >>> round(verdicts["neighbour"].level_dba, 1), verdicts["neighbour"].is_met
    (36.8, True)
    """

    lines: Sequence[CalculationLine]
    level_dba: float
    limit_dba: float
    is_met: bool
    spare_db: float
    probability: float
    least_distance_m: float
    tone_m: float


def rounded(level_db: float, decimals: int | None) -> float:
    """Round a level half up to so many decimals (DIN 1333); None keeps it.

    Parameters
    ----------
    level_db : level
    decimals : decimals that are kept
    """
    if decimals is None:
        return level_db
    shown = Decimal(repr(round(level_db, 9)))
    return float(shown.quantize(Decimal(1).scaleb(-decimals), ROUND_HALF_UP))


def judged(units: Mapping[str, PermitUnit], windows: Mapping[str, PermitRule]) -> PermitVerdict:
    """Judge units at a window.

    Parameters
    ----------
    units : units by name
    windows : the window as each unit sees it, by name of the unit
    """
    lines, level = level_of(units, windows)
    window = next(iter(windows.values()))
    limit = window.allowed_dba
    compared = rounded(level, window.decimals)
    least = least_distance_m(units, windows)
    without_tone = {"tone_adjustment_db": 0.0}
    plain = {name: unit.model_copy(update=without_tone) for name, unit in units.items()}
    return PermitVerdict(
        lines,
        level,
        limit,
        compared <= limit,
        limit - compared,
        probability(level, _deviation_db(units, windows), limit, window.decimals),
        least,
        least - least_distance_m(plain, windows),
    )


def level_of(
    units: Mapping[str, PermitUnit], windows: Mapping[str, PermitRule]
) -> tuple[list[CalculationLine], float]:
    """Return the calculation and the level that is compared.

    Parameters
    ----------
    units, windows : units, and the window as each of them sees it, by name of the unit
    """
    lines, levels = [], []
    for name, unit in units.items():
        of_unit = windows[name].level_lines(unit)
        whose = f"{name}: " if len(units) > 1 else ""
        lines += [line._replace(text=f"{whose}{line.text}") for line in of_unit]
        levels.append(of_unit[-1].value)
    window = next(iter(windows.values()))
    level = float(energy_sum(np.array(levels), axis=0))
    if len(levels) > 1:
        lines.append(CalculationLine("all units, energies added", level, "dB(A)"))
    further = window.adjustment_lines()
    level += sum(line.value for line in further)
    lines += further
    last = window.last_lines(level)
    level = last[-1].value if last else level
    shown = rounded(level, window.decimals)
    how = "" if window.decimals is None else ", rounded"
    return [*lines, *last, CalculationLine(f"level that is compared{how}", shown, "dB(A)")], level


def probability(
    level_db: float, deviation_db: float, limit_db: float, decimals: int | None
) -> float:
    """Return the probability that a rounded level is at most a limit.

    The level is normal about the computed one. A level rounds to the limit up to half a step above.

    Parameters
    ----------
    level_db : computed level
    deviation_db : its standard deviation
    limit_db : limit
    decimals : decimals of the rounding; None without
    """
    step = 0.0 if decimals is None else 0.5 * float(Decimal(1).scaleb(-decimals))
    spare = rounded(limit_db, decimals) if decimals is not None else limit_db
    margin_db = spare + step - level_db
    if deviation_db == 0.0:
        return float(margin_db > 0.0 or (step == 0.0 and margin_db >= 0.0))
    return float(ndtr(margin_db / deviation_db))


def _deviation_db(units: Mapping[str, PermitUnit], windows: Mapping[str, PermitRule]) -> float:
    """Deviation of the sum of units that err independently, to first order."""
    levels = np.array([windows[name].level_lines(unit)[-1].value for name, unit in units.items()])
    share = power_of_level(levels - energy_sum(levels, axis=0))
    deviations = np.array([unit.deviation_db for unit in units.values()])
    return float(np.sqrt(np.sum((share * deviations) ** 2)))


def least_distance_m(units: Mapping[str, PermitUnit], windows: Mapping[str, PermitRule]) -> float:
    """Return the horizontal distance of all units beyond which the limit is met.

    Levels may rise with the distance over soft ground: the farthest crossing counts.

    Parameters
    ----------
    units, windows : units, and the window as each of them sees it, by name of the unit
    """
    limit = next(iter(windows.values())).allowed_dba
    decimals = next(iter(windows.values())).decimals

    def is_above(distance_m: float) -> bool:
        windows_there = {
            name: window.model_copy(update={"distance_m": distance_m})
            for name, window in windows.items()
        }
        return rounded(level_of(units, windows_there)[1], decimals) > limit

    above = [distance for distance in _GRID.tolist() if is_above(distance)]
    if not above:
        return NEAREST_M
    low = above[-1]
    if low >= FARTHEST_M:
        return float("nan")
    high = float(_GRID[np.searchsorted(_GRID, low) + 1])
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if is_above(middle) else (low, middle)
    return high
