"""Fast Fourier transforms of slabs of lines, planned once: FFTW, or SciPy without it."""

from typing import Any, Final

import numpy as np
import scipy.fft
from numpy.typing import DTypeLike

from .arrays import ComplexArray

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
    """The same on FFTW, two to three times as fast.

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


Slab = FftwSlab | ScipySlab


def slab_type() -> type[FftwSlab] | type[ScipySlab]:
    """FFTW's slabs, or SciPy's where pyFFTW is not installed."""
    try:
        import pyfftw  # noqa: F401
    except ImportError:
        return ScipySlab
    return FftwSlab
