"""Layout of the fields of the spectral step, and the compiled loops over their lines.

Real fields need half of their spectrum. The last axis is the one cut in half, except for fields
of the last axis itself, which are cut in half along the second.

Layouts, with half lengths h = n//2 + 1: pressure (x, y, hz); fields of axis 0 (y, x, hz), of axis
1 (x, y, hz), of axis 2 (x, hy, z). The second or third axis is that of the lines; slabs are cut
along the first.
"""

from collections.abc import Sequence
from typing import Any, Final

import numba
import numpy as np
import scipy.fft
from numpy.typing import DTypeLike

from .arrays import Array, ComplexArray

_kernel = numba.njit(cache=True, nogil=True)
LINE_AXIS: Final = {0: 1, 1: 1, 2: 2}
"""Axis of a slab along which its lines run, by the axis of space that they follow."""


class ScipySlab:
    """Lines of complex numbers over wavenumber and over position, transformed into each other.

    `to_position` is the inverse transform without its factor 1/n. Both arrays have the shape of
    the slab; a transform may overwrite nothing but its result.
    """

    def __init__(self, shape: tuple[int, int, int], line_axis: int, dtype: DTypeLike) -> None:
        self.wavenumber: ComplexArray = np.zeros(shape, dtype=dtype)
        self.position: ComplexArray = np.zeros(shape, dtype=dtype)
        self._line_axis = line_axis

    def to_position(self) -> None:
        """Sum over wavenumbers at each position."""
        self.position[...] = scipy.fft.ifft(self.wavenumber, axis=self._line_axis, norm="forward")

    def to_wavenumber(self) -> None:
        """Sum over positions at each wavenumber."""
        self.wavenumber[...] = scipy.fft.fft(self.position, axis=self._line_axis)


class FftwSlab:
    """Slab on FFTW, two to three times as fast.

    Plans are estimated, never measured: measuring would choose another algorithm from run to run
    and change the last bits. The transforms release Python's lock.
    """

    def __init__(self, shape: tuple[int, int, int], line_axis: int, dtype: DTypeLike) -> None:
        import pyfftw

        self.wavenumber: ComplexArray = pyfftw.zeros_aligned(shape, dtype=dtype)
        self.position: ComplexArray = pyfftw.zeros_aligned(shape, dtype=dtype)

        def plan(source: ComplexArray, target: ComplexArray, direction: str) -> Any:
            return pyfftw.FFTW(
                source,
                target,
                axes=(line_axis,),
                direction=direction,
                flags=("FFTW_ESTIMATE",),
                threads=1,
            )

        self.to_position = plan(self.wavenumber, self.position, "FFTW_BACKWARD").execute
        self.to_wavenumber = plan(self.position, self.wavenumber, "FFTW_FORWARD").execute


def half_shape(shape: Sequence[int]) -> tuple[int, ...]:
    """Shape of the half spectrum of a real field."""
    return (*shape[:-1], shape[-1] // 2 + 1)


def partial_transform(field: Array, axis: int) -> ComplexArray:
    """A field in space in the layout of the fields of one axis."""
    others = [other for other in range(3) if other != axis]
    spectrum: ComplexArray = scipy.fft.rfftn(field, axes=others)
    return np.ascontiguousarray(spectrum.swapaxes(0, 1)) if axis == 0 else spectrum


def in_layout(half: Array, axis: int, shape: Sequence[int]) -> Array:
    """A real function of |k|, (x, y, hz), in the layout of the fields of one axis."""
    if axis == 0:
        return np.ascontiguousarray(half.swapaxes(0, 1))
    if axis == 1:
        return half
    mirrored = half[:, : shape[1] // 2 + 1, (shape[2] - 1) // 2 : 0 : -1]
    return np.concatenate([half[:, : shape[1] // 2 + 1], mirrored], axis=2)


def along_lines(values: Array | ComplexArray, axis: int, lines: tuple[int, ...]) -> Any:
    """Values of a line repeated for a plane of lines."""
    column = values if LINE_AXIS[axis] == 2 else values[:, None]
    return np.ascontiguousarray(np.broadcast_to(column, lines))


def doubled(values: Array, real: np.dtype[Any]) -> Array:
    """Each value of a plane twice, once for the real part and once for the imaginary one."""
    return np.asarray(np.repeat(values, 2, axis=-1).astype(real))


def gather(axis: int, pressure: ComplexArray, planes: slice, lines: ComplexArray) -> None:
    """Copy a slab of the pressure's spectrum into the layout of an axis."""
    if axis == 0:
        lines[...] = pressure[:, planes].swapaxes(0, 1)
    elif axis == 1:
        lines[...] = pressure[planes]
    else:
        _gather_z(pressure, planes.start, lines)


def scatter(axis: int, lines: ComplexArray, planes: slice, pressure: ComplexArray) -> None:
    """Write a slab's part of the pressure's spectrum: axis 0 comes first, the others add."""
    if axis == 0:
        pressure[:, planes] = lines.swapaxes(0, 1)
    elif axis == 1:
        pressure[planes] += lines
    else:
        _scatter_z(lines, planes.start, pressure)


@_kernel
def _gather_z(pressure: ComplexArray, first: int, lines: ComplexArray) -> None:
    """Complete the half spectrum along z: values at -k are conjugates of those at k."""
    nx, ny, half = pressure.shape
    nz = lines.shape[2]
    for plane in range(lines.shape[0]):
        for y in range(lines.shape[1]):
            line, x = lines[plane, y], first + plane
            line[:half] = pressure[x, y]
            mate = pressure[(nx - x) % nx, (ny - y) % ny]
            for z in range(1, nz - half + 1):
                line[nz - z] = np.conj(mate[z])


@_kernel
def _scatter_z(lines: ComplexArray, first: int, pressure: ComplexArray) -> None:
    """Add to wavenumbers (kx, ky) and, the fields being real, to (-kx, -ky)."""
    nx, ny, half = pressure.shape
    nz = lines.shape[2]
    for plane in range(lines.shape[0]):
        for y in range(lines.shape[1]):
            line, x = lines[plane, y], first + plane
            row = pressure[x, y]
            for z in range(half):
                row[z] += line[z]
            if 0 < y < ny - y:  # elsewhere -ky is ky, whose lines are all here
                mate = pressure[(nx - x) % nx, ny - y]
                mate[0] += np.conj(line[0])
                for z in range(1, half):
                    mate[z] += np.conj(line[nz - z])


@_kernel
def multiply(lines: ComplexArray, correction: Array, derivative: ComplexArray) -> None:
    """Differentiate along the lines: times k-space correction and derivative."""
    for plane in range(lines.shape[0]):
        for row in range(lines.shape[1]):
            line, factor, symbol = lines[plane, row], correction[plane, row], derivative[row]
            for column in range(line.size):
                line[column] *= factor[column] * symbol[column]


@_kernel
def advance_lines(field: Array, change: Array, damping: Array, factor: np.floating[Any]) -> None:
    """Field <- d (d field - factor change), kept and put in place of the change."""
    for plane in range(field.shape[0]):
        for row in range(field.shape[1]):
            old, new, damp = field[plane, row], change[plane, row], damping[row]
            for column in range(old.size):
                value = damp[column] * (damp[column] * old[column] - factor * new[column])
                old[column] = value
                new[column] = value


Slab = FftwSlab | ScipySlab


def slab_type() -> type[FftwSlab] | type[ScipySlab]:
    """FFTW's slabs, or SciPy's where pyFFTW is not installed."""
    try:
        import pyfftw  # noqa: F401
    except ImportError:
        return ScipySlab
    return FftwSlab
