"""A limit of an order: largest RMS of a channel, between two speeds."""

from dataclasses import dataclass
from math import inf, isfinite, isnan
from typing import Final

from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import amplitude_of_level
from ..base.errors import ParameterError
from ..recordings.quantities import QUANTITIES, find_quantity, quantity

EVERY_CHANNEL: Final = "*"
LEVEL_UNIT: Final = "dB"
PRESSURE_UNIT: Final = "Pa"


class Refusing:
    """Base of limits: where each comes from, and refusals that say so."""

    origin: str

    def _refusal(self, field: str, allowed: str) -> ParameterError:
        value = getattr(self, field)
        shown = repr(value) if isinstance(value, str) else f"{value:g}"
        return ParameterError(f"{self.origin}: {field} = {shown}: {allowed}")


@dataclass(frozen=True)
class Limit(Refusing):
    """Largest RMS that an order of a channel may have.

    Attributes
    ----------
    channel : its name, or `*` for every channel with such a unit
    order : order of the shaft, above 0
    limit : RMS in `unit`, above 0; in dB any number
    unit : `dB` (re 20 µPa, of sound pressure), or one of the channel's quantity: `mm/s` for m/s
    speed_from_rpm, speed_to_rpm : the limit holds from the one to the other, both included;
        speeds count to the nearest rpm
    origin : file and line, for messages

    Raises
    ------
    ParameterError
        A value is outside its range, or the unit is unknown.

    Examples
    --------
    >>> va.Limit("front", 1.0, 60.0, "dB").rms  # Pa
    0.02
    >>> va.Limit("ring", 2.0, 5.0, "mm/s", speed_to_rpm=3600.0).rms  # m/s
    0.005
    """

    channel: str
    order: float
    limit: float
    unit: str
    speed_from_rpm: float = 0.0
    speed_to_rpm: float = inf
    origin: str = "limit"

    def __post_init__(self) -> None:
        if not self.channel:
            raise self._refusal("channel", "must be a channel's name, or * for all of the unit")
        if not (isfinite(self.order) and self.order > 0.0):
            raise self._refusal("order", "must be a number above 0")
        if self.unit != LEVEL_UNIT and find_quantity(self.unit) is None:
            allowed = ", ".join([f"{LEVEL_UNIT} (re 20 µPa)", *QUANTITIES])
            raise self._refusal("unit", f"must be one of {allowed}")
        if not isfinite(self.limit) or (self.unit != LEVEL_UNIT and self.limit <= 0.0):
            above = "" if self.unit == LEVEL_UNIT else " above 0"
            raise self._refusal("limit", f"must be a number{above}, in {self.unit}")
        if not (isfinite(self.speed_from_rpm) and self.speed_from_rpm >= 0.0):
            raise self._refusal("speed_from_rpm", "must be a number of rpm, at least 0")
        if isnan(self.speed_to_rpm) or self.speed_to_rpm < self.speed_from_rpm:
            allowed = f"must be at least speed_from_rpm, {self.speed_from_rpm:g} rpm"
            raise self._refusal("speed_to_rpm", allowed)

    @property
    def rms(self) -> float:
        """The limit in SI."""
        if self.unit == LEVEL_UNIT:
            return float(REFERENCE_PRESSURE_PA * amplitude_of_level(self.limit))
        return self.limit * quantity(self.unit).factor

    @property
    def channel_unit(self) -> str:
        """SI unit of the channels that it can be for."""
        return PRESSURE_UNIT if self.unit == LEVEL_UNIT else quantity(self.unit).unit
