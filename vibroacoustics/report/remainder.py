"""Sentences of the report on unmodelled noise: its growth with speed."""

from collections.abc import Callable
from typing import Final

import xarray as xr

from ..base import rounding
from ..base.decibel import level_of_power
from ..base.vocabulary import REFERENCE_OPTION
from ..results.bands import Band, band
from ..results.stored_study import at_catalogue, overall_noise, parameters, quoted_speed, speeds

_GROWTH = "remainder.speed_growth_db"
NO_LEVEL: Final = (
    "The machine's file gives no published level: there is no unmodelled noise. Levels and their "
    "changes are those of the modelled sources. The machine itself is louder and changes less."
)


def unmodelled_level(results: xr.Dataset, speed: float) -> Band:
    """Level of unmodelled noise at a speed without an option, with its interval."""
    return band(results, "residual_level", **at_catalogue(results, speed=speed))


def measured_rpm(results: xr.Dataset) -> float | None:
    """First speed at which a baseline replaces unmodelled noise at the published microphone.

    None where there is none.
    """
    if "baseline_band_level" not in results:
        return None
    measured_level = results["baseline_band_level"].sel(at_catalogue(results))
    measured = results["speed"].values[measured_level.notnull().any("baseline_band").values]
    return float(measured[0]) if measured.size else None


def total_sentence(results: xr.Dataset) -> str:
    """Say what the total holds beside the modelled sources."""
    if overall_noise(results) is None:
        return "No level of the machine is published: the total is that of what is modelled."
    return "The total holds the part that is not modelled (see assumptions)."


def growth_sentence(results: xr.Dataset) -> str:
    """Say how unmodelled noise is assumed to grow with speed, or that there is none.

    Also where a baseline stands for it.
    """
    names = ""
    if "baseline_band_level" in results:
        levels = results["baseline_band_level"].sel(option=REFERENCE_OPTION)
        measured = levels.notnull().any(["speed", "baseline_band"]).values
        names = ", ".join(map(str, results["receiver"].values[measured]))
    placed = f" At {names} the measured baseline stands in its place." if names else ""
    return f"{_growth_sentence(results)}{placed}"


def _growth_sentence(results: xr.Dataset) -> str:
    if overall_noise(results) is None:
        return NO_LEVEL
    growth = parameters(results)["machine"].get("remainder", {}).get("speed_growth_db")
    if growth is None:  # files of older versions
        return "It is assumed to be constant over speed."
    ends = _range(results) or (growth, growth)
    return (
        f"Assumed growth: {_span(growth, ends, rounding.fixed)} dB for ten times the "
        f"speed{_at_speeds(results, growth, ends)}."
    )


def _at_speeds(results: xr.Dataset, growth: float, ends: tuple[float, float]) -> str:
    """Words such as `, +2.4 dB (2.0 to 2.8) at 3500 rpm`, for the speed that is furthest off."""
    published = quoted_speed(results)
    turning = [speed for speed in speeds(results) if speed > 0.0]
    furthest = max(turning, key=lambda s: abs(level_of_power(s / published)), default=published)
    decades = level_of_power(furthest / published) / 10.0
    if decades == 0.0:
        return ""
    at_ends = sorted(end * decades for end in ends)
    change = _span(growth * decades, (at_ends[0], at_ends[1]), rounding.signed)
    return f", {change} dB at {furthest:g} rpm"


def _range(results: xr.Dataset) -> tuple[float, float] | None:
    """Range of the growth in the machine's file."""
    for record in parameters(results)["records"]:
        if record["field"].endswith(_GROWTH) and record["lowest"] is not None:
            return record["lowest"], record["highest"]
    return None


def _span(value: float, ends: tuple[float, float], write: Callable[[float], str]) -> str:
    return Band(ends[0], value, ends[1]).middle_and_ends(write)
