"""A study: one machine, its operating points, options, microphones and scoring."""

from typing import Any

from pydantic import Field, model_validator

from ..base.parameters import Parameters
from ..mechanics.capabilities import OldhamRing
from ..schema import REFERENCE_OPTION
from ..units import shaft_frequency_hz
from .inside import InsideSettings
from .machine import AnyMachine, Machine
from .option import AnyOption, Option
from .radiation import RadiationSettings
from .receivers import Receiver
from .scoring import Scoring, check_given, check_scales
from .sound_power import DirectivitySettings, MapSettings, SoundPowerSettings


class Operation(Parameters):
    speed_rpm: tuple[float, ...] = Field(min_length=1, max_length=100)
    crank_angle_samples: int = Field(default=256, ge=64, le=65536)
    maximum_order: int = Field(default=40, ge=2, le=1000)

    @model_validator(mode="after")
    def _speeds(self) -> "Operation":
        for speed in self.speed_rpm:
            if not 60.0 <= speed <= 60000.0:
                raise ValueError(f"speed_rpm = {speed:g} rpm: allowed 60 to 60000 rpm")
        if len(set(self.speed_rpm)) < len(self.speed_rpm):
            raise ValueError("speed_rpm lists a speed twice")
        if 2 * self.maximum_order >= self.crank_angle_samples:
            raise ValueError(
                f"maximum_order = {self.maximum_order}: must be below half of "
                f"crank_angle_samples = {self.crank_angle_samples}"
            )
        return self


class ParameterRecord(Parameters):
    """Where a value comes from: one row of the assumptions table."""

    file: str
    field: str
    value: str
    unit: str
    source: str
    lowest: float | None = None
    highest: float | None = None

    @property
    def assumed(self) -> bool:
        return self.source.startswith("assumed")


class Study(Parameters):
    title: str = Field(min_length=1)
    machine: AnyMachine
    operation: Operation
    options: dict[str, AnyOption]
    receivers: dict[str, Receiver] = Field(min_length=1)
    catalogue_receiver: str
    radiation: RadiationSettings
    scoring: Scoring
    given: dict[str, dict[str, float]] = Field(default={})
    """Values of criteria that are judged, not computed, by option and criterion."""
    sound_power: SoundPowerSettings | None = None
    map: MapSettings | None = None
    directivity: DirectivitySettings | None = None
    inside: InsideSettings | None = None
    """Inner sources and the elastic shell; none for the rigid machine alone."""
    records: tuple[ParameterRecord, ...] = ()
    source_file: str = ""

    @model_validator(mode="after")
    def _consistent(self) -> "Study":
        reference = self.options.get(REFERENCE_OPTION)
        if reference is None or reference.kind != REFERENCE_OPTION:
            raise ValueError('options: an option named none with kind = "none" is required')
        for name, option in self.options.items():
            self._check_fits(name, option)
        check_given(self.given, self.options)
        check_scales(self.scoring, self.given, self.options)
        if self.catalogue_receiver not in self.receivers:
            raise ValueError(
                f"catalogue_receiver = {self.catalogue_receiver}: not among the receivers "
                f"({', '.join(self.receivers)})"
            )
        microphone = self.receivers[self.catalogue_receiver]
        distance = self.machine.shell.distance_m(
            microphone.x_m, microphone.y_m, microphone.height_m
        )
        published = self.machine.overall_noise
        if not 0.95 <= distance / published.distance_m <= 1.05:
            raise ValueError(
                f"catalogue_receiver = {self.catalogue_receiver}: stands {distance:.3g} m from the "
                f"shell; the overall noise holds at {published.distance_m:g} m"
            )
        highest = self.operation.maximum_order * shaft_frequency_hz(max(self.operation.speed_rpm))
        if highest > self.radiation.maximum_frequency_hz:
            raise ValueError(
                f"radiation.maximum_frequency_hz = {self.radiation.maximum_frequency_hz:g} Hz: "
                f"order {self.operation.maximum_order} reaches {highest:g} Hz"
            )
        self._check_inside()
        surroundings = self.radiation.surroundings
        if self.sound_power and (surroundings.walls or surroundings.cabinet):
            raise ValueError(
                "sound_power: ISO 3744 measures over a hard floor alone; "
                "radiation.surroundings has walls or a cabinet"
            )
        if published.speed_rpm not in self.operation.speed_rpm:
            raise ValueError(
                "operation.speed_rpm: must include the speed of the overall noise, "
                f"{published.speed_rpm:g} rpm, to fix the remainder"
            )
        return self

    def _check_inside(self) -> None:
        """Refuse inner sources that do not belong to the machine."""
        if self.inside is None:
            return
        if self.machine.capability(OldhamRing) is None:
            raise ValueError(
                f"inside: needs a scroll with an Oldham ring; the machine is {self.machine.kind}"
            )
        if len(self.inside.line_frequency_hz) != len(self.operation.speed_rpm):
            raise ValueError(
                f"inside.line_frequency_hz: {len(self.inside.line_frequency_hz)} values for "
                f"{len(self.operation.speed_rpm)} speeds; one is needed for each"
            )
        twice = 2.0 * max(self.inside.line_frequency_hz)
        if twice > self.radiation.maximum_frequency_hz:
            raise ValueError(
                f"radiation.maximum_frequency_hz = {self.radiation.maximum_frequency_hz:g} Hz: "
                f"twice the line frequency is {twice:g} Hz"
            )
        self._check_orbit("", self.machine, self.inside)
        for name, option in self.options.items():
            machine = option.applied_to(self.machine)
            self._check_orbit(f"options.{name}.change: ", machine, self.inside)

    def _check_orbit(self, where: str, machine: Machine, settings: InsideSettings) -> None:
        """Refuse a machine that does not orbit as the wraps of the inside do."""
        orbit = machine.require(OldhamRing).stroke_m
        wraps = settings.inside.wraps.orbit_radius_m
        if abs(orbit - wraps) > 0.01 * wraps:
            raise ValueError(
                f"{where}inside: its wraps orbit at {1e3 * wraps:.4g} mm; the machine's "
                f"kinematics.orbit_radius_mm = {1e3 * orbit:.4g} mm: must agree within 1 %"
            )

    def _check_fits(self, name: str, option: Option) -> None:
        """Refuse an option that the machine has no part for, or that changes what all share."""
        needed = option.needs
        if needed is not None and self.machine.capability(needed) is None:
            raise ValueError(
                f"options.{name}.kind = {option.kind}: needs {needed.words}; the machine is "
                f"{self.machine.kind}"
            )
        changed = option.applied_to(self.machine)
        for table in ("shell", "overall_noise"):
            if getattr(changed, table) != getattr(self.machine, table):
                raise ValueError(
                    f"options.{name}.change.{table}: all options radiate from one shell and share "
                    "one overall noise; make a study of its own"
                )

    def parameters(self) -> dict[str, Any]:
        """All parameters as plain JSON values."""
        return self.model_dump(mode="json")
