"""Settings of `blocked-forces`, and functions measured on a source where it stands."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from pydantic import Field, model_validator

from ..base.arrays import Array, ComplexArray, IndexArray
from ..base.parameters import Parameters
from ..recordings import Node
from ..study.settings_file import settings_of
from ..study.toml_files import read_toml
from .assembly import node_of
from .grouped import signs, unsigned
from .inversion import rigid_forces, rigid_wrench
from .library import Library
from .settings import Measured, Point


class MeasuredBench(Measured):
    """Measurements that need no microphone."""

    microphones: dict[str, Point] = Field(default_factory=dict)


class Position(Parameters):
    """Position of a point, from the machine's centre of mass at rest, in its axes."""

    x_m: float = Field(ge=-10.0, le=10.0)
    y_m: float = Field(ge=-10.0, le=10.0)
    z_m: float = Field(ge=-10.0, le=10.0)


class Interface(Parameters):
    """Interface at which a source hands its forces on, and the nodes of inversion and
    validation."""

    points: tuple[str, ...] = Field(min_length=1)
    responses: tuple[str, ...] = Field(min_length=1)
    validation: tuple[str, ...] = Field(min_length=1)
    rigid_source: bool = False
    """Whether the points move as one rigid body, so that only its force and moment count."""
    speed_rpm: float | None = Field(default=None, ge=60.0, le=60000.0)
    """Speed at which it ran; its orders are written where it is given."""
    positions: dict[str, Position] = Field(default_factory=dict)


class BlockedForces(Parameters):
    """Measurements on a source where it stands, and its interface."""

    title: str = Field(min_length=1, max_length=200)
    measured: MeasuredBench
    blocked_forces: Interface

    @model_validator(mode="after")
    def _names_are_known(self) -> "BlockedForces":
        problem = next(self._problems(), None)
        if problem is not None:
            raise ValueError(problem)
        return self

    def _problems(self) -> Iterator[str]:
        """Yield names that do not exist or do not fit, or nothing."""
        interface, measured = self.blocked_forces, self.measured
        in_both_tables = set(measured.points) & set(measured.microphones)
        if in_both_tables:
            yield f"measured.microphones.{min(in_both_tables)}: is the name of a point too"
        for field, names_of_kind in {
            "points": [*measured.points],
            "responses": [*measured.points],
            "validation": [*measured.points, *measured.microphones],
        }.items():
            names: tuple[str, ...] = getattr(interface, field)
            for name in names:
                if name not in names_of_kind:
                    yield (
                        f"blocked_forces.{field} = {name}: no such point; known are "
                        f"{', '.join(names_of_kind)}"
                    )
            if len(set(names)) < len(names):
                yield f"blocked_forces.{field}: names a point twice"
        for name in interface.validation:
            if name in interface.responses:
                yield (
                    f"blocked_forces.validation = {name}: is among the responses that the forces "
                    "are inverted from, and validates nothing"
                )
        for name in sorted({*interface.points, *interface.positions}) * self.needs_positions:
            if name not in interface.positions or name not in interface.points:
                where = f"blocked_forces.positions.{name}"
                yield f"{where}: must be one of each of blocked_forces.points, and none else"
            elif not measured.points[name].direction:
                yield f"measured.points.{name}: needs a direction, as a force has one"

    @property
    def needs_positions(self) -> bool:
        """Whether positions of the points are required, or the file has some."""
        interface = self.blocked_forces
        is_mount_model = interface.rigid_source or interface.speed_rpm is not None
        return is_mount_model or bool(interface.positions)


def load_blocked_forces(path: Path) -> BlockedForces:
    """Read a file for `blocked-forces`; docs/blocked_forces.md has its tables."""
    content = read_toml(path)
    return settings_of(BlockedForces, path, content)


@dataclass(frozen=True)
class Measurement:
    """Responses per force and while the source runs, along the points' directions.

    Attributes
    ----------
    compliance : compliance of the responses, m/N, shape (frequency, response, force)
    operating : operating of the responses, m, shape (frequency, response)
    transfer : transfer of the validation, m/N or Pa/N, shape (frequency, validation, force)
    validation : m or Pa, shape (frequency, validation)
    """

    compliance: ComplexArray
    operating: ComplexArray
    transfer: ComplexArray
    validation: ComplexArray


