"""Reflection of a spherical wave from locally reacting ground. Time factor exp(+jωt)."""

import numpy as np
from scipy.special import wofz

from ..arrays import Array, ComplexArray


def reflection_coefficient(
    wavenumber: float, admittance: complex, distance_m: Array, cosine: Array
) -> ComplexArray:
    """Q = R + (1 - R) F(w): strength of the image source, shape of the distances.

    Weyl-Van der Pol: R = (cos θ - β)/(cos θ + β), F(w) = 1 + j√π w exp(-w²) erfc(-jw),
    w = (1 + j)/2 √(2 k r2/2) (cos θ + β) with exp(-jωt) (Chien and Soroka, J. Sound Vib. 43 (1975)
    9; Attenborough, J. Acoust. Soc. Am. 68 (1980) 1521); here all is the complex conjugate. Leading
    term for waves short against r2 and |β| up to about one; exact on hard ground.

    Parameters
    ----------
    wavenumber : k, rad/m
    admittance : β = ρc/Z
    distance_m : r2 from the image source, shape (...)
    cosine : of the angle of incidence from the vertical, cos θ = (z + h)/r2, shape (...)
    """
    if admittance == 0.0:
        return np.ones(np.shape(distance_m), dtype=complex)
    beta = np.conj(admittance)
    plane = (cosine - beta) / (cosine + beta)
    numerical = 0.5 * (1.0 + 1.0j) * np.sqrt(wavenumber * distance_m) * (cosine + beta)
    loss = 1.0 + 1.0j * np.sqrt(np.pi) * numerical * wofz(numerical)
    return np.asarray(np.conj(plane + (1.0 - plane) * loss))
