"""k-Wave's time step in a homogeneous, lossless medium, some twenty times as fast.

k-Wave's solver (first order equations, staggered k-space scheme, split-field absorbing layer,
additive pressure source) advances velocities u_i and the parts rho_i of the density by

    u_i   <- s_i (s_i u_i - dt/rho0 D+_i p),
    rho_i <- d_i (d_i rho_i - dt rho0 D-_i u_i) + source_i,        p = c^2 sum_i rho_i,

with spectral derivatives D+-_i of the symbol j k_i exp(+-j k_i dx_i/2) sinc(c |k| dt/2). The
absorbing layer's factors s_i and d_i depend on coordinate i alone. So they commute with the
transforms along the other two axes, and fields of axis i need never leave those axes' wavenumbers:
each line along axis i is advanced on its own, by four transforms of that line, and the pressure
stays a spectrum. That is 12 passes of one-dimensional transforms a step instead of the 30 of ten
three-dimensional ones, each line's work stays in the cache, and pressures in space cost a
transform only when they are read. In exact arithmetic the result is k-Wave's.

The layouts of the spectra are described in `spectral_layout`.
"""

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import scipy.fft
from numpy.typing import DTypeLike

from .arrays import Array, ComplexArray
from .spectral_layout import (
    LINE_AXIS,
    Slab,
    advance_lines,
    along_lines,
    doubled,
    gather,
    half_shape,
    in_layout,
    multiply,
    partial_transform,
    scatter,
    slab_type,
)

_SLAB_BYTES: Final = 2**18
"""Size of a slab's work array: two of them and what they are combined with fit the cache."""
_VALUES_PER_NODE: Final = 12.5
"""Two pressures; three velocities, parts and footprints; k-space correction in each layout."""

Block = tuple[slice, slice, slice]


@dataclass(frozen=True)
class AxisOperators:
    """One axis of k-Wave's equations, all arrays (node,)."""

    spacing_m: float
    wavenumber: Array
    """rad/m, in the order of the transform."""
    gradient: ComplexArray
    """j k exp(j k dx/2): from pressures to velocities half a spacing further."""
    divergence: ComplexArray
    """j k exp(-j k dx/2)."""
    damping: Array
    """Absorbing layer's factor at the pressures."""
    damping_staggered: Array
    """Damping at the velocities."""


@dataclass(frozen=True)
class PressureSource:
    """Additive pressure source, as `kSource.p` with the default mode."""

    nodes: Sequence[tuple[int, int, int]]
    strengths: Array
    """(node,), factors of the signal."""
    signal_pa: Array
    """(step,), at the middle of each step; nothing is added after its end."""


class SpectralStep:
    """Fields of one simulation; `step` advances them, `pressure` reads them.

    The engine owns `threads` threads. Different engines may run side by side.
    """

    def __init__(
        self,
        axes: Sequence[AxisOperators],
        time_step_s: float,
        speed_of_sound_m_per_s: float,
        density_kg_per_m3: float,
        source: PressureSource,
        dtype: DTypeLike = np.float32,
        threads: int = 2,
    ) -> None:
        real = np.dtype(dtype)
        self._shape = tuple(axis.wavenumber.size for axis in axes)
        self._threads = threads
        self._pool = ThreadPoolExecutor(threads) if threads > 1 else None
        self._steps_done = 0
        self._signal = source.signal_pa
        self._pressure = np.zeros(half_shape(self._shape), dtype=np.result_type(real, 1j))
        self._next_pressure = np.zeros_like(self._pressure)
        courant = 0.5 * speed_of_sound_m_per_s * time_step_s
        correction = _of_wavenumber(axes, lambda k: np.sinc(courant * k / np.pi), real)
        footprint = _footprint(axes, source, courant, real)
        self._fields = [
            _AxisField(
                number,
                axis,
                correction,
                footprint,
                velocity_factor=time_step_s / density_kg_per_m3,
                pressure_factor=speed_of_sound_m_per_s**2 * time_step_s * density_kg_per_m3,
                source_factor=2 * speed_of_sound_m_per_s * time_step_s / (3 * axis.spacing_m),
                threads=threads,
            )
            for number, axis in enumerate(axes)
        ]

    def step(self) -> None:
        """Advance all fields by one time step."""
        done = self._steps_done
        signal = float(self._signal[done]) if done < self._signal.size else None
        for field in self._fields:
            self._each_thread(
                field.advance, iter(field.slabs), self._pressure, self._next_pressure, signal
            )
        self._pressure, self._next_pressure = self._next_pressure, self._pressure
        self._steps_done += 1
        if self._steps_done == self._signal.size:
            for field in self._fields:
                field.footprint = None  # its memory is needed no longer

    def pressure(self, block: Block | None = None) -> Array:
        """Sound pressure at the nodes of a block, or at all nodes, Pa, (x, y, z)."""
        along_x, along_y, along_z = block or (slice(None),) * 3
        rows = range(self._shape[0])[along_x]
        part = np.empty((len(rows), *self._pressure.shape[1:]), dtype=self._pressure.dtype)
        field = self._fields[0]
        self._each_thread(field.read, iter(field.slabs), self._pressure, along_x, part)
        part = scipy.fft.ifft(part, axis=1)[:, along_y] / self._shape[0]
        return np.asarray(scipy.fft.irfft(part, n=self._shape[2], axis=2)[:, :, along_z])

    def close(self) -> None:
        """End the engine's threads."""
        if self._pool is not None:
            self._pool.shutdown()

    def _each_thread(self, work: Callable[..., None], *arguments: Any) -> None:
        """Call a function in each thread, with its number first; they share the arguments."""
        if self._pool is None:
            work(0, *arguments)
        else:
            calls = [self._pool.submit(work, thread, *arguments) for thread in range(self._threads)]
            for call in calls:
                call.result()


