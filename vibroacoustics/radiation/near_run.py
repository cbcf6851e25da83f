"""One run of the machine side: the wall follows the pulse until the microphones hear no more."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from ..base.constants import AIR_DENSITY_KG_PER_M3, SPEED_OF_SOUND_M_PER_S
from ..base.errors import SolverError
from ..base.progress import Progress
from .arrays import Array, ComplexArray, IndexArray
from .box import Box
from .cut_cells import SETTLED, CutCells, Settling
from .exact import wavenumber
from .near_grid import NearGrid
from .near_step import Fields, RunningTransform, pulse, pulse_duration_s, sampling_steps, transform
from .symmetry import images, signs, upper_half

Parity = tuple[int, ...]
"""1 where a field is even along a mirrored axis of its grid, -1 where it is odd."""


@dataclass(frozen=True)
class PartField:
    """Sound pressure of one parity in the recorded cells."""

    parity: Parity
    spectrum: ComplexArray
    """(frequency, cell), Pa."""


@dataclass(frozen=True)
class Recording:
    """The recorded cells, and where the box's layers find their images among them."""

    cells: IndexArray
    """Flat indices in the upper half of the grid, (cell,)."""
    columns: IndexArray
    """Recorded cell that is the image of each of the inner and outer layer's, (2, pair)."""
    across: NDArray[np.bool_]
    """Whether those lie across the middle of each mirrored axis, (axis, 2, pair)."""
    weights: Array
    """Weights of the box, (pair,)."""

    def join_matrix(self, parity: Parity) -> Any:
        """Sparse matrix (cell, 2 pairs): from a Green's function to what joins a part with it.

        Greens' functions are given on the inner layer, then on the outer one. With the matrix M,
        the pressure p of a part and the Green's function G, p M G is the integral of `join`.
        """
        inner, outer = signs(self.across, parity)
        pairs = np.arange(self.weights.size)
        return sparse.csr_array(
            (
                np.concatenate([inner * self.weights, -outer * self.weights]),
                (self.columns.ravel(), np.concatenate([pairs + pairs.size, pairs])),
            ),
            shape=(self.cells.size, 2 * pairs.size),
        )


def recording(grid: NearGrid, box: Box) -> Recording:
    """The recorded cells of a grid's box."""
    image, across = images(_layers(grid), grid.shape, grid.mirrored)
    cells, columns = np.unique(image, return_inverse=True)
    return Recording(cells, columns.reshape(image.shape), across, box.weights)


def _layers(grid: NearGrid) -> IndexArray:
    """Flat indices of the cells inside and outside of each face of the box, (2, pair)."""
    layers = []
    for axis, sign in grid.box_sides:
        ranges: list[IndexArray] = [
            np.arange(a, b) for a, b in zip(grid.box_start, grid.box_stop, strict=True)
        ]
        inner_cell = grid.box_stop[axis] - 1 if sign > 0 else grid.box_start[axis]
        side = []
        outer_cell = inner_cell if (axis, sign) in grid.on_walls else inner_cell + sign
        for cell in (inner_cell, outer_cell):
            ranges[axis] = np.array([cell])
            side.append(np.ravel_multi_index(np.ix_(*ranges), grid.shape).ravel())
        layers.append(np.stack(side))
    return np.concatenate(layers, axis=1)


_PROGRESS_STEPS: Final = 50
_MOST_PASSAGES: Final = 250
"""Longest recording after the pulse, in passages of sound through the box's diagonal."""
_FORECAST_PASSAGES: Final = 60
"""Passages after which a run is refused that by its decay would not die down in the longest
recording."""
_QUIET: Final = 3e-8
"""A run ends at the latest when the pressure on the box has fallen to this share of its largest:
the weakest patterns are then settled as far as the grid keeps them apart from stronger ones."""
_NOT_QUIET: Final = 1e-3
"""Share that is refused at the end of the longest recording."""
_STEADY_RATIO: Final = 0.5
"""Mean pressure over mean size from which a rest is steady: 1 of a constant, 0 of a mode."""
_ENVELOPE_DECAY_PER_CELL: Final = 0.933
"""Decay of the envelope of the pressure during the passage of one cell."""


@dataclass(frozen=True)
class Watch:
    """Pressures that show when a run has settled."""

    frequency: IndexArray
    """Indices of the frequencies that are watched, (watched,)."""
    green: ComplexArray
    """Green's functions from the recorded cells to the points, (watched, cell, point)."""

    def pressure(self, spectrum: ComplexArray) -> ComplexArray:
        """Pressure (watched, point) of a spectrum (watched, cell)."""
        return np.asarray(np.einsum("fc,fcp->fp", spectrum, self.green))


@dataclass(frozen=True)
class Run:
    """Inputs of a run besides the grid's geometry."""

    name: str
    """Name of the pattern, for progress and errors."""
    flux: Array
    """Flux into the wall cells of the upper half of the grid, (cell,), m³/s."""
    odd: Sequence[int]
    """Axes along which it is odd."""
    frequency_hz: Array
    recorded: IndexArray
    """Flat indices of cells of the upper half."""
    watch: Watch
    other_parts: Array
    """Largest pressure of the points that the pattern's other parts gave, (watched,)."""
    pulse_width_s: float
    passage_s: float
    """Time that sound takes through the diagonal of the box."""
    progress: Progress


