"""The machine side: sound pressure on a box around the vibrating body.

k-Wave's staggered grid, absorbing layer and split density, but with local differences, and with cut
cells at the wall: V dp/dt = -rho c² sum of A_f (u_f - v_wall) . n_f. A global (spectral) stencil
would leak the dead pressure inside the body into the sound field. The wall follows one broadband
pulse; dividing by the pulse's spectrum gives every frequency from a single run.

A hard floor is the lowest face plane of the grid, so the scattering between body and floor is part
of the solution; what the rest of the room sends back to the body is not.
"""

from functools import cached_property
from typing import Final

import numpy as np
import psutil

from ..constants import AIR_DENSITY_KG_PER_M3, SPEED_OF_SOUND_M_PER_S
from ..errors import ParameterError, SolverError
from .arrays import Array, ComplexArray, IndexArray, Progress, no_progress
from .bodies import Body, outward_normal
from .box import Box, BoxField, box_sides, closed_box
from .cut_cells import CutCells, cut_cells
from .exact import wavenumber
from .near_grid import BOX_MARGIN_M, COURANT_NUMBER, NearGrid, near_grid
from .patterns import Pattern
from .pulse import RunningTransform, pulse, pulse_duration_s, pulse_width_s, transform

_BYTES_PER_CELL: Final = 400
_PROGRESS_STEPS: Final = 20
_MOST_DIAGONALS: Final = 50.0
"""Longest recording after the pulse, in passages of sound through the box's diagonal."""
_QUIET: Final = 1e-5
"""A run ends when the pressure on the box has fallen to this share of its largest value."""
_NOT_QUIET: Final = 1e-3
"""Share that is refused at the end of the longest recording."""
_ENVELOPE_DECAY: Final = 0.98


class NearField:
    """A body in its grid; the geometry is computed once and serves every pattern.

    Raises
    ------
    ParameterError
        The grid needs more memory than is available.
    """

    def __init__(
        self,
        body: Body,
        spacing_m: float,
        maximum_frequency_hz: float,
        floor_z_m: float | None = None,
        box_margin_m: float = BOX_MARGIN_M,
    ) -> None:
        self.grid: NearGrid = near_grid(body, spacing_m, floor_z_m, box_margin_m)
        _check_memory(self.grid.shape)
        self._body = body
        self.box: Box = closed_box(
            self.grid.box_lower, self.grid.box_upper, spacing_m, self.grid.on_floor
        )
        self.pulse_width_s = pulse_width_s(maximum_frequency_hz)
        self.layers = _recording_layers(self.grid)

    @cached_property
    def cells(self) -> CutCells:
        """Geometry of the fluid in the grid."""
        return cut_cells(self._body, self.grid.origin, self.grid.spacing_m, self.grid.shape)

    @cached_property
    def _wall_normals(self) -> Array:
        return outward_normal(self._body, self.cells.wall_centroids)

    @property
    def most_steps(self) -> int:
        """Largest number of time steps of a run."""
        diagonal = float(np.linalg.norm(self.box.upper - self.box.lower))
        duration = pulse_duration_s(self.pulse_width_s)
        duration += _MOST_DIAGONALS * diagonal / SPEED_OF_SOUND_M_PER_S
        return int(np.ceil(duration / self.grid.time_step_s))

    def radiate(
        self, pattern: Pattern, frequency_hz: Array, progress: Progress = no_progress
    ) -> BoxField:
        """Pressure (Pa) on both layers of the box per unit velocity of the pattern.

        Raises
        ------
        SolverError
            The field is not finite or has not died down at the end of the run.
        """
        flux = wall_flux(self.cells, pattern, self._wall_normals, self.grid)
        if not np.any(flux):
            zeros = np.zeros((frequency_hz.size, self.box.inner.shape[0]), dtype=complex)
            return BoxField(zeros, zeros.copy())
        inner, outer = _run(self, flux, frequency_hz, pattern.name, progress)
        return BoxField(inner, outer)


def wall_flux(cells: CutCells, pattern: Pattern, normals: Array, grid: NearGrid) -> Array:
    """Volume velocity out of each wall cell's fluid into the wall, m³/s, (wall,).

    Per unit velocity of the pattern; zero everywhere when the wall only slides along itself.
    Otherwise the sum is made exact (zero for a rigid body): a small net flux would drown a rocking
    motion, which radiates weakly.
    """
    velocity = pattern.velocity(cells.wall_centroids)
    sliding = np.abs(np.einsum("wi,wi->w", velocity, normals))
    if sliding.max() <= 1e-6 * np.abs(velocity).max():
        return np.zeros(cells.wall_cells.size)
    flux = np.einsum("wi,wi->w", velocity, cells.wall_areas)
    area = np.linalg.norm(cells.wall_areas, axis=1)
    excess = (
        flux.sum()
        + pattern.volume_velocity_m3_per_s
        + _flux_through_footprint(cells, pattern, grid)
    )
    corrected: Array = flux - excess * area / area.sum()
    return corrected


def _flux_through_footprint(cells: CutCells, pattern: Pattern, grid: NearGrid) -> float:
    """Volume velocity of the part of the body's surface that lies on the floor, m³/s, upwards."""
    closed = 1.0 - cells.open_areas[2][:, :, 0]
    if not grid.on_floor or not np.any(closed):
        return 0.0
    rows, columns = np.nonzero(closed)
    points = grid.origin + grid.spacing_m * np.stack(
        [rows + 0.5, columns + 0.5, np.zeros(rows.size)], axis=-1
    )
    upward = pattern.velocity(points)[:, 2]
    return float(closed[rows, columns] @ upward) * grid.spacing_m**2


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