class _AxisField:
    """Velocity and part of the pressure, c^2 rho_i, of one axis i.

    Both over the position along the axis and the wavenumbers of the other two.
    """

    def __init__(
        self,
        axis: int,
        operators: AxisOperators,
        correction: Array,
        footprint: Array,
        velocity_factor: float,
        pressure_factor: float,
        source_factor: float,
        threads: int,
    ) -> None:
        real = correction.dtype
        self._axis = axis
        self._correction = in_layout(correction, axis, footprint.shape)
        self.footprint: ComplexArray | None = partial_transform(footprint, axis)
        self.footprint *= real.type(source_factor)
        self._velocity = np.zeros_like(self.footprint)
        self._part = np.zeros_like(self.footprint)
        lines = self._velocity.shape[1:]
        complex_type = self._velocity.dtype
        self._gradient = along_lines(operators.gradient, axis, lines).astype(complex_type)
        self._divergence = along_lines(operators.divergence, axis, lines).astype(complex_type)
        self._damping = doubled(along_lines(operators.damping, axis, lines), real)
        self._damping_staggered = doubled(
            along_lines(operators.damping_staggered, axis, lines), real
        )
        # The transforms to positions lack their factor 1/n.
        nodes = operators.wavenumber.size
        self._velocity_factor = real.type(velocity_factor / nodes)
        self._pressure_factor = real.type(pressure_factor / nodes)
        self.slabs = _slabs(self._velocity)
        sizes = {planes.stop - planes.start for planes in self.slabs}
        self._work: list[dict[int, Slab]] = [
            {
                size: slab_type()((size, *lines), LINE_AXIS[axis], self._velocity.dtype)
                for size in sizes
            }
            for _ in range(threads)
        ]

    def advance(
        self,
        thread: int,
        slabs: Iterator[slice],
        old: ComplexArray,
        new: ComplexArray,
        signal: float | None,
    ) -> None:
        """Advance slabs while there are any, and add their part to the new pressure.

        Threads share the iterator: a slower one gets fewer slabs. No two slabs write to the same
        numbers, so the result does not depend on who takes which.
        """
        real = self._correction.dtype.type
        for planes in slabs:
            slab = self._work[thread][planes.stop - planes.start]
            correction = self._correction[planes]
            lines, positions = slab.wavenumber, slab.position.view(real)
            velocity, part = self._velocity[planes], self._part[planes]
            gather(self._axis, old, planes, lines)
            multiply(lines, correction, self._gradient)
            slab.to_position()
            advance_lines(
                velocity.view(real), positions, self._damping_staggered, self._velocity_factor
            )
            slab.to_wavenumber()
            multiply(lines, correction, self._divergence)
            slab.to_position()
            advance_lines(part.view(real), positions, self._damping, self._pressure_factor)
            if signal is not None and self.footprint is not None:
                np.multiply(self.footprint[planes], real(signal), out=lines)
                part += lines
                slab.position[...] = part
            slab.to_wavenumber()
            scatter(self._axis, lines, planes, new)

    def read(
        self,
        thread: int,
        slabs: Iterator[slice],
        pressure: ComplexArray,
        rows: slice,
        part: ComplexArray,
    ) -> None:
        """Fill slabs of the pressure at some positions of axis 0."""
        for planes in slabs:
            slab = self._work[thread][planes.stop - planes.start]
            gather(0, pressure, planes, slab.wavenumber)
            slab.to_position()
            part[:, planes] = slab.position[:, rows].swapaxes(0, 1)


def step_bytes(shape: Sequence[int], dtype: DTypeLike) -> float:
    """Memory that an engine takes at its peak."""
    values = _VALUES_PER_NODE * np.prod([count + 1.0 for count in shape])
    return float(values * np.dtype(dtype).itemsize)


def _slabs(field: ComplexArray) -> list[slice]:
    """Planes of a field in portions of the work arrays' size."""
    planes = field.shape[0]
    count = max(1, _SLAB_BYTES // field[0].nbytes)
    return [slice(first, min(first + count, planes)) for first in range(0, planes, count)]


def _of_wavenumber(
    axes: Sequence[AxisOperators], function: Callable[[Array], Array], real: np.dtype[Any]
) -> Array:
    """A function of |k| on the half spectrum, (x, y, hz); plane by plane, which saves memory."""
    x, y, z = (axis.wavenumber for axis in axes)
    z = z[: z.size // 2 + 1]
    result = np.empty((x.size, y.size, z.size), dtype=real)
    for plane, k in zip(result, x, strict=True):
        plane[...] = function(np.sqrt(k**2 + y[:, None] ** 2 + z**2))
    return result


def _footprint(
    axes: Sequence[AxisOperators], source: PressureSource, courant: float, real: np.dtype[Any]
) -> Array:
    """The source's nodes after the k-space correction of sources, cos(c |k| dt/2), (x, y, z)."""
    nodes = np.zeros([axis.wavenumber.size for axis in axes], dtype=real)
    np.add.at(nodes, tuple(np.transpose(source.nodes)), source.strengths)
    spectrum = scipy.fft.rfftn(nodes)
    spectrum *= _of_wavenumber(axes, lambda k: np.cos(courant * k), real)
    return np.asarray(scipy.fft.irfftn(spectrum, s=nodes.shape, overwrite_x=True))
