"""The field of a machine over a hard floor, on the box around it, joined with a room."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from typing import Final

import numpy as np
from scipy import fft
from scipy.interpolate import CubicSpline

from ...base.forms import returned
from ...base.pieces import stored
from ...base.progress import Progress
from ...base.threads import mapped_in_threads
from ..arrays import Array, ComplexArray
from ..near_step import transform
from ..revolution.side import RevolutionSide
from .join_box import JoinBox


@dataclass(frozen=True)
class Pulse:
    """Pulse that drove a run: midway in steps, like fluxes; see `flux_gain`."""

    time_s: Array
    force: Array
    step_s: float

    def spectrum(self, frequency_hz: Array) -> ComplexArray:
        """Return the spectrum by which recorded spectra are divided, (frequency,)."""
        phase = np.pi * frequency_hz * self.step_s
        driven: ComplexArray = transform(frequency_hz, self.time_s, self.force)
        driven *= phase / np.tan(phase)
        return driven


@dataclass(frozen=True)
class Record:
    """Samples of all points, (sample, column), a step of `every` time steps apart."""

    samples: Array
    shapes: Sequence[tuple[int, ...]]
    """Shapes of each lattice, (quantity, x, y, z)."""
    pulse: Pulse
    every: int
    remaining_db: float
    """Level at which the run ended, of its largest pressure: what was cut off."""

    def greens_at(self, frequency_hz: Array) -> tuple[ComplexArray, ...]:
        """Green's functions of each lattice, (frequency, quantity, x, y, z)."""
        time = self.pulse.step_s * self.every * np.arange(len(self.samples))
        angle = 2.0 * np.pi * np.outer(frequency_hz, time)
        spectrum = np.cos(angle) @ self.samples - 1j * (np.sin(angle) @ self.samples)
        spectrum *= (self.every / self.pulse.spectrum(frequency_hz))[:, None]
        return tuple(
            spectrum[:, columns].reshape(-1, *shape)
            for shape, columns in zip(self.shapes, self._columns(), strict=True)
        )

    def on_grid(self, lattice: int, length: int, lines: int) -> ComplexArray:
        """Green's function of a lattice, (line, quantity, point).

        The lines are multiples, from the first on, of one over the duration of `length` samples.
        """
        shape, columns = self.shapes[lattice], self._columns()[lattice]
        spectrum = fft.rfft(self.samples[:, columns], length, axis=0)[1 : lines + 1]
        step_hz = 1.0 / (length * self.every * self.pulse.step_s)
        frequency_hz = step_hz * np.arange(1.0, lines + 1.0)
        spectrum *= (self.every / self.pulse.spectrum(frequency_hz))[:, None]
        return np.asarray(spectrum.reshape(lines, shape[0], -1))

    def _columns(self) -> list[slice]:
        ends = np.cumsum([0, *(int(np.prod(shape)) for shape in self.shapes)])
        return [slice(int(a), int(b)) for a, b in pairwise(ends)]


_STEP_HZ: Final = 50.0
"""Largest step between the frequencies at which the field is computed; splines run through them."""
_APART: Final = 0.01
"""Distance of the two points of a slope, over the distance from the body to the box."""


class MachineField:
    """Pressure and slope on the sides of a box, of all patterns, as splines over frequency.

    The delay to the box and the growth with frequency are taken out, as in
    `interpolation.interpolant`.

    Parameters
    ----------
    side : the machine
    box : in the room's coordinates, without its lowest side
    origin_m : the machine's origin in the room's coordinates, (3,)
    clearance_m : from the body to the box
    maximum_frequency_hz : that `join` is asked for
    progress : told of the advance
    """

    def __init__(
        self,
        side: RevolutionSide,
        box: JoinBox,
        origin_m: Array,
        clearance_m: float,
        maximum_frequency_hz: float,
        progress: Progress,
    ) -> None:
        points = [point - origin_m for point in box.points]
        self._delay_s = float(np.mean(side.delays_s(np.concatenate(points))))
        count = int(np.ceil(maximum_frequency_hz / _STEP_HZ))
        self._table_hz = maximum_frequency_hz / count * np.arange(1.0, count + 1.0)
        apart = _APART * clearance_m
        layers = [
            ahead + 0.5 * step * apart * np.eye(3)[axis]
            for ahead, axis in zip(points, box.axes, strict=True)
            for step in (-1.0, 1.0)
        ]

        def pressures_at(number: int) -> ComplexArray:
            progress("machine on its floor", number, count)
            return side.finer_pressures(float(self._table_hz[number]), np.concatenate(layers))

        name, in_parallel = ("machine field", *points), partial(mapped_in_threads, pressures_at)
        pressure = np.array([*stored(name, range(count), in_parallel, returned(pressures_at))])
        pressure /= self._trend(self._table_hz)[:, None, None]
        parts = np.split(
            pressure, np.cumsum([len(layer_points) for layer_points in layers])[:-1], axis=1
        )
        self._splines = [
            self._spline(weights, below, above, apart)
            for weights, below, above in zip(box.weights, parts[::2], parts[1::2], strict=True)
        ]

    def _spline(
        self, weights: Array, below: ComplexArray, above: ComplexArray, apart: float
    ) -> ComplexArray:
        """Spline that G and its slope are joined with: coefficients (power, piece, column,
        pattern).

        Both halves of the spectrum are run through; the pieces above 0 Hz are kept.
        """
        value, slope = 0.5 * (above + below), (above - below) / apart
        joined = np.stack([-slope, value], axis=1) * weights[:, None]
        joined = joined.reshape(len(joined), -1, joined.shape[-1])
        two_sided_hz = np.concatenate([-self._table_hz[::-1], self._table_hz])
        spline = CubicSpline(two_sided_hz, np.concatenate([joined[::-1].conj(), joined]))
        return np.asarray(spline.c[:, self._table_hz.size - 1 :])

    def _trend(self, frequency_hz: Array) -> ComplexArray:
        omega = 2.0 * np.pi * frequency_hz
        return np.asarray(1j * omega * np.exp(-1j * omega * self._delay_s))

    def join(self, record: Record, length: int, lines: int, step_hz: float) -> ComplexArray:
        """Pressure at the microphone of a record, (pattern, line); lines as in `Record.on_grid`."""
        frequency_hz = step_hz * np.arange(1.0, lines + 1.0)
        breaks = np.concatenate([[-self._table_hz[0]], self._table_hz])
        piece = np.clip(np.searchsorted(breaks, frequency_hz) - 1, 0, breaks.size - 2)
        total = np.zeros((lines, self._splines[0].shape[-1]), dtype=complex)
        for side in range(len(self._splines)):
            green = record.on_grid(side, length, lines).reshape(lines, -1)
            for number in np.unique(piece):
                rows = piece == number
                along = (frequency_hz[rows] - breaks[number])[:, None]
                value = np.zeros((rows.sum(), total.shape[1]), dtype=complex)
                for coefficients in self._splines[side][:, number]:
                    value = value * along + green[rows] @ coefficients
                total[rows] += value
        return np.asarray((total * self._trend(frequency_hz)[:, None]).T)