def _check_memory(shape: tuple[int, int, int]) -> None:
    needed = _BYTES_PER_CELL * np.prod(shape, dtype=float) / 2**30
    available = psutil.virtual_memory().available / 2**30
    if needed > available:
        raise ParameterError(
            f"radiation.near_field_spacing_mm: the grid of {shape[0]}×{shape[1]}×{shape[2]} cells "
            f"needs {needed:.3g} GiB, {available:.3g} GiB are available"
        )


def _recording_layers(grid: NearGrid) -> IndexArray:
    """Flat indices of the cells inside and outside of each face of the box, (2, pair)."""
    layers = []
    for axis, sign in box_sides(grid.on_floor):
        ranges: list[IndexArray] = [
            np.arange(a, b) for a, b in zip(grid.box_start, grid.box_stop, strict=True)
        ]
        inside = grid.box_stop[axis] - 1 if sign > 0 else grid.box_start[axis]
        side = []
        for cell in (inside, inside + sign):
            ranges[axis] = np.array([cell])
            side.append(np.ravel_multi_index(np.ix_(*ranges), grid.shape).ravel())
        layers.append(np.stack(side))
    return np.concatenate(layers, axis=1)


class _Fields:
    """Pressure, scaled fluxes and split pressure of one run, updated in place.

    The flux variable is A_f u_f rho dx/dt, so that a step is: subtract a pressure difference, then
    subtract a flux difference. Faces at the ends of the grid stay closed.
    """

    def __init__(self, grid: NearGrid, cells: CutCells) -> None:
        shape = grid.shape
        self.pressure = np.zeros(shape)
        self._split = [np.zeros(shape) for _ in range(3)]
        self._flux = [np.zeros(area.shape) for area in cells.open_areas]
        self._scratch = np.zeros(shape)
        inverse = np.divide(1.0, cells.volumes, out=np.zeros(shape), where=cells.volumes > 0)
        self._momentum, self._mass = [], []
        for axis in range(3):
            cell_damping, face_damping = (
                damping.reshape([-1 if other == axis else 1 for other in range(3)])
                for damping in grid.absorption(axis)
            )
            area = cells.open_areas[axis][_inner(axis, 1)]
            self._momentum.append((face_damping**2, face_damping * area))
            self._mass.append((cell_damping**2, cell_damping * COURANT_NUMBER**2 * inverse))

    def advance_velocity(self) -> None:
        for axis, (damping, gain) in enumerate(self._momentum):
            flux = self._flux[axis][_inner(axis, 1)]
            difference = self._scratch[_inner(axis, 0, 1)]
            np.subtract(
                self.pressure[_inner(axis, 1, 0)],
                self.pressure[_inner(axis, 0, 1)],
                out=difference,
            )
            difference *= gain
            flux *= damping
            flux -= difference

    def advance_pressure(self, wall_cells: IndexArray, wall_pressure: Array) -> None:
        for axis, (damping, gain) in enumerate(self._mass):
            flux, split = self._flux[axis], self._split[axis]
            np.subtract(flux[_inner(axis, 1, 0)], flux[_inner(axis, 0, 1)], out=self._scratch)
            self._scratch *= gain
            split *= damping
            split -= self._scratch
        # The wall lies outside the absorbing layers, where any split is the same.
        self._split[0].reshape(-1)[wall_cells] -= wall_pressure
        np.add(self._split[0], self._split[1], out=self.pressure)
        self.pressure += self._split[2]


def _inner(axis: int, start: int, end: int | None = None) -> tuple[slice, ...]:
    """Leave out `start` layers at the beginning of an axis and `end` at its end."""
    end = start if end is None else end
    cut = slice(start, -end if end else None)
    return tuple(cut if other == axis else slice(None) for other in range(3))


def _run(
    near: NearField, flux: Array, frequency_hz: Array, name: str, progress: Progress
) -> ComplexArray:
    """Pressure (layer, frequency, pair) per unit spectrum of the wall velocity."""
    cells, time_step, steps = near.cells, near.grid.time_step_s, near.most_steps
    fields = _Fields(near.grid, cells)
    shifted_hz, gain = _grid_frequency(frequency_hz, near.grid)
    transformer = RunningTransform(shifted_hz, near.layers.size)
    layers = near.layers.ravel()
    velocity_time = time_step * (np.arange(steps) + 0.5)
    velocity = pulse(velocity_time, near.pulse_width_s)
    volume = cells.volumes.reshape(-1)[cells.wall_cells] * near.grid.spacing_m**3
    stiffness = AIR_DENSITY_KG_PER_M3 * SPEED_OF_SOUND_M_PER_S**2
    wall_pressure = stiffness * time_step * flux / volume
    pulse_steps = pulse_duration_s(near.pulse_width_s) / time_step
    largest = envelope = 0.0
    for step in range(steps):
        fields.advance_velocity()
        fields.advance_pressure(cells.wall_cells, velocity[step] * wall_pressure)
        row = transformer.next_row((step + 1) * time_step)
        np.take(fields.pressure.reshape(-1), layers, out=row)
        peak = float(np.abs(row).max())
        largest, envelope = max(largest, peak), max(peak, _ENVELOPE_DECAY * envelope)
        if step > pulse_steps and not envelope > _QUIET * largest:
            break
        if step % _PROGRESS_STEPS == 0:
            progress(f"near field {name}", step, steps)
    progress(f"near field {name}", steps, steps)
    if not envelope <= _NOT_QUIET * largest:
        raise SolverError(
            f"near field {name}: the pressure has not died down at the end of the run "
            f"({envelope:.3g} Pa against a largest of {largest:.3g} Pa)"
        )
    source = transform(shifted_hz, velocity_time, velocity) / gain
    spectrum = transformer.spectrum() / source[:, None]
    return spectrum.reshape(frequency_hz.size, 2, -1).swapaxes(0, 1)
