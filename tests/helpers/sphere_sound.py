"""Sound of a sphere in closed form. Time factor exp(+j omega t)."""

import numpy as np
from scipy import special

from vibroacoustics.base.constants import AIR_DENSITY_KG_PER_M3, SPEED_OF_SOUND_M_PER_S
from vibroacoustics.radiation.arrays import Array, ComplexArray
from vibroacoustics.radiation.exact import wavenumber


def outgoing_hankel(order: int, argument: Array, derivative: bool = False) -> ComplexArray:
    """Spherical Hankel function of the second kind h_n = j_n - j y_n, or its derivative."""
    real = special.spherical_jn(order, argument, derivative)
    imaginary = special.spherical_yn(order, argument, derivative)
    hankel: ComplexArray = real - 1j * imaginary
    return hankel


def sphere_pressure(
    order: int, radius_m: float, distance_m: float, cosine: Array, frequency_hz: Array
) -> ComplexArray:
    """Sound pressure of a sphere with the normal velocity P_n(cos theta), per m/s.

    p = -j rho c h_n(kr)/h_n'(ka) P_n(cos theta); order 0 pulsates, order 1 oscillates.
    Cosines (angle,) of the polar angle; result (frequency, angle), Pa.
    Morse and Ingard, Theoretical Acoustics (1968), section 7.2.
    """
    k = wavenumber(frequency_hz)
    impedance = AIR_DENSITY_KG_PER_M3 * SPEED_OF_SOUND_M_PER_S
    radial = outgoing_hankel(order, k * distance_m) / outgoing_hankel(order, k * radius_m, True)
    pressure: ComplexArray = (
        -1j * impedance * np.multiply.outer(radial, special.eval_legendre(order, cosine))
    )
    return pressure
