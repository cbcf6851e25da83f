"""The pulse that drives both sides, and one compiled time step of the machine side."""

from collections.abc import Sequence
from typing import Any, Final

import numba
import numpy as np

from .arrays import Array, ComplexArray, IndexArray
from .near_grid import NearGrid

_LEAD_WIDTHS: Final = 6.0
_BLOCK_STEPS: Final = 64


def pulse_width_s(maximum_frequency_hz: float) -> float:
    """Width of the pulse: its spectrum still has 12 % of its peak at the highest frequency.

    Below 1 kHz the width stays at 0.425 ms, which keeps runs short and still has next to nothing
    above what the coarsest permitted grid carries.
    """
    return 0.425 / max(maximum_frequency_hz, 1000.0)


def pulse(time_s: Array, width_s: float) -> Array:
    """Derivative of a Gaussian, peak near 0.6, zero mean, centred six widths after time 0.

    Zero mean keeps the air at rest afterwards: nothing static remains in the grid.
    """
    argument = time_s / width_s - _LEAD_WIDTHS
    return np.asarray(-argument * np.exp(-(argument**2) / 2.0))


def pulse_duration_s(width_s: float) -> float:
    """Time after which the pulse is over (below 1e-7 of its peak)."""
    return 2.0 * _LEAD_WIDTHS * width_s


def sampling_steps(width_s: float, time_step_s: float) -> int:
    """Time steps between samples of a field that the pulse drives.

    The pulse's spectrum f exp(-(2 pi f s)²/2) is below 1e-9 of its peak from 1.1/s on. Sampled
    there at 2.2/s nothing folds back; what grid noise lies above is not driven.
    """
    return max(1, int(width_s / (2.2 * time_step_s)))


def transform(frequency_hz: Array, time_s: Array, signal: Array) -> ComplexArray:
    """Sum of s(t) exp(-j 2 pi f t), shape (frequency,)."""
    return np.asarray(np.exp(-2j * np.pi * np.outer(frequency_hz, time_s)) @ signal)


def transform_bytes(frequencies: int, signals: float) -> float:
    """Memory of a running transform: its sums, what a block adds to them, and the block."""
    return 8.0 * signals * (2 * 2 * frequencies + _BLOCK_STEPS)


class RunningTransform:
    """Fourier transform of many signals at chosen frequencies, without storing the signals.

    Samples collect in a block of a few dozen steps; a full block is one real matrix product.
    """

    def __init__(self, frequency_hz: Array, points: int) -> None:
        self._frequency = frequency_hz
        self._times = np.zeros(_BLOCK_STEPS)
        self._block = np.zeros((_BLOCK_STEPS, points))
        self._sum = np.zeros((2 * frequency_hz.size, points))
        self._filled = 0

    def next_row(self, time_s: float) -> Array:
        """Row (points,) into which the caller writes the samples of this time."""
        if self._filled == _BLOCK_STEPS:
            self._flush()
        self._times[self._filled] = time_s
        self._filled += 1
        return np.asarray(self._block[self._filled - 1])

    def _flush(self) -> None:
        angle = 2 * np.pi * np.outer(self._frequency, self._times[: self._filled])
        kernel = np.concatenate([np.cos(angle), -np.sin(angle)])
        self._sum += kernel @ self._block[: self._filled]
        self._filled = 0

    def spectrum(self, chosen: IndexArray | slice = slice(None)) -> ComplexArray:
        """Sum of the samples so far times exp(-j 2 pi f t), (chosen frequency, point)."""
        self._flush()
        count = self._frequency.size
        result: ComplexArray = np.empty(self._sum[:count][chosen].shape, dtype=complex)
        result.real, result.imag = self._sum[:count][chosen], self._sum[count:][chosen]
        return result


_kernel = numba.njit(cache=True, nogil=True)

BYTES_PER_CELL: Final = 11 * 8
"""Eleven fields in double precision; in single precision weak patterns drown below 50 Hz."""


