"""Record of a run of a room at lattices of points, and its spectra."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy import fft

from ..arrays import Array, ComplexArray
from ..pulse import transform


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
