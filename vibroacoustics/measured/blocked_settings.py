"""Settings of a file for `blocked-forces`."""

from collections.abc import Iterator
from pathlib import Path

from pydantic import Field, model_validator

from ..base.parameters import Parameters
from ..study.settings_file import settings_of
from ..study.toml_files import read_toml
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
