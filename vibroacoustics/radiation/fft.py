"""Fast Fourier transforms for k-Wave's NumPy backend: pyFFTW with cached plans, or SciPy."""

from typing import Any, Final

import numpy as np
import scipy.fft

from .arrays import Array, ComplexArray

THREADS: Final = 2


class ScipyFft:
    """The part of `numpy.fft` that k-Wave uses, on SciPy's threads."""

    fftfreq = staticmethod(np.fft.fftfreq)

    def fftn(self, values: Array | ComplexArray) -> ComplexArray:
        result: ComplexArray = scipy.fft.fftn(values, workers=THREADS)
        return result

    def ifftn(self, values: ComplexArray) -> ComplexArray:
        result: ComplexArray = scipy.fft.ifftn(values, workers=THREADS)
        return result


class PyfftwFft:
    """The same on FFTW, with one plan each way for one shape.

    Plans are estimated, never measured: measuring would choose another algorithm from run to run
    and change the last bits. A result stays valid until the next transform of the same direction,
    which is all that k-Wave's step needs.
    """

    fftfreq = staticmethod(np.fft.fftfreq)

    def __init__(self, shape: tuple[int, ...]) -> None:
        import pyfftw

        def plan(direction: str) -> Any:
            arrays = [pyfftw.empty_aligned(shape, dtype="complex128") for _ in range(2)]
            return pyfftw.FFTW(
                *arrays,
                axes=tuple(range(len(shape))),
                direction=direction,
                flags=("FFTW_ESTIMATE",),
                threads=THREADS,
            )

        self._forward, self._backward = plan("FFTW_FORWARD"), plan("FFTW_BACKWARD")

    def fftn(self, values: Array | ComplexArray) -> ComplexArray:
        return _execute(self._forward, values)

    def ifftn(self, values: ComplexArray) -> ComplexArray:
        result = _execute(self._backward, values)
        result *= 1.0 / result.size
        return result


def _execute(plan: Any, values: Array | ComplexArray) -> ComplexArray:
    plan.input_array[...] = values
    plan.execute()
    result: ComplexArray = plan.output_array
    return result


class NumpyWith:
    """The `numpy` namespace with another `fft`; k-Wave's `Simulation.xp` is set to it."""

    def __init__(self, fft: Any) -> None:
        self.fft = fft

    def __getattr__(self, name: str) -> Any:
        return getattr(np, name)


def fft_namespace(shape: tuple[int, ...]) -> NumpyWith:
    """NumPy with FFTW's transforms, or with SciPy's where pyFFTW is not installed."""
    try:
        return NumpyWith(PyfftwFft(shape))
    except ImportError:
        return NumpyWith(ScipyFft())
