"""Operating points of a study."""

from collections.abc import Mapping
from math import isfinite
from typing import Annotated, Any, Final

from pydantic import Field, WithJsonSchema, field_validator

from ..base.parameters import Contradictions, Parameters

MOST_SPEEDS_WITH_TIME_SERIES: Final = 100
# Limits for the schema of files; `Operation` refuses them in words of its own.
_SHOWN_SPEED = WithJsonSchema({"type": "number", "minimum": 60.0, "maximum": 60000.0})
_SHOWN_SUPPLY = WithJsonSchema({"type": "number", "minimum": 1.0, "maximum": 1000.0})
MOST_SPEEDS: Final = 1000
KEYS: Final = ("start", "stop", "step")
DECIMALS: Final = 9
"""Decimals of a speed in rpm; a speed that misses `stop` by 1e-9 of a step counts as it."""


class Operation(Parameters):
    speed_rpm: tuple[Annotated[float, _SHOWN_SPEED], ...] = Field(
        min_length=1, max_length=MOST_SPEEDS
    )
    """Speeds; in a file also a table of start, stop and step."""
    crank_angle_samples: int = Field(default=256, ge=64, le=65536)
    maximum_order: int | None = Field(default=None, ge=2, le=1000)
    """Maximum order; None for as many at each speed as the highest frequency of the radiation
    holds."""
    keep_time_series: bool | None = None
    """Forces and moments over crank angle in the results; none for up to 100 speeds only."""
    supply_frequency_hz: tuple[Annotated[float, _SHOWN_SUPPLY], ...] | None = None
    """Frequency of the motor's supply, one for each speed; where a source needs it."""
    point: str | None = None
    """Operating point of the machine's file, whose values hold; none for the nominal machine."""
    stopping: bool = False
    """Whether a stop from each speed is computed, where the machine has a table of that name."""
    turning_back: bool = False
    """Whether stops go on where trapped gas turns the shaft back, through the elastic shell too."""

    @field_validator("speed_rpm", mode="before")
    @classmethod
    def _range(cls, value: Any) -> Any:
        if isinstance(value, dict):
            return speed_range(value)
        return tuple(value) if isinstance(value, list) else value

    def contradictions(self) -> Contradictions:
        for speed in self.speed_rpm:
            if not 60.0 <= speed <= 60000.0:
                yield f"speed_rpm = {speed:g} rpm: allowed 60 to 60000 rpm"
        if len(set(self.speed_rpm)) < len(self.speed_rpm):
            yield "speed_rpm lists a speed twice"
        supply = self.supply_frequency_hz
        if supply is not None and len(supply) != len(self.speed_rpm):
            yield (
                f"supply_frequency_hz: {len(supply)} values for {len(self.speed_rpm)} speeds; one "
                "is needed for each"
            )
        for frequency in supply or ():
            if not 1.0 <= frequency <= 1e3:
                yield f"supply_frequency_hz = {frequency:g} Hz: allowed 1 to 1000 Hz"

    @property
    def keeps_time_series(self) -> bool:
        """Whether the results hold forces and moments over crank angle."""
        few = len(self.speed_rpm) <= MOST_SPEEDS_WITH_TIME_SERIES
        return few if self.keep_time_series is None else self.keep_time_series


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
