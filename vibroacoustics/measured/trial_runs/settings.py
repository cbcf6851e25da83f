"""File of runs with trial weights, for `balance`; docs/balancing.md has its tables."""

from collections.abc import Iterator
from pathlib import Path
from typing import Literal

import numpy as np
from pydantic import Field

from ...base.errors import ParameterError
from ...base.parameters import Contradictions, Parameters
from ...base.units import split_key
from ...recordings.quantities import QUANTITIES, find_quantity
from ...study.settings_file import settings_of
from ...study.toml_files import beside, read_toml
from ..campaign_settings import (
    CalibratorSettings,
    Campaign,
    ChannelSettings,
    PartSettings,
    SpeedSettings,
    resolve_settings_files,
)
from .reading_text import Amplitudes, check_words, parsed

Angles = Literal["with rotation", "against rotation", "clockwise", "counterclockwise"]
Turns = Literal["clockwise", "counterclockwise"]


class Rotor(Parameters):
    """Rotor that is balanced."""

    mass_kg: float | None = Field(default=None, gt=0.0, le=1e6)
    service_speed_rpm: float | None = Field(default=None, gt=0.0, le=1e6)


class Plane(Parameters):
    """Plane of weights."""

    radius_m: float = Field(gt=0.0, le=10.0)
    zero_rad: float = Field(default=0.0, ge=-7.0, le=7.0)
    """Angle of the plane's zero from the mark on the shaft."""
    holes: int | None = Field(default=None, ge=1, le=720)
    hole_angles_rad: tuple[float, ...] | None = Field(default=None, min_length=1, max_length=720)
    masses_kg: tuple[float, ...] = Field(default=(), max_length=50)
    """Masses that are available; any without it."""
    maximum_mass_kg: float | None = Field(default=None, gt=0.0, le=1e4)

    def contradictions(self) -> Contradictions:
        if self.holes is not None and self.hole_angles_rad is not None:
            yield "give one of holes and hole_angles_deg"
        if self.masses_kg and self.holes is None and self.hole_angles_rad is None:
            yield "masses_g: need holes or hole_angles_deg"
        if self.masses_kg and min(self.masses_kg) <= 0.0:
            yield "masses_g: must be above 0 g"
        elif self.masses_kg and min(self.masses_kg) > (self.maximum_mass_kg or np.inf):
            yield "masses_g: one must be at most maximum_mass_g"


class Sensor(Parameters):
    """Sensor of the readings; limit and scatter in its unit and of the kind of the amplitudes."""

    unit: str = Field(min_length=1, max_length=20)
    limit: float | None = Field(default=None, gt=0.0, le=1e12)
    scatter: float | None = Field(default=None, gt=0.0, le=1e12)
    """Standard deviation of a reading's real and of its imaginary part."""
    receiver: str | None = Field(default=None, min_length=1, max_length=100)
    """Microphone of the study that it is."""
    foot: str | None = Field(default=None, min_length=1, max_length=100)
    """Foot of the study whose force it measures."""
    position_m: tuple[float, float, float] | None = None
    """Position on the body, from its centre of mass at rest in the machine's axes."""
    axis: Literal["x", "y", "z"] | None = None

    def contradictions(self) -> Contradictions:
        if find_quantity(self.unit) is None:
            yield f"unit = {self.unit}: must be one of {', '.join(QUANTITIES)}"
        in_study = (self.receiver, self.foot, self.position_m)
        if sum(each is not None for each in in_study) > 1:
            yield "give one of receiver, foot and position_mm"
        if (self.axis is None) == (self.foot is not None or self.position_m is not None):
            yield "axis: belongs to foot or position_mm"


class RunWeight(Parameters):
    """Weight that a run adds."""

    plane: str | None = None
    mass_kg: float = Field(gt=0.0, le=1e4)
    angle_rad: float | None = Field(default=None, ge=-13.0, le=13.0)
    hole: int | None = Field(default=None, ge=1, le=720)
    radius_m: float | None = Field(default=None, gt=0.0, le=10.0)

    def contradictions(self) -> Contradictions:
        if (self.angle_rad is None) == (self.hole is None):
            yield "give one of angle_deg and hole"


class Run(Parameters):
    """Run: its weights, and readings by speed and sensor or recordings."""

    weights: dict[str, RunWeight] = Field(default_factory=dict)
    weights_stay: bool | None = None
    """Whether its weights stay in afterwards; default: as `trial_weights` says."""
    readings: dict[str, dict[str, str]] = Field(default_factory=dict)
    recordings: tuple[str, ...] = ()

    def contradictions(self) -> Contradictions:
        if bool(self.readings) == bool(self.recordings):
            yield "give one of readings and recordings"
        for speed in self.readings:
            if not speed.isdecimal() or not 1 <= int(speed) <= 1_000_000:
                yield f"readings.{speed}: must be a speed of 1 to 1000000 rpm"