def advance_run(run: Run, grid: NearGrid, cells: CutCells) -> tuple[ComplexArray, Array]:
    """Pressure (frequency, recorded cell) per unit spectrum of the wall's velocity.

    And the largest pressure of the watched points, with that of the other parts, (watched,).
    """
    upper, time_step = grid.upper_half, grid.time_step_s
    volumes = upper_half(cells.volumes, grid.mirrored)
    areas = [upper_half(area, grid.mirrored) for area in cells.open_areas]
    fields = Fields(upper, areas, volumes, run.odd)
    shifted_hz, gain = _grid_frequency(run.frequency_hz, grid)
    pulse_steps = int(np.ceil(pulse_duration_s(run.pulse_width_s) / time_step))
    velocity_time = time_step * (np.arange(pulse_steps) + 0.5)
    velocity = pulse(velocity_time, run.pulse_width_s)
    every = sampling_steps(run.pulse_width_s, time_step)
    scale = every * gain / transform(shifted_hz, velocity_time, velocity)
    transformer = RunningTransform(shifted_hz, run.recorded.size)
    settling = Settling(run.other_parts)
    peaks = _Peaks(_ENVELOPE_DECAY_PER_CELL ** (every * grid.courant_number))
    walls, wall_pressure = _wall_pressure(run.flux, upper, volumes, time_step)
    recorded, walls = fields.flat_indices(run.recorded), fields.flat_indices(walls)
    block_steps = every * max(1, round(run.passage_s / (every * time_step)))
    steps = pulse_steps + _MOST_PASSAGES * block_steps + 1
    for step in range(steps):
        fields.advance()
        if step < pulse_steps:
            fields.add(walls, velocity[step] * wall_pressure)
        if step % _PROGRESS_STEPS == 0:
            run.progress(f"near field {run.name}", step, steps)
        if step % every == 0:
            row = transformer.next_row((step + 1) * time_step)
            row[...] = fields.pressure(recorded)
            peaks.add(row)
        if step >= pulse_steps and (step - pulse_steps) % block_steps == 0:
            spectrum = transformer.spectrum(run.watch.frequency)
            spectrum *= scale[run.watch.frequency, None]
            settling.add(run.watch.pressure(spectrum))
            if _ends(run, settling, peaks, (step - pulse_steps) // block_steps):
                break
    run.progress(f"near field {run.name}", steps, steps)
    spectrum = transformer.spectrum()
    spectrum *= scale[:, None]
    return spectrum, settling.largest


class _Peaks:
    """Largest pressure in the recorded cells: of the run so far, and of its latest time."""

    def __init__(self, decay: float) -> None:
        self._decay = decay
        self._largest = self._envelope = 0.0
        self._by_passage: list[float] = []
        self._watched: int | None = None
        self._sum = self._size = 0.0

    def add(self, pressure: Array) -> None:
        """Tell a sample (cell,)."""
        size = np.abs(pressure)
        peak = float(size.max())
        if len(self._by_passage) > _FORECAST_PASSAGES // 2:
            if self._watched is None:
                self._watched = int(size.argmax())
            self._sum += float(pressure[self._watched])
            self._size += float(size[self._watched])
        self._largest = float(np.maximum(self._largest, peak))
        self._envelope = float(np.maximum(peak, self._decay * self._envelope))

    def share(self) -> float:
        """Share of the latest time in the largest; not a number if a pressure is none."""
        return self._envelope / self._largest if self._largest else 0.0

    def reason(self) -> str:
        """Say whether what is left changes its sign, in the cell that was largest midway."""
        if abs(self._sum) > _STEADY_RATIO * self._size:
            return "what is left keeps its sign, as a rest does"
        return "what is left changes its sign, as a mode of the air between walls does"

    def expected(self, passages: int) -> float:
        """The share after so many more passages; to be asked once a passage."""
        self._by_passage.append(self.share())
        if len(self._by_passage) <= _FORECAST_PASSAGES or not passages:
            return self.share() if not passages else 0.0
        fall = self._by_passage[-1] / self._by_passage[-1 - _FORECAST_PASSAGES // 2]
        return float(self.share() * min(1.0, fall) ** (2.0 * passages / _FORECAST_PASSAGES))


def _ends(run: Run, settling: Settling, peaks: _Peaks, passages: int) -> bool:
    """Whether a run may end after so many passages since the pulse."""
    if not np.isfinite(peaks.share()):
        raise SolverError(f"near field {run.name}: the pressure is no number")
    expected = peaks.expected(_MOST_PASSAGES - passages)
    if expected > _NOT_QUIET:
        raise SolverError(
            f"near field {run.name}: the pressure has not died down: {peaks.reason()}, "
            f"{100.0 * peaks.share():.3g} % of the largest pressure are left "
            f"{1e3 * passages * run.passage_s:.3g} ms after the pulse, {100.0 * expected:.3g} % "
            f"after {1e3 * _MOST_PASSAGES * run.passage_s:.3g} ms (at most "
            f"{100.0 * _NOT_QUIET:g} %)"
        )
    return peaks.share() <= _QUIET or bool(np.all(settling.remaining() <= SETTLED))


def _wall_pressure(
    flux: Array, grid: NearGrid, volumes: Array, time_step_s: float
) -> tuple[IndexArray, Array]:
    """Cells that the wall pushes, and the pressure that it adds to them in a step per m/s, Pa."""
    cells = np.flatnonzero(flux)
    full = [grid.widths(axis) for axis in range(3)]
    volume = (volumes * np.einsum("i,j,k->ijk", *full)).reshape(-1)[cells]
    stiffness = AIR_DENSITY_KG_PER_M3 * SPEED_OF_SOUND_M_PER_S**2
    return cells, -stiffness * time_step_s * flux[cells] / volume


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
