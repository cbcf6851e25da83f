"""Settings of a file for `predict`."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any, Literal

import numpy as np
from pydantic import Field, model_validator

from ..base.arrays import Array, ComplexArray
from ..base.parameters import Parameters
from ..machine.feet import MountStiffness
from ..study.settings_file import settings_of
from ..study.toml_files import beside, read_toml
from .change import mount_stiffness


class Point(Parameters):
    """A node of the measured functions and the direction that counts as positive."""

    node: int = Field(ge=0, le=999_999_999)
    direction: Literal["+x", "-x", "+y", "-y", "+z", "-z", ""] = ""


class FreeMachine(Parameters):
    """Machine that hangs freely, or as good as freely, in a range of frequency."""

    mass_kg: float = Field(gt=0.0, le=1e6)
    points: tuple[str, ...] = Field(min_length=3)
    """Points on it in one direction, not in line."""
    lowest_frequency_hz: float = Field(gt=0.0, le=1e6)
    highest_frequency_hz: float = Field(gt=0.0, le=1e6)


class Measured(Parameters):
    """Files of measured functions, how good they are, and what their nodes are."""

    frequency_responses: tuple[str, ...] = Field(min_length=1)
    operating: tuple[str, ...] = Field(min_length=1)
    units: dict[str, str] = Field(default_factory=dict)
    spectra: Literal["peak", "rms"] = "peak"
    averages: int | None = Field(default=None, ge=1, le=1_000_000)
    operating_averages: int | None = Field(default=None, ge=1, le=1_000_000)
    relative_error_ratio: float | None = Field(default=None, ge=0.0, le=1.0)
    lowest_frequency_hz: float = Field(default=0.0, ge=0.0, le=1e6)
    highest_frequency_hz: float = Field(default=1e6, gt=0.0, le=1e6)
    truncation_ratio: float | None = Field(default=None, ge=0.0, le=0.5)
    draws: int = Field(default=200, ge=50, le=5000)
    points: dict[str, Point] = Field(min_length=1)
    microphones: dict[str, Point] = Field(min_length=1)
    free_machine: FreeMachine | None = None

    @model_validator(mode="after")
    def _free_machine_has_points(self) -> "Measured":
        names = () if self.free_machine is None else self.free_machine.points
        for name in names:
            if name not in self.points:
                listed = ", ".join(self.points)
                raise ValueError(f"free_machine.points = {name}: must be one of {listed}")
        if len({self.points[name].direction[-1:] for name in names}) > 1:
            raise ValueError("free_machine.points: must have one direction")
        return self


class NewMount(Parameters):
    """Mount in place of another; of stiffness zero where it is removed."""

    stiffness_n_per_m: float | None = Field(default=None, ge=0.0, le=1e12)
    loss_factor_ratio: float = Field(default=0.0, ge=0.0, le=2.0)
    stiffness: MountStiffness | None = None
    """Stiffness over frequency, in place of the constant one."""

    @model_validator(mode="after")
    def _one_stiffness(self) -> "NewMount":
        if (self.stiffness is None) == (self.stiffness_n_per_m is None):
            raise ValueError("needs either stiffness_n_per_mm or a table stiffness with a file")
        if self.stiffness is not None and "loss_factor_ratio" in self.model_fields_set:
            raise ValueError("loss_factor_percent: is in the file of the stiffness, take it out")
        return self

    def dynamic_stiffness(self, frequency_hz: Array, direction: str) -> ComplexArray:
        """k (1 + jη), N/m, shape (frequency,); of a file its vertical one along z.

        Parameters
        ----------
        frequency_hz : above zero, shape (frequency,)
        direction : direction of the mount, `+x` to `-z`
        """
        if self.stiffness is not None:
            axis = "xyz".index(direction[-1:] or "z")
            return np.asarray(self.stiffness.dynamic_stiffness(frequency_hz)[:, axis])
        return mount_stiffness(frequency_hz, self.stiffness_n_per_m or 0.0, self.loss_factor_ratio)


class MountBetween(NewMount):
    """A mount along one direction between two points, as it was measured."""

    ends: tuple[str, str]
    stiffness_n_per_m: float | None = Field(default=None, gt=0.0, le=1e12)


class AddedMass(Parameters):
    """A mass that moves with each of these points: the directions of one place."""

    points: tuple[str, ...] = Field(min_length=1)
    mass_kg: float = Field(gt=0.0, le=1e5)


class Absorber(Parameters):
    """A mass on a spring at each of these points: the directions of one place."""

    points: tuple[str, ...] = Field(min_length=1)
    mass_kg: float = Field(gt=0.0, le=1e5)
    stiffness_n_per_m: float = Field(gt=0.0, le=1e12)
    loss_factor_ratio: float = Field(gt=0.0, le=2.0)


class Change(Parameters):
    """Mounts that are others, masses and absorbers that are added."""

    mounts: dict[str, NewMount] = Field(default_factory=dict)
    masses: dict[str, AddedMass] = Field(default_factory=dict)
    absorbers: dict[str, Absorber] = Field(default_factory=dict)


class Prediction(Parameters):
    """Measurements, the mounts that they were made on, and changes to predict."""

    title: str = Field(min_length=1, max_length=200)
    measured: Measured
    mounts: dict[str, MountBetween] = Field(default_factory=dict)
    changes: dict[str, Change] = Field(min_length=1)

    @model_validator(mode="after")
    def _names_are_known(self) -> "Prediction":
        problem = next(self._problems(), None)
        if problem is not None:
            raise ValueError(problem)
        return self

    def _problems(self) -> Iterator[str]:
        """Yield names that do not exist, or nothing."""
        points = self.measured.points
        named: list[tuple[str, tuple[str, ...]]] = [
            (f"mounts.{name}.ends", mount.ends) for name, mount in self.mounts.items()
        ]
        for name, change in self.changes.items():
            if name == "none":
                yield "changes.none: is the name of the state as measured"
            if not (change.mounts or change.masses or change.absorbers):
                yield f"changes.{name}: changes nothing: needs mounts, masses or absorbers"
            for mount in change.mounts:
                if mount not in self.mounts:
                    listed = ", ".join(self.mounts) or "none"
                    yield f"changes.{name}.mounts.{mount}: no such mount; known are {listed}"
            added = [(f"masses.{key}", mass.points) for key, mass in change.masses.items()]
            added += [(f"absorbers.{key}", each.points) for key, each in change.absorbers.items()]
            named += [(f"changes.{name}.{part}.points", used) for part, used in added]
        for where, used in named:
            for point in used:
                if point not in points:
                    listed = ", ".join(points)
                    yield f"{where} = {point}: no such point; measured.points has {listed}"
            if len(set(used)) < len(used):
                yield f"{where}: names a point twice"


def name_files_beside(path: Path, content: Any) -> None:
    """Make names of files of mounts relative to the file that gives them, at any depth."""
    for key, value in content.items() if isinstance(content, dict) else ():
        if key == "stiffness" and isinstance(value, dict) and isinstance(value.get("file"), str):
            value["file"] = str(beside(path, value["file"]))
        name_files_beside(path, value)


def load_prediction(path: Path) -> Prediction:
    """Read a file for `predict`; docs/measured_changes.md has its tables."""
    content = read_toml(path)
    name_files_beside(path, content)
    return settings_of(Prediction, path, content)
