"""A limit of a figure or of an order of a channel, between two speeds."""

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


HIGHEST, LOWEST = "highest", "lowest"
WEIGHTED: Final = {LEVEL_UNIT: "Z", "dB(A)": "A", "dB(C)": "C"}
"""Weighting by the unit of a level."""


@dataclass(frozen=True)
class FigureLimit(Refusing):
    """Highest or lowest value of a figure; which one it is of follows from what is given.

    Attributes
    ----------
    limit : in `unit`
    unit : unit of a total `dB`, `dB(A)` or `dB(C)`, of a band `dB`, of an order `dB` or one of the
        channel's quantity, of a criterion its own
    channel : its name, or `*`; empty for a criterion
    order : order of the shaft; none for other figures
    band_hz : nominal midband frequency of a third of an octave; none for other figures
    criterion : name of a criterion of a study; empty for other figures
    side : `highest` or `lowest` value that is allowed
    speed_from_rpm, speed_to_rpm : the limit holds from the one to the other, both included
    origin : file and line, for messages

    Raises
    ------
    ParameterError
        A value is outside its range, the unit does not fit, or several figures are named.

    Examples
    --------
    >>> va.FigureLimit(62.0, "dB(A)", "pressure front_1m").figure
    'total'
    >>> va.FigureLimit(40.0, "dB", "front", band_hz=500.0).figure
    'band'
    """

    limit: float
    unit: str
    channel: str = ""
    order: float | None = None
    band_hz: float | None = None
    criterion: str = ""
    side: str = HIGHEST
    speed_from_rpm: float = 0.0
    speed_to_rpm: float = inf
    origin: str = "limit"

    def __post_init__(self) -> None:
        named = [self.order is not None, self.band_hz is not None, bool(self.criterion)]
        if sum(named) > 1:
            raise ParameterError(f"{self.origin}: order, band_hz, criterion: one of them at most")
        if self.side not in (HIGHEST, LOWEST):
            raise self._refusal("side", f"must be {HIGHEST} or {LOWEST}")
        if bool(self.channel) == bool(self.criterion):
            raise self._refusal("channel", "must be a channel's name, or *; none of a criterion")
        if not isfinite(self.limit):
            raise self._refusal("limit", f"must be a number, in {self.unit}")
        for field in ("order", "band_hz"):
            value = getattr(self, field)
            if value is not None and not (isfinite(value) and value > 0.0):
                raise self._refusal(field, "must be a number above 0")
        if isnan(self.speed_from_rpm) or not self.speed_to_rpm >= self.speed_from_rpm:
            least = f"must be at least speed_from_rpm, {self.speed_from_rpm:g} rpm"
            raise self._refusal("speed_to_rpm", least)
        self._check_unit()

    @property
    def figure(self) -> str:
        """`order`, `band`, `criterion` or `total`."""
        if self.criterion:
            return "criterion"
        if self.order is not None:
            return "order"
        return "total" if self.band_hz is None else "band"

    @property
    def subject(self) -> str:
        """Subject of the limit, such as `band 500 Hz of front`."""
        if self.criterion:
            return f"criterion {self.criterion}"
        if self.order is not None:
            return f"order {self.order:g} of {self.channel}"
        if self.band_hz is not None:
            return f"band {self.band_hz:g} Hz of {self.channel}"
        return f"total of {self.channel}"

    def margin(self, value: float) -> float:
        """Margin to the limit, in its unit; below zero where it is broken."""
        return self.limit - value if self.side == HIGHEST else value - self.limit

    def in_unit(self, rms: float, level_db: float) -> float:
        """An order's RMS in SI, or its level, in the unit of the limit."""
        return level_db if self.unit == LEVEL_UNIT else rms / quantity(self.unit).factor

    def _check_unit(self) -> None:
        allowed = {"band": [LEVEL_UNIT], "total": list(WEIGHTED)}.get(self.figure)
        if allowed and self.unit not in allowed:
            raise self._refusal("unit", f"of a {self.figure} must be one of {', '.join(allowed)}")
        if self.figure == "order" and self.unit != LEVEL_UNIT and find_quantity(self.unit) is None:
            raise self._refusal("unit", "must be dB (re 20 µPa) or that of the channel's quantity")
