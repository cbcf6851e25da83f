"""Order analysis: spectra over crank angle and the ellipses of vector orders."""

from .ellipse import semi_major_axis
from .spectrum import FFT_ENGINE, order_spectrum

__all__ = ["FFT_ENGINE", "order_spectrum", "semi_major_axis"]
