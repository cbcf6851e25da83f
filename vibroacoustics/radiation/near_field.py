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
from functools import cached_property
from itertools import product
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..base.constants import AIR_DENSITY_KG_PER_M3, SPEED_OF_SOUND_M_PER_S
from ..base.errors import SolverError
from ..base.progress import Progress, no_progress
from .arrays import Array, ComplexArray, IndexArray
from .bodies import Body
from .box import Box, BoxField, closed_box, open_sides
from .cut_cells import GEOMETRY_BYTES_PER_CELL, CutCells, cut_cells
from .exact import wavenumber
from .mirrors import Mirror
from .near_grid import BOX_MARGIN_M, NearGrid, near_grid
from .near_step import BYTES_PER_CELL, Fields
from .patterns import Pattern
from .pulse import (
    RunningTransform,
    pulse,
    pulse_duration_s,
    pulse_width_s,
    sampling_steps,
    transform,
    transform_bytes,
)
from .surface_points import surface_in_parts
from .symmetry import images, signs, upper_half
from .wall_flux import wall_fluxes

_PROGRESS_STEPS: Final = 50
_MOST_DIAGONALS: Final = 250.0
"""Longest recording after the pulse, in passages of sound through the box's diagonal."""
_QUIET: Final = 3e-8
"""A run ends when the pressure on the box has fallen to this share of its largest value."""
_NOT_QUIET: Final = 1e-3
"""Share that is refused at the end of the longest recording."""
_ENVELOPE_DECAY_PER_CELL: Final = 0.933
"""Decay of the envelope of the pressure during the passage of one cell."""
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
    ) -> None:
        self.grid: NearGrid = near_grid(body, spacing_m, walls, box_margin_m, cells_per_unit)
        self._body = body
        self._walls = walls
        self.pulse_width_s = pulse_width_s(maximum_frequency_hz)

    @cached_property
    def box(self) -> Box:
        """The box through which the sound field leaves."""
        grid = self.grid
        return closed_box(grid.edges, grid.box_start, grid.box_stop, grid.on_walls)

    @cached_property
    def layers(self) -> IndexArray:
        """Flat indices of the cells inside and outside of each face of the box, (2, pair)."""
        return _recording_layers(self.grid)

    @cached_property
    def recorded(self) -> tuple[IndexArray, IndexArray, NDArray[np.bool_]]:
        """What the upper half of the mirrored axes records of the layers.

        Flat indices of its cells (cell,), the column among them of every cell of the layers'
        image (2, pair), and whether that cell lies across the middle of each axis (axis, 2, pair).
        """
        image, across = images(self.layers, self.grid.shape, self.grid.mirrored)
        cells, columns = np.unique(image, return_inverse=True)
        return cells, columns.reshape(image.shape), across

    def memory_bytes(self, frequencies: int) -> tuple[float, float, float]:
        """Memory of the geometry, of a pattern's result, and of a run besides its result."""
        cells, upper = self.grid, self.grid.upper_half
        result = 32.0 * frequencies * self.grid.box_pairs
        run = BYTES_PER_CELL * float(np.prod(upper.shape)) + transform_bytes(
            frequencies, 2.0 * upper.box_pairs
        )
        return GEOMETRY_BYTES_PER_CELL * float(np.prod(cells.shape)), result, run

    @cached_property
    def cells(self) -> CutCells:
        """Geometry of the fluid in the grid."""
        return cut_cells(self._body, self.grid)

    def wall_fluxes(self, patterns: Sequence[Pattern]) -> Array:
        """What each pattern pushes into the wall cells, (pattern, wall); see `wall_flux.py`.

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

    @property
    def most_steps(self) -> int:
        """Largest number of time steps of a run."""
        diagonal = float(np.linalg.norm(self.box.upper - self.box.lower))
        duration = pulse_duration_s(self.pulse_width_s)
        duration += _MOST_DIAGONALS * diagonal / SPEED_OF_SOUND_M_PER_S
        return int(np.ceil(duration / self.grid.time_step_s))

    def radiate(
        self, flux: Array, frequency_hz: Array, name: str, progress: Progress = no_progress
    ) -> BoxField:
        """Pressure (Pa) on both layers of the box per unit velocity of a pattern.

        Parameters
        ----------
        flux : what the pattern pushes into the wall cells, (wall,), m³/s
        frequency_hz : (frequency,)
        name : of the pattern, for progress and errors
        progress : told of the steps

        Raises
        ------
        SolverError
            The field is not finite or has not died down at the end of the run.
        """
        grid, cells = self.grid, self.cells.wall_cells
        image, beyond = images(cells, grid.shape, grid.mirrored)
        _, columns, across = self.recorded
        layers = np.zeros((2, frequency_hz.size, columns.shape[1]), dtype=complex)
        for parity in product((1, -1), repeat=len(grid.mirrored)):
            part = np.bincount(image, signs(beyond, parity) * flux) / 2 ** len(parity)
            if np.abs(part).max() <= _NO_PART * np.abs(flux).max():
                continue
            odd = [axis for axis, sign in zip(grid.mirrored, parity, strict=True) if sign < 0]
            spectrum = _run(self, part, odd, frequency_hz, name, progress)
            for layer, layer_columns, sign in zip(
                range(2), columns, signs(across, parity), strict=True
            ):
                layers[layer] += sign * spectrum[:, layer_columns]
        return BoxField(*layers)


def _divided(edges: Array, parts: int) -> Array:
    """Planes that cut every cell of an axis in equal parts."""
    cells = np.arange(edges.size)
    planes: Array = np.interp(np.arange(parts * cells[-1] + 1) / parts, cells, edges)
    return planes


def _grid_frequency(frequency_hz: Array, grid: NearGrid) -> tuple[Array, Array]:
    """Frequency at which the grid's waves have the true length, and the gain that goes with it.

    Averaged over directions, local differences see k² (1 - k² dx²/20) instead of k², so a lower
    frequency f' with (2/dt) sin(pi f' dt) = omega sqrt(1 - k² dx²/20) has the wavelength of f. The
    wall's acceleration is lower by the same root, which the gain makes up for.
    """
    phase = wavenumber(frequency_hz) * grid.spacing_m
    root = np.sqrt(1.0 - phase**2 / 20.0)
    half_step = np.pi * grid.time_step_s
    shifted: Array = np.arcsin(half_step * frequency_hz * root) / half_step
    return shifted, 1.0 / root


def _recording_layers(grid: NearGrid) -> IndexArray:
    layers = []
    for axis, sign in open_sides(grid.on_walls):
        ranges: list[IndexArray] = [
            np.arange(a, b) for a, b in zip(grid.box_start, grid.box_stop, strict=True)
        ]
        inner_cell = grid.box_stop[axis] - 1 if sign > 0 else grid.box_start[axis]
        side = []
        for cell in (inner_cell, inner_cell + sign):
            ranges[axis] = np.array([cell])
            side.append(np.ravel_multi_index(np.ix_(*ranges), grid.shape).ravel())
        layers.append(np.stack(side))
    return np.concatenate(layers, axis=1)


def _run(
    near: NearField,
    flux: Array,
    odd: Sequence[int],
    frequency_hz: Array,
    name: str,
    progress: Progress,
) -> ComplexArray:
    """Pressure (frequency, recorded cell) per unit spectrum of the wall velocity.

    From the flux into the wall cells of the upper half of the grid, which is odd along some axes.
    """
    grid, time_step, steps = near.grid.upper_half, near.grid.time_step_s, near.most_steps
    volumes = upper_half(near.cells.volumes, near.grid.mirrored)
    areas = [upper_half(area, near.grid.mirrored) for area in near.cells.open_areas]
    fields = Fields(grid, areas, volumes, odd)
    recorded = fields.flat_indices(near.recorded[0])
    shifted_hz, gain = _grid_frequency(frequency_hz, near.grid)
    transformer = RunningTransform(shifted_hz, recorded.size)
    pulse_steps = int(np.ceil(pulse_duration_s(near.pulse_width_s) / time_step))
    velocity_time = time_step * (np.arange(pulse_steps) + 0.5)
    velocity = pulse(velocity_time, near.pulse_width_s)
    full = [grid.widths(axis) for axis in range(3)]
    wall_cells = np.flatnonzero(flux)
    volume = (volumes * np.einsum("i,j,k->ijk", *full)).reshape(-1)[wall_cells]
    walls = fields.flat_indices(wall_cells)
    stiffness = AIR_DENSITY_KG_PER_M3 * SPEED_OF_SOUND_M_PER_S**2
    wall_pressure = -stiffness * time_step * flux[wall_cells] / volume
    every = sampling_steps(near.pulse_width_s, time_step)
    decay = _ENVELOPE_DECAY_PER_CELL ** (every * near.grid.courant_number)
    largest = envelope = 0.0
    for step in range(steps):
        fields.advance()
        if step < pulse_steps:
            fields.add(walls, velocity[step] * wall_pressure)
        if step % _PROGRESS_STEPS == 0:
            progress(f"near field {name}", step, steps)
        if step % every:
            continue
        row = transformer.next_row((step + 1) * time_step)
        row[...] = fields.pressure(recorded)
        peak = float(np.abs(row).max())
        largest, envelope = max(largest, peak), max(peak, decay * envelope)
        if step > pulse_steps and not envelope > _QUIET * largest:
            break
    progress(f"near field {name}", steps, steps)
    if not envelope <= _NOT_QUIET * largest:
        raise SolverError(
            f"near field {name}: the pressure has not died down at the end of the run "
            f"({envelope:.3g} Pa against a largest of {largest:.3g} Pa)"
        )
    source = transform(shifted_hz, velocity_time, velocity) / gain
    spectrum = transformer.spectrum()
    spectrum *= (every / source)[:, None]
    return spectrum