class StudyOfMachine(Parameters):
    """Study whose samples give influence coefficients before any run."""

    file: str
    option: str
    samples: int = Field(default=60, ge=10, le=1000)
    tacho_rad: float = Field(default=0.0, ge=-7.0, le=7.0)
    """Angle of the tacho from the x axis of the study, with the rotation."""
    results: str | None = None
    """Results of a run of the study, which give the total levels."""


class TrialRuns(Parameters):
    """Runs with trial weights of a machine, its planes and sensors."""

    title: str = Field(default="Balancing", min_length=1, max_length=200)
    amplitudes: Amplitudes
    phases: Literal["lag", "lead"]
    angles: Angles
    rotation: Turns = "counterclockwise"
    trial_weights: Literal["removed", "left in"]
    answer: Literal["least squares", "least worst"] = "least squares"
    rotor: Rotor = Rotor()
    planes: dict[str, Plane] = Field(min_length=1, max_length=20)
    sensors: dict[str, Sensor] = Field(min_length=1, max_length=50)
    runs: dict[str, Run] = Field(min_length=1, max_length=200)
    study: StudyOfMachine | None = None
    channels: dict[str, ChannelSettings] = Field(default_factory=dict)
    calibrator: CalibratorSettings = CalibratorSettings()
    recording: PartSettings = PartSettings()
    speed: SpeedSettings | None = None

    @property
    def sense(self) -> float:
        """One where angles count with the rotation, minus one where they count against it."""
        if self.angles in ("with rotation", "against rotation"):
            return 1.0 if self.angles == "with rotation" else -1.0
        return 1.0 if self.angles == self.rotation else -1.0

    def campaign(self) -> Campaign:
        """Return how recordings are read."""
        return Campaign(
            channels=self.channels,
            calibrator=self.calibrator,
            recording=self.recording,
            speed=self.speed,
        )

    def stays(self, run: Run) -> bool:
        """Whether the weights of a run stay in after it."""
        return self.trial_weights == "left in" if run.weights_stay is None else run.weights_stay

    def contradictions(self) -> Contradictions:
        for name in self.sensors:
            unit = split_key(name)[1]
            if unit is not None:
                yield f"sensors.{name}: ends in the unit {unit.symbol}: choose another name"
        for name, run in self.runs.items():
            yield from (f"runs.{name}.{problem}" for problem in self._problems(run))

    def _problems(self, run: Run) -> Iterator[str]:
        """Names and readings of a run that do not fit."""
        for name, weight in run.weights.items():
            plane = self.planes.get(weight.plane or name)
            if plane is None:
                yield (
                    f"weights.{name}: no plane {weight.plane or name}; known are "
                    f"{', '.join(self.planes)}"
                )
            elif weight.hole is not None and weight.hole > len(hole_angles_rad(plane)):
                count = len(hole_angles_rad(plane))
                yield f"weights.{name}.hole = {weight.hole}: must be 1 to {count}"
        for speed, readings in run.readings.items():
            for sensor, text in readings.items():
                where = f"readings.{speed}.{sensor}"
                if sensor not in self.sensors:
                    yield f"{where}: no such sensor; known are {', '.join(self.sensors)}"
                    continue
                try:
                    check_words(parsed(text), self.sensors[sensor].unit, self.amplitudes)
                except ParameterError as error:
                    yield f"{where} = {text}: {error}"
        if run.recordings and self.speed is None:
            yield "recordings: need a table [speed] with the tacho's channel"


def hole_angles_rad(plane: Plane) -> tuple[float, ...]:
    """Angles of the holes of a plane from its zero; empty where any angle is possible."""
    if plane.hole_angles_rad is not None:
        return plane.hole_angles_rad
    holes = plane.holes or 0
    return tuple((2.0 * np.pi * np.arange(holes) / max(holes, 1)).tolist())


def load_trial_runs(path: Path) -> TrialRuns:
    """Read a file for `balance`; docs/balancing.md has its tables.

    Raises
    ------
    ParameterError
        Anything is missing, unknown, of the wrong type or outside its allowed range.
    """
    content = read_toml(path)
    if "runs" not in content:
        raise ParameterError(
            f"{path}: has no runs: must have tables [runs.NAME], [planes.NAME] and [sensors.NAME]; "
            "`vibroacoustics new balance` writes a file to begin with"
        )
    resolve_settings_files(path, content)
    study = content.get("study")
    if isinstance(study, dict):
        for key in ("file", "results"):
            if isinstance(study.get(key), str):
                study[key] = str(beside(path, study[key]))
    return settings_of(TrialRuns, path, content)
