"""Fast Fourier transforms for k-Wave's NumPy backend: pyFFTW with cached plans, or SciPy.

The fields are real, so half of each spectrum tells the rest: `fftn` is the real-to-complex
transform and `ifftn` its inverse. `kwave.build_simulation` cuts k-Wave's operators to match.
"""

from typing import Any, Final

import numpy as np
import scipy.fft

from .arrays import Array, ComplexArray

THREADS: Final = 2


class ScipyFft:
    """The part of `numpy.fft` that k-Wave uses, for real fields, on SciPy's threads."""

    fftfreq = staticmethod(np.fft.fftfreq)

    def __init__(self, shape: tuple[int, ...]) -> None:
        self._shape = shape

    def fftn(self, values: Array) -> ComplexArray:
        result: ComplexArray = scipy.fft.rfftn(values, workers=THREADS)
        return result

    def ifftn(self, values: ComplexArray) -> Array:
        result: Array = scipy.fft.irfftn(values, s=self._shape, workers=THREADS)
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

        half = (*shape[:-1], shape[-1] // 2 + 1)
        arrays = {
            "real": lambda: pyfftw.empty_aligned(shape, dtype="float64"),
            "complex": lambda: pyfftw.empty_aligned(half, dtype="complex128"),
        }

        def plan(source: str, target: str, direction: str) -> Any:
            return pyfftw.FFTW(
                arrays[source](),
                arrays[target](),
                axes=tuple(range(len(shape))),
                direction=direction,
                flags=("FFTW_ESTIMATE",),
                threads=THREADS,
            )

        self._forward = plan("real", "complex", "FFTW_FORWARD")
        self._backward = plan("complex", "real", "FFTW_BACKWARD")

    def fftn(self, values: Array) -> ComplexArray:
        result: ComplexArray = _execute(self._forward, values)
        return result

    def ifftn(self, values: ComplexArray) -> Array:
        result: Array = _execute(self._backward, values)
        result *= 1.0 / result.size
        return result


def _execute(plan: Any, values: Any) -> Any:
    plan.input_array[...] = values
    plan.execute()
    return plan.output_array


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
        return NumpyWith(ScipyFft(shape))
