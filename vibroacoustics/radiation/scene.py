"""Scene of the radiation: the radiating body, what is around it, and the walls."""

import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Final

import numpy as np

from ..base.errors import ParameterError
from ..base.regular_file import opened
from ..machine.shell import Shell
from ..study.body import (
    BoxBody,
    MeshBody,
    RadiatingBody,
    SphereBody,
)
from ..study.radiation import RadiationSettings
from ..study.receivers import Receiver
from .arrays import Array, ComplexArray
from .bodies import Body, block, join_bodies, read_mesh, sphere, turned
from .cabinet import cabinet_panels, check_fits
from .exact import Mirror, green_rows
from .outdoors.green import Outdoors, check_barrier, outdoors_of
from .patterns import Pattern, sampled
from .surface_points import SurfacePoints

NEAR_WALL_M: Final = 0.5
"""Hard walls up to this far from the body belong to the machine side; see `Scene.near_walls`."""
_LEAST_GAP_M: Final = 0.01
_LARGEST_PATTERN_FILE_BYTES: Final = 100 * 2**20


@dataclass(frozen=True)
class Scene:
    """Radiating and scattering bodies on the machine side, about the machine's centre of mass."""

    machine: Body
    """The moving surface."""
    panels: tuple[Body, ...]
    """Those of a cabinet, which stand still."""
    walls: tuple[Mirror, ...]
    outdoors: Outdoors | None = None
    """Surroundings in place of the hard floor on the path to the microphones."""

    @property
    def upright_walls(self) -> tuple[Mirror, ...]:
        """Those but the floor."""
        return tuple(wall for wall in self.walls if wall.axis != 2)

    def green_rows(
        self, points: Array, receivers: Array, frequency_hz: Array
    ) -> Iterator[ComplexArray]:
        """Green's functions in closed form, (receiver, point), one frequency after the other.

        Parameters
        ----------
        points : points about the machine, shape (point, 3), m
        receivers : positions of the microphones, shape (receiver, 3), m
        frequency_hz : shape (frequency,)
        """
        if self.outdoors is None:
            return green_rows(points, receivers, frequency_hz, self.walls)
        return self.outdoors.rows(points, receivers, frequency_hz, self.upright_walls)

    @cached_property
    def body(self) -> Body:
        """The machine's surface and, after its faces, the panels."""
        return join_bodies([self.machine, *self.panels])

    @property
    def near_walls(self) -> tuple[Mirror, ...]:
        """Walls whose echo the machine scatters again: hard ones next to it, the floor always.

        The echo of the others is not scattered again.
        """
        corners = np.stack(self.body.bounds())
        return tuple(
            wall
            for wall in self.walls
            if wall.hard and (wall.axis == 2 or wall.depth_m(corners).min() <= NEAR_WALL_M)
        )

    def moving(self, pattern: Pattern) -> Pattern:
        """The pattern on the machine's faces, and rest on the others."""

        def velocity(points: SurfacePoints) -> Array:
            on_machine = points.face < self.machine.faces.shape[0]
            result = np.zeros(points.position.shape)
            result[on_machine] = pattern.velocity(points.where([on_machine]))
            return result

        return Pattern(pattern.name, velocity)


def scene(shell: Shell, settings: RadiationSettings) -> Scene:
    """The scene of a study's shell and radiation settings.

    Raises
    ------
    ParameterError
        A mesh cannot be read, is open or inverted; the machine meets a wall, the floor or a panel.
    """
    machine = machine_body(shell, settings.body)
    walls = room_walls(shell, settings)
    lower, upper = machine.bounds()
    for wall in walls:
        gap = min(float(wall.depth_m(lower)), float(wall.depth_m(upper)))
        least = 0.0 if wall.axis == 2 else _LEAST_GAP_M
        if gap < least - 1e-9:
            raise ParameterError(
                f"radiation.surroundings: the machine is {1e3 * gap:.4g} mm off the wall across "
                f"{'xyz'[wall.axis]}; needed at least {1e3 * least:g} mm"
            )
    cabinet = settings.surroundings.cabinet
    outdoors = outdoors_of(shell, settings.surroundings)
    if cabinet is not None:
        check_fits(machine, cabinet, shell.floor_z_m)
    panels = () if cabinet is None else tuple(cabinet_panels(cabinet, shell.floor_z_m))
    result = Scene(machine, panels, walls, outdoors)
    check_barrier(outdoors, np.stack(result.body.bounds()))
    if cabinet is not None and any(
        wall.depth_m(np.stack(result.body.bounds())).min() < -1e-9 for wall in walls
    ):
        raise ParameterError("radiation.surroundings.cabinet: its panels reach through a wall")
    return result


def machine_body(shell: Shell, body: RadiatingBody) -> Body:
    """The radiating surface about the centre of mass."""
    bottom = -shell.centre_of_mass_height_m
    if isinstance(body, BoxBody):
        half_length, half_width = body.length_m / 2.0, body.width_m / 2.0
        lower = np.array([-half_length, -half_width, bottom])
        return block(lower, np.array([half_length, half_width, bottom + body.height_m]))
    if isinstance(body, SphereBody):
        radius = body.diameter_m / 2.0
        return sphere(radius, (0.0, 0.0, bottom + radius))
    if isinstance(body, MeshBody):
        mesh = read_mesh(Path(body.file), body.file_unit_m)
        return Body(mesh.vertices + np.array([0.0, 0.0, bottom]), mesh.faces)
    return turned(shell.profile)


def file_patterns(body: RadiatingBody, machine: Body) -> list[Pattern]:
    """Surface velocities of a mesh that files give."""
    if not isinstance(body, MeshBody):
        return []
    return [
        sampled(name, machine, _read_velocities(name, Path(file)))
        for name, file in body.patterns.items()
    ]


def _read_velocities(name: str, path: Path) -> Array:
    where = f"radiation.body.patterns.{name}: {path}"
    try:
        with opened(path, _LARGEST_PATTERN_FILE_BYTES) as file, warnings.catch_warnings():
            warnings.simplefilter("error")  # an empty file is a warning to NumPy
            return np.loadtxt(file, delimiter=",", ndmin=1)
    except OSError as error:
        raise ParameterError(f"{where}: cannot be read: {error.strerror or error}") from None
    except (ValueError, UserWarning) as error:
        raise ParameterError(f"{where}: is no table of numbers: {error}") from None


def room_walls(shell: Shell, settings: RadiationSettings) -> tuple[Mirror, ...]:
    """Floor and walls as mirrors."""
    surroundings = settings.surroundings
    walls = [Mirror(axis=2, sign=-1, position_m=shell.floor_z_m)] if surroundings.floor else []
    for side, wall in surroundings.walls.items():
        sign = -1 if side[0] == "-" else 1
        reflection = float(np.sqrt(1.0 - wall.absorption_ratio))
        walls.append(Mirror("xyz".index(side[1]), sign, sign * wall.distance_m, reflection))
    return tuple(walls)


def position_m(shell: Shell, receiver: Receiver) -> Array:
    """Receiver (x, y, z) about the centre of mass; its height counts from the floor's level."""
    return np.array([receiver.x_m, receiver.y_m, shell.floor_z_m + receiver.height_m])