@dataclass(frozen=True)
class InSitu:
    """Measurements, each function once, and which of them is where.

    Attributes
    ----------
    frequency_hz : shape (frequency,)
    values, error : functions and the RMS of their complex error, shape (function, frequency)
    compliance, transfer : numbers of functions, shapes (response, force) and (validation, force)
    operating, validation : numbers of functions, shapes (response,) and (validation,)
    forces, responses, validations : signs of directions, shapes (force,), (response,) and
        (validation,)
    sets : sets of forces that are solved for, shape (force, set)
    faults : a line for each fault that was accepted
    """

    frequency_hz: Array
    values: ComplexArray
    error: Array
    compliance: IndexArray
    transfer: IndexArray
    operating: IndexArray
    validation: IndexArray
    forces: Array
    responses: Array
    validations: Array
    sets: Array
    faults: tuple[str, ...] = ()

    def measurement(self, values: ComplexArray) -> Measurement:
        """The matrices of functions with some values, shape (function, frequency)."""
        by_line = values.T
        forces = self.forces[:, None] * self.sets
        return Measurement(
            self.responses[:, None] * by_line[:, self.compliance] @ forces,
            self.responses * by_line[:, self.operating],
            self.validations[:, None] * by_line[:, self.transfer] @ forces,
            self.validations * by_line[:, self.validation],
        )


def read_in_situ(settings: BlockedForces, folder: Path, despite: Sequence[str] = ()) -> InSitu:
    """The functions that blocked forces and their validation need.

    Parameters
    ----------
    settings : files, nodes and interface
    folder : folder of the files
    despite : names of faults that are accepted
    """
    interface, measured = settings.blocked_forces, settings.measured
    library = Library(measured, folder, despite)
    nodes = measured.points | measured.microphones
    forces, responses, validations = (
        [node_of(nodes[name]) for name in names]
        for names in (interface.points, interface.responses, interface.validation)
    )
    units = [unit_of(settings, name) for name in interface.validation]

    def numbers(nodes: Sequence[Node], units: Sequence[str]) -> tuple[IndexArray, IndexArray]:
        pairs = [(unsigned(node), unit) for node, unit in zip(nodes, units, strict=True)]
        by_force = [
            [library.response(node, unsigned(force), unit) for force in forces]
            for node, unit in pairs
        ]
        return np.array(by_force), np.array([library.operating(*pair) for pair in pairs])

    compliance, operating = numbers(responses, ["m"] * len(responses))
    transfer, validation = numbers(validations, units)
    values, errors = library.estimates
    every_force = list(range(len(forces)))
    nodes_of_responses = [unsigned(node) for node in responses]
    library.compare_operating(compliance, operating, nodes_of_responses, [every_force])
    sets = np.eye(len(forces))
    if interface.rigid_source:
        sets = rigid_forces(wrench_per_force(settings))
    return InSitu(
        frequency_hz=library.frequency_hz,
        values=values,
        error=errors,
        compliance=compliance,
        operating=operating,
        transfer=transfer,
        validation=validation,
        forces=signs(forces),
        responses=signs(responses),
        validations=signs(validations),
        sets=sets,
        faults=tuple(library.remarks),
    )


def unit_of(settings: BlockedForces, name: str) -> str:
    """Unit of what a point or a microphone measures: m or Pa."""
    return "m" if name in settings.measured.points else "Pa"


def wrench_per_force(settings: BlockedForces) -> Array:
    """Force and moment about the centre of mass per force at each point, shape (6, point)."""
    interface = settings.blocked_forces
    positions = [interface.positions[name] for name in interface.points]
    directions = [settings.measured.points[name].direction for name in interface.points]
    vectors = [
        [(-1.0 if along[0] == "-" else 1.0) * float(along[-1] == each) for each in "xyz"]
        for along in directions
    ]
    return rigid_wrench(
        np.array([(position.x_m, position.y_m, position.z_m) for position in positions]),
        np.array(vectors),
    )
