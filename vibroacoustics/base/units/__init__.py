"""Units in the suffix of a key: `stroke_mm = 6.75` in a file is `stroke_m = 0.00675` inside."""

import math
import re
from dataclasses import dataclass
from typing import Final

from ..errors import PluginError
from ..registry import Registry


@dataclass(frozen=True)
class Unit:
    """Unit that a key's suffix stands for.

    Attributes
    ----------
    suffix : suffix of the key, small letters, digits and underscores
    symbol : to print
    si_suffix : suffix of the SI key
    factor : to SI

    Examples
    --------
    >>> inch = va.register(va.Unit("inch", "in", "m", 0.0254))  # `stroke_inch` in a study file
    >>> inch.factor
    0.0254
    """

    suffix: str
    symbol: str
    si_suffix: str
    factor: float

    def __post_init__(self) -> None:
        for text in (self.suffix, self.si_suffix):
            if not re.fullmatch("[a-z0-9]+(_[a-z0-9]+)*", text):
                raise PluginError(f"unit {text!r}: must be small letters, digits and underscores")
        if not (math.isfinite(self.factor) and self.factor > 0.0):
            raise PluginError(f"unit {self.suffix}: factor = {self.factor}: must be above zero")
        if self.suffix == self.si_suffix and self.factor != 1.0:
            raise PluginError(f"unit {self.suffix}: factor = {self.factor}: is 1 for an SI unit")


UNITS: Final[Registry[Unit]] = Registry(
    "unit", Unit, "suffix", "base.units", "vibroacoustics.units"
)


def split_key(key: str) -> tuple[str, Unit | None]:
    """Split `stroke_mm` into `stroke` and the unit; the unit is None where there is none."""
    parts = key.split("_")
    for start in range(1, len(parts)):
        unit = UNITS.get("_".join(parts[start:]))
        if unit is not None:
            return "_".join(parts[:start]), unit
    return key, None


def si_key(key: str) -> tuple[str, float]:
    """Name and factor of the SI field that a file's key fills."""
    stem, unit = split_key(key)
    return (key, 1.0) if unit is None else (f"{stem}_{unit.si_suffix}", unit.factor)


def shaft_frequency_hz(speed_rpm: float) -> float:
    """Shaft frequency in Hz of a speed in revolutions per minute: 3000 rpm is 50 Hz."""
    return speed_rpm / 60.0


def orders_below(frequency_hz: float, speed_rpm: float) -> int:
    """Number of shaft orders up to a frequency, which counts if an order meets it in rounding."""
    return int(frequency_hz / shaft_frequency_hz(speed_rpm) + 1e-9)
