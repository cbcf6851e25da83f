"""Wall impedances: passive branches of mass, resistance and spring that absorb what is asked for.

Absorption alone does not fix the phase of a reflection. The branches here are as damped as
overlapping octaves need; walls of the same absorption and another phase shift the modes of a room.
"""

from dataclasses import dataclass
from functools import cache, lru_cache
from typing import Final

import numpy as np

from ..arrays import Array, ComplexArray
from .materials import MOST_ABSORPTION, OCTAVES_HZ, WAVE_OCTAVES, Material

QUALITY: Final = 0.6
"""Of each branch (assumed): lower blurs the octaves, higher leaves dips between them."""


@dataclass(frozen=True)
class Branches:
    """Parallel branches of impedance j omega L + R + K/(j omega), in units of rho c, (branch,).

    S. Bilbao, B. Hamilton, J. Botts, L. Savioja, "Finite volume time domain room acoustics
    simulation under general impedance boundary conditions", IEEE/ACM Trans. Audio Speech Lang.
    Process. 24 (2016), equation 12. Passive, as no part is negative.
    """

    mass: Array
    """s."""
    resistance: Array
    spring: Array
    """1/s."""

    def admittance(self, frequency_hz: Array) -> ComplexArray:
        """rho c u/p of the wall, (frequency,)."""
        total: ComplexArray = (1.0 / self._impedances(frequency_hz).sum(axis=1)).sum(axis=1)
        return total

    def slopes(self, frequency_hz: Array) -> ComplexArray:
        """Change of the admittance with the logarithm of each part, (frequency, part, branch)."""
        parts = self._impedances(frequency_hz)
        slopes: ComplexArray = -parts / parts.sum(axis=1, keepdims=True) ** 2
        return slopes

    def _impedances(self, frequency_hz: Array) -> ComplexArray:
        """Of mass, resistance and spring, (frequency, part, branch)."""
        s = 2j * np.pi * np.asarray(frequency_hz, dtype=float)[:, None]
        parts: ComplexArray = np.stack(
            np.broadcast_arrays(s * self.mass, self.resistance, self.spring / s), axis=1
        )
        return parts


def absorption_at_angle(admittance: ComplexArray | Array, cosine: Array) -> Array:
    """Absorbed share of a plane wave, 4 Re(Y) cos / |cos + Y|² for an admittance Y of rho c.

    H. Kuttruff, Room Acoustics, 6th edition (2016), equation 2.29, of the impedance 1/Y.
    """
    share: Array = 4.0 * np.real(admittance) * cosine / np.abs(cosine + admittance) ** 2
    return share


def random_absorption(admittance: ComplexArray | Array) -> Array:
    """Absorbed share at random incidence, the integral of alpha sin(2 theta) over the angle.

    Kuttruff (2016), equation 2.52 (Paris); Gauss-Legendre quadrature over cos(theta).
    """
    node, weight = _quadrature()
    cosine = (node + 1.0) / 2.0
    share = absorption_at_angle(admittance[..., None], cosine)
    mean: Array = (cosine * weight * share).sum(axis=-1)
    return mean


@cache
def _quadrature() -> tuple[Array, Array]:
    return np.polynomial.legendre.leggauss(64)


def octave_branches(weights: Array) -> Branches:
    """A branch at each octave's middle with the admittance `weights` there, (octave,)."""
    omega = 2.0 * np.pi * np.array(OCTAVES_HZ[: weights.size])
    resistance = 1.0 / weights
    return Branches(QUALITY * resistance / omega, resistance, QUALITY * resistance * omega)


@lru_cache
def fitted_branches(material: Material) -> Branches:
    """Branches of a material: least squares of the absorption at the octaves that waves see."""
    from scipy.optimize import least_squares

    octaves = np.array(OCTAVES_HZ[:WAVE_OCTAVES])
    wanted = np.minimum(material.absorption[:WAVE_OCTAVES], MOST_ABSORPTION)

    def error(logarithm: Array) -> Array:
        branches = octave_branches(np.exp(logarithm))
        difference = random_absorption(branches.admittance(octaves)) - wanted
        error: Array = difference / np.sqrt(0.05 + wanted)
        return error

    start = np.log(np.maximum(wanted, 1e-3) / 8.0)
    fit = least_squares(error, start, bounds=(np.log(1e-7), np.log(10.0)))
    return octave_branches(np.exp(fit.x))
