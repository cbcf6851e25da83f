"""A measured baseline at microphones over speed, and hammer tests of the floor under the feet."""

from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Any, Final, Literal

import numpy as np
from pydantic import Field, field_validator

from ..base.decibel import power_of_level
from ..base.parameters import Contradictions, Parameters
from ..mechanics.added import third_octave_number
from .measured_shell import Hit, MeasuredShell
from .measured_sound_path import MeasuredSoundPath


class FloorPoint(Hit):
    """A point of the floor under a foot; along z, or along x or y for both."""

    foot: str
    """Its name."""

    @property
    def is_vertical(self) -> bool:
        """Whether it is hit up or down."""
        return self.direction[1] == "z"


class MeasuredFloor(Parameters):
    """Driving-point frequency responses under the feet, in place of a rigid floor."""

    frequency_responses: tuple[str, ...] = Field(min_length=1)
    units: dict[str, str] = Field(default_factory=dict)
    points: dict[str, FloorPoint] = Field(min_length=1)

    def contradictions(self) -> Contradictions:
        counted = Counter((point.foot, point.is_vertical) for point in self.points.values())
        for (foot, is_vertical), count in counted.items():
            if count > 1:
                along = "up and down" if is_vertical else "sideways"
                yield f"points: {count} points {along} under {foot}, must be one"
        for foot, is_vertical in counted:
            if not is_vertical and (foot, True) not in counted:
                yield f"points: {foot} has a point sideways and none up and down"


LOWEST_HZ: Final = 10.0
HIGHEST_HZ: Final = 20000.0
ROUNDED: Final = 0.02
"""Nominal midband frequencies are less than this share off the exact ones."""
SPEED_TOLERANCE: Final = 0.02
"""A speed this share outside those that were measured is taken for the nearest of them."""


def wrong_third_octave(band_hz: float) -> str | None:
    """Return why a frequency is not the nominal middle of a third octave; None where it is."""
    in_range = LOWEST_HZ <= band_hz <= HIGHEST_HZ
    exact = power_of_level(float(third_octave_number(np.asarray(band_hz)))) if in_range else 1.0
    if in_range and abs(band_hz / exact - 1.0) < ROUNDED:
        return None
    return (
        f"band_hz = {band_hz:g} Hz: must be the middle of a third octave from "
        f"{LOWEST_HZ:g} to {HIGHEST_HZ:g} Hz"
    )


class BaselineSpectrum(Parameters):
    """Unweighted levels of the third octaves at a microphone and a speed."""

    microphone: str
    speed_rpm: float = Field(ge=60.0, le=60000.0)
    band_hz: tuple[float, ...] = Field(min_length=1)
    """Nominal midband frequencies, rising."""
    level_db: tuple[float, ...]
    """re 20 µPa, a level for each band."""
    without_orders: bool = False
    """Whether the orders that were measured are taken off already."""

    def contradictions(self) -> Contradictions:
        yield from filter(None, map(wrong_third_octave, self.band_hz))


class BaselineOrders(Parameters):
    """Unweighted levels of shaft orders at a microphone and a speed, with phase where it is known.

    The phase is that of a cosine after the pulse of the tacho.
    """

    microphone: str
    speed_rpm: float = Field(ge=60.0, le=60000.0)
    order: tuple[float, ...] = Field(min_length=1)
    """Rising."""
    level_db: tuple[float, ...]
    """re 20 µPa, a level for each order."""
    phase_rad: tuple[float | None, ...]
    """Phase, None where it is not known."""

    def contradictions(self) -> Contradictions:
        if not self.order[0] > 0.0:
            yield f"order = {self.order[0]:g}: must be above 0"


class BaselineMicrophone(Parameters):
    """Name of a microphone in the files."""

    channel: str | None = None
    """Channel of a recording."""
    node: int | None = Field(default=None, ge=0, le=999_999_999)
    """Node of a function of frequency."""


class BaselineSettings(Parameters):
    """Files of the baseline, and what they do not say themselves."""

    file: tuple[str, ...] = Field(min_length=1)
    """File: in a study file a name, or a list of names."""
    microphones: dict[str, BaselineMicrophone] = Field(default_factory=dict)
    """Names by receiver; those of the files need no entry."""
    tacho_angle_rad: float | None = Field(default=None, ge=-7.0, le=7.0)
    """Crank angle of the study at which the tacho gives its pulse; none for energies."""
    recorded_speed_rpm: tuple[float, ...] = ()
    """Speed of each file that states none, in their order."""
    window: Literal["hann", "rectangular", "flat_top"] = "hann"
    """Window of narrow-band spectra."""
    spectra: Literal["peak", "rms"] = "peak"
    """Scale of the spectra of phasors."""
    tolerance_db: float = Field(default=1.5, ge=0.1, le=10.0)
    """Standard deviation of measured levels, for the weights of samples."""

    @field_validator("file", "recorded_speed_rpm", mode="before")
    @classmethod
    def _one_or_several(cls, value: Any) -> Any:
        if isinstance(value, list):
            return tuple(value)
        is_single = isinstance(value, str | int | float) and not isinstance(value, bool)
        return (float(value) if not isinstance(value, str) else value,) if is_single else value


