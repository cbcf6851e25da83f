"""The machine side: sound pressure on a box around the vibrating body.

k-Wave's staggered grid, absorbing layer and split density, but with local differences, and with cut
cells at the wall: V dp/dt = -rho c² sum of A_f (u_f - v_wall) . n_f. A global (spectral) stencil
would leak the dead pressure inside the body into the sound field. The wall follows one broadband
pulse; dividing by the pulse's spectrum gives every frequency from a single run.

Hard walls next to the body, the floor first of all, are outermost planes of closed faces, so the
scattering between body and walls is part of the solution; what the rest of the room sends back to
the body is not.

Where the body is symmetric, only one half, quarter or eighth of the grid runs, once for each part
of the wall's flux that is even or odd along the mirrored axes: a rigid motion has one or two.
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property
from itertools import product
from typing import Final

import numpy as np

from ..base.constants import SPEED_OF_SOUND_M_PER_S
from ..base.progress import Progress, no_progress
from .arrays import Array, ComplexArray
from .bodies import Body
from .box import Box, closed_box
from .cut_cells import (
    GEOMETRY_BYTES_PER_CELL,
    MOST_WATCHED,
    CutCells,
    cut_cells,
    spread_points,
    watched_frequencies,
)
from .exact import Mirror, green_rows
from .near_grid import BOX_MARGIN_M, NearGrid, near_grid
from .near_run import Parity, PartField, Recording, Run, Watch, advance_run, recording
from .near_step import BYTES_PER_CELL, pulse_width_s, transform_bytes
from .patterns import Pattern
from .surface_points import surface_in_parts
from .symmetry import images, signs
from .wall_flux import wall_fluxes

_NO_PART: Final = 1e-4
"""Parts of a flux that are at most this share of it come from the surface's division: up to 9e-5
on a sphere of an icosahedron."""
_PIECES_PER_CELL: Final = 1
_ON_WALL: Final = 1e-6
"""Surface closer than this many cells to a wall stands on it."""


class NearField:
    """A body in its grid; the geometry is computed once, when needed, and serves every pattern."""

    def __init__(
        self,
        body: Body,
        spacing_m: float,
        maximum_frequency_hz: float,
        walls: Sequence[Mirror] = (),
        box_margin_m: float = BOX_MARGIN_M,
        cells_per_unit: int = 3,
        joins_floor: bool = False,
    ) -> None:
        grid = near_grid(body, spacing_m, walls, box_margin_m, cells_per_unit)
        self.grid: NearGrid = replace(grid, joins_floor=joins_floor)
        self._body = body
        self._walls = walls
        self.pulse_width_s = pulse_width_s(maximum_frequency_hz)

    @cached_property
    def box(self) -> Box:
        """The box through which the sound field leaves."""
        grid = self.grid
        sides = grid.on_walls, grid.joins_floor
        return closed_box(grid.edges, grid.box_start, grid.box_stop, *sides)

    @cached_property
    def recording(self) -> Recording:
        """Recording of the box in the upper half of the mirrored axes."""
        return recording(self.grid, self.box)

    def field_bytes(self, frequencies: int, parts: int) -> float:
        """Memory of a field of so many parts."""
        return 16.0 * frequencies * parts * 2.0 * self.grid.upper_half.box_pairs

    def memory_bytes(self, frequencies: int) -> tuple[float, float, float]:
        """Memory of the geometry, of a pattern's field at most, and of a run besides."""
        cells, upper = self.grid, self.grid.upper_half
        recorded = 2.0 * upper.box_pairs
        result = self.field_bytes(frequencies, 2 ** len(cells.mirrored))
        run = BYTES_PER_CELL * float(np.prod(upper.shape)) + transform_bytes(frequencies, recorded)
        run += 16.0 * recorded * MOST_WATCHED
        return GEOMETRY_BYTES_PER_CELL * float(np.prod(cells.shape)), result, run

    @cached_property
    def cells(self) -> CutCells:
        """Geometry of the fluid in the grid."""
        return cut_cells(self._body, self.grid)

    def wall_fluxes(self, patterns: Sequence[Pattern]) -> Array:
        """Return the flux of each pattern into the wall cells, (pattern, wall); see `wall_flux.py`.

        The surface's points that stand on a wall of the room move nothing.
        """
        x, y, z = (_divided(edges, _PIECES_PER_CELL) for edges in self.grid.edges)
        surface = (
            points.where(
                [
                    wall.depth_m(points.position) > _ON_WALL * self.grid.spacing_m
                    for wall in self._walls
                ]
            )
            for points in surface_in_parts(self._body, (x, y, z))
        )
        return wall_fluxes(self.cells, self.grid, surface, patterns)

    @property
    def margin_m(self) -> float:
        """Largest distance of the box's outer layer from the body, m."""
        lower, upper = self._body.bounds()
        outer = self.box.outer
        return float(max((lower - outer.min(axis=0)).max(), (outer.max(axis=0) - upper).max()))

    def parts(self, flux: Array) -> list[tuple[Parity, Array]]:
        """Even and odd parts of a flux (wall,), those that count, in cells of the upper half."""
        grid = self.grid
        image, beyond = images(self.cells.wall_cells, grid.shape, grid.mirrored)
        parts = (
            (parity, np.bincount(image, signs(beyond, parity) * flux) / 2 ** len(parity))
            for parity in product((1, -1), repeat=len(grid.mirrored))
        )
        least = _NO_PART * np.abs(flux).max()
        return [(parity, part) for parity, part in parts if not np.abs(part).max() <= least]

    def radiate(
        self,
        flux: Array,
        frequency_hz: Array,
        microphones: Array,
        name: str,
        progress: Progress = no_progress,
    ) -> list[PartField]:
        """Pressure (Pa) in the recorded cells per unit velocity of a pattern, by parity.

        Parameters
        ----------
        flux : volume velocity of the pattern into the wall cells, shape (wall,), m³/s
        frequency_hz : frequencies, shape (frequency,)
        microphones : points outside the box, shape (point, 3); a run ends when it is over for them
        name : name of the pattern, for progress and errors
        progress : told of the steps

        Raises
        ------
        SolverError
            The field is not finite, or rings on for longer than is simulated.
        """
        grid = self.grid
        watched = watched_frequencies(frequency_hz)
        points = spread_points(microphones)
        largest: Array = np.zeros(watched.size)
        fields = []
        for parity, part in self.parts(flux):
            run = Run(
                name=name,
                flux=part,
                odd=[axis for axis, sign in zip(grid.mirrored, parity, strict=True) if sign < 0],
                frequency_hz=frequency_hz,
                recorded=self.recording.cells,
                watch=Watch(watched, self._to_points(parity, points, frequency_hz[watched])),
                other_parts=largest,
                pulse_width_s=self.pulse_width_s,
                passage_s=self.passage_s,
                progress=progress,
            )
            spectrum, largest = advance_run(run, grid, self.cells)
            fields.append(PartField(parity, spectrum))
        return fields

    def _to_points(self, parity: Parity, points: Array, frequency_hz: Array) -> ComplexArray:
        """Green's functions from a part in the recorded cells to points, (frequency, cell,
        point)."""
        layers = np.concatenate([self.box.inner, self.box.outer])
        matrix = self.recording.join_matrix(parity)
        greens = green_rows(layers, points, frequency_hz, self._walls)
        return np.stack([matrix @ green.T for green in greens])

    @property
    def passage_s(self) -> float:
        """Time that sound takes through the diagonal of the box, s."""
        diagonal = float(np.linalg.norm(self.box.upper - self.box.lower))
        return diagonal / SPEED_OF_SOUND_M_PER_S


def _divided(edges: Array, parts: int) -> Array:
    """Planes that cut every cell of an axis in equal parts."""
    cells = np.arange(edges.size)
    return np.asarray(np.interp(np.arange(parts * cells[-1] + 1) / parts, cells, edges))