class Fields:
    """Pressure, scaled fluxes and split pressure of one run, updated in place.

    The flux variable is A_f u_f rho h/dt with the open share A_f of a face and the grid's spacing
    h, so that a step is: subtract a pressure difference, then a flux difference, each times h over
    the distance between its ends. Faces at the ends of the grid stay closed. The split of the
    pressure matters in the absorbing layers only.

    Before the first cells along each axis lie dead ones without pressure. So a plane of cells is a
    long loop, which compilers vectorise; cells and their upper faces have the same index; and a
    first face with twice the opening mirrors the pressure with the other sign, for axes `odd`.
    """

    def __init__(
        self, grid: NearGrid, open_areas: Sequence[Array], volumes: Array, odd: Sequence[int]
    ) -> None:
        self._shape = tuple(count + 1 for count in grid.shape)
        planes = (self._shape[0], self._shape[1] * self._shape[2])
        self._pressure = np.zeros(planes)
        self._flux = tuple(np.zeros(planes) for _ in range(3))
        self._split = tuple(np.zeros(planes) for _ in range(3))
        openings, flow, squeeze, width = [], [], [], []
        for axis, area in enumerate(open_areas):
            cell, face = grid.absorption(axis)
            slope = np.concatenate([[0.0], face * grid.spacing_m / grid.gaps(axis), [0.0]])
            narrow = grid.spacing_m / grid.widths(axis)
            if axis in odd:
                slope[0] = 2.0 * narrow[0]
            before = [(int(other != axis), 0) for other in range(3)]
            opening = np.pad(area * _along(slope, axis), before)
            openings.append(opening.reshape(planes))
            flow.append(self._on_planes(np.concatenate([[1.0], face**2, [1.0]]), axis))
            squeeze.append(self._on_planes(np.concatenate([[1.0], cell**2]), axis))
            width.append(self._on_planes(np.concatenate([[0.0], cell * narrow]), axis))
        gain = np.divide(
            grid.courant_number**2, volumes, out=np.zeros(grid.shape), where=volumes > 0
        )
        gain = np.pad(gain, ((1, 0),) * 3).reshape(planes)
        factors = tuple(map(tuple, (flow, squeeze, width)))
        self._coefficients = (tuple(openings), gain, factors, self._shape[2])

    def _on_planes(self, values: Array, axis: int) -> Array:
        """Values along an axis: as they are along the first, else for all cells of a plane."""
        if axis > 0:
            values = np.broadcast_to(_along(values, axis), (1, *self._shape[1:])).ravel()
        return values

    def flat_indices(self, cells: IndexArray) -> IndexArray:
        """Flat indices, among cells and dead ones, of cells given by flat index."""
        index = np.unravel_index(cells, tuple(count - 1 for count in self._shape))
        return np.ravel_multi_index(tuple(number + 1 for number in index), self._shape)

    def advance(self) -> None:
        """One step of fluxes and pressure."""
        step: Any = _advance  # numba's types do not show its arguments
        step(self._pressure, self._flux, self._split, *self._coefficients)

    def pressure(self, indices: IndexArray) -> Array:
        """Pressure at flat indices."""
        return np.asarray(self._pressure.reshape(-1)[indices])

    def add(self, indices: IndexArray, pressure: Array) -> None:
        """Add pressure at flat indices."""
        self._pressure.reshape(-1)[indices] += pressure
        self._split[0].reshape(-1)[indices] += pressure


def _along(values: Array, axis: int) -> Array:
    """Values along an axis of a grid."""
    return values.reshape([-1 if other == axis else 1 for other in range(3)])


@_kernel
def _advance(
    p: Any, flux: Any, split: Any, opening: Any, gain: Any, factors: Any, row: int
) -> None:  # pragma: no cover
    """Planes across x in order: fluxes that need the old pressure, then the pressure before them.

    A row is as many cells along z.
    """
    (fx, fy, fz), (sx, sy, sz), (ax, ay, az) = flux, split, opening
    (dx, dy, dz), (cx, cy, cz), (wx, wy, wz) = factors
    last = p.shape[0] - 1
    for i in range(last + 1):
        if i < last:
            _flow_across(fx[i], ax[i], p[i], p[i + 1], dx[i])
        if i > 0:
            _flow(fy[i], ay[i], p[i], p[i][row:], dy)
            _flow(fz[i], az[i], p[i], p[i][1:], dz)
            _squeeze_across(sx[i], gain[i], fx[i], fx[i - 1], cx[i], wx[i])
            _squeeze(sy[i][row:], gain[i][row:], fy[i][row:], fy[i], cy[row:], wy[row:])
            _squeeze(sz[i][1:], gain[i][1:], fz[i][1:], fz[i], cz[1:], wz[1:])
            _add(p[i], sx[i], sy[i], sz[i])


@_kernel
def _flow_across(
    flux: Any, opening: Any, near: Any, far: Any, damping: Any
) -> None:  # pragma: no cover
    """Flux through a plane of faces, driven by the pressure on both sides."""
    for m in range(far.size):
        flux[m] = damping * flux[m] + opening[m] * (near[m] - far[m])


@_kernel
def _flow(flux: Any, opening: Any, near: Any, far: Any, damping: Any) -> None:  # pragma: no cover
    """Fluxes within a plane of cells."""
    for m in range(far.size):
        flux[m] = damping[m] * flux[m] + opening[m] * (near[m] - far[m])


@_kernel
def _squeeze_across(
    split: Any, gain: Any, out: Any, into: Any, damping: Any, width: Any
) -> None:  # pragma: no cover
    """Split pressure by the flux across a plane of cells."""
    for m in range(split.size):
        split[m] = damping * split[m] - gain[m] * width * (out[m] - into[m])


@_kernel
def _squeeze(
    split: Any, gain: Any, out: Any, into: Any, damping: Any, width: Any
) -> None:  # pragma: no cover
    """Split pressure by the fluxes within a plane of cells."""
    for m in range(split.size):
        split[m] = damping[m] * split[m] - gain[m] * width[m] * (out[m] - into[m])


@_kernel
def _add(pressure: Any, x: Any, y: Any, z: Any) -> None:  # pragma: no cover
    for m in range(pressure.size):
        pressure[m] = x[m] + y[m] + z[m]