class Baseline(BaselineSettings):
    """Measured sound of the machine without a balancer: what a study's changes are put on."""

    third_octaves: tuple[BaselineSpectrum, ...] = ()
    orders: tuple[BaselineOrders, ...] = ()

    def contradictions(self) -> Contradictions:
        for name in self.measured_at:
            if len({spectrum.band_hz for spectrum in self.spectra_at(name)}) > 1:
                yield f"microphone {name}: has other bands at another speed"
            if len({row.order for row in self.orders_at(name)}) > 1:
                yield f"microphone {name}: has other orders at another speed"
        for name in self.measured_at:
            for kind in (self.spectra_at(name), self.orders_at(name)):
                speeds = [spectrum.speed_rpm for spectrum in kind]
                twice = {speed for speed in speeds if speeds.count(speed) > 1}
                if twice:
                    yield f"microphone {name}: {min(twice):g} rpm is there twice"

    @property
    def measured_at(self) -> tuple[str, ...]:
        """Microphones, each once."""
        of_bands = [spectrum.microphone for spectrum in self.third_octaves]
        return tuple(dict.fromkeys([*of_bands, *(row.microphone for row in self.orders)]))

    @property
    def all_orders(self) -> tuple[float, ...]:
        """Orders that were measured at any microphone, rising."""
        return tuple(sorted({order for row in self.orders for order in row.order}))

    def spectra_at(self, microphone: str) -> list[BaselineSpectrum]:
        """Third octaves at a microphone, by rising speed."""
        here = (spectrum for spectrum in self.third_octaves if spectrum.microphone == microphone)
        return sorted(here, key=lambda spectrum: spectrum.speed_rpm)

    def orders_at(self, microphone: str) -> list[BaselineOrders]:
        """Orders at a microphone, by rising speed."""
        here = (row for row in self.orders if row.microphone == microphone)
        return sorted(here, key=lambda row: row.speed_rpm)

    def covers(self, microphone: str, speed_rpm: float) -> bool:
        """Whether all that was measured at a microphone reaches a speed."""
        kinds = (self.spectra_at(microphone), self.orders_at(microphone))
        speeds = [[row.speed_rpm for row in kind] for kind in kinds if kind]
        return bool(speeds) and all(
            min(measured) * (1.0 - SPEED_TOLERANCE)
            <= speed_rpm
            <= max(measured) * (1.0 + SPEED_TOLERANCE)
            for measured in speeds
        )


class MeasuredSound(Parameters):
    """Sound that was measured of the machine, in place of what is assumed."""

    baseline: Baseline | None = None
    floor: MeasuredFloor | None = None
    """Mobility under the feet."""
    sound: MeasuredSoundPath | None = None
    """Pressure per force, in place of radiation and room."""
    shell: MeasuredShell | None = None
    """Hammer tests, which weigh the samples."""

    def problems(self, receivers: Sequence[str], speeds: Sequence[float]) -> Iterator[str]:
        """Yield why it does not fit a study: microphones that it has not, no speed that is
        covered."""
        yield from () if self.sound is None else self.sound.problems(receivers)
        if self.baseline is None:
            return
        for name in dict.fromkeys([*self.baseline.measured_at, *self.baseline.microphones]):
            where = f"measured.baseline: microphone {name}"
            if name not in receivers:
                yield f"{where}: not among the receivers ({', '.join(receivers)})"
            elif name not in self.baseline.measured_at:
                yield f"{where}: the files hold nothing of it"
            elif not any(self.baseline.covers(name, speed) for speed in speeds):
                measured_rpm = [spectrum.speed_rpm for spectrum in self.baseline.spectra_at(name)]
                measured_rpm += [row.speed_rpm for row in self.baseline.orders_at(name)]
                yield (
                    f"{where}: speed_rpm = {', '.join(f'{speed:g}' for speed in speeds)} rpm "
                    f"lies outside its {min(measured_rpm):g} to {max(measured_rpm):g} rpm"
                )
