"""Stiffness and damping of a film under a steady load, and the modes of a shaft on such films."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.optimize import brentq

from ...base.arrays import Array
from ...base.errors import ParameterError
from ...mechanics.beam_rotor import RotorMatrices
from .film_force import COMPLEX_STEP, positive_film_force
from .journal_bearing import short_bearing_force
from .parameters import JournalBearing

DEEPEST: Final = 0.999
"""Eccentricity up to which an equilibrium is sought."""


@dataclass(frozen=True)
class LinearFilm:
    """A film about its equilibrium: force f = f0 - K x - D v on the journal.

    Attributes
    ----------
    eccentricity : ε
    stiffness_n_per_m, damping_ns_per_m : shape (2, 2); the load acts along x
    """

    eccentricity: float
    stiffness_n_per_m: Array
    damping_ns_per_m: Array


def linear_film(bearing: JournalBearing, load_n: float, spin_rad_per_s: float) -> LinearFilm:
    """Short half-Sommerfeld film about the equilibrium of a steady load along x.

    Parameters
    ----------
    bearing : radius, width and clearance in m, viscosity in Pa s
    load_n : on the journal, along x, N
    spin_rad_per_s : Ω

    Raises
    ------
    ParameterError
        The film cannot carry the load.
    """

    def force(eccentricity: float) -> tuple[float, float]:
        values = short_bearing_force(
            bearing, np.array(eccentricity), np.array(0.0), np.array(spin_rad_per_s)
        )
        return float(values[0]), float(values[1])

    def excess(eccentricity: float) -> float:
        return float(np.hypot(*force(eccentricity))) - load_n

    if not 0.0 < load_n < load_n + excess(DEEPEST):
        raise ParameterError(
            f"load_n = {load_n:g} N: must be above 0 and below {load_n + excess(DEEPEST):g} N, "
            f"what the film carries at an eccentricity of {DEEPEST:g}"
        )
    eccentricity = float(brentq(excess, 1e-9, DEEPEST, xtol=1e-15))
    radial, transverse = force(eccentricity)
    # The film's force stands at (π - its angle) from ξ; the load opposes it along +x.
    attitude = np.pi - np.arctan2(transverse, radial)
    position = bearing.clearance_m * eccentricity * np.array([np.cos(attitude), np.sin(attitude)])
    stiffness, damping = (np.zeros((2, 2)) for _ in range(2))
    for axis in range(2):
        step = 1j * COMPLEX_STEP * np.eye(2)[axis]
        spin = np.array(spin_rad_per_s)
        moved = positive_film_force(bearing, position + step, np.zeros(2), spin)
        moving = positive_film_force(bearing, position + 0j, step, spin)
        stiffness[:, axis] = -moved.imag / COMPLEX_STEP
        damping[:, axis] = -moving.imag / COMPLEX_STEP
    return LinearFilm(eccentricity, stiffness, damping)


def damped_modes(
    rotor: RotorMatrices, films: dict[int, LinearFilm], spin_rad_per_s: float
) -> tuple[Array, Array]:
    """Damped natural frequencies, ascending, and damping ratios of a rotor on linear films.

    Parameters
    ----------
    rotor : M, G and K
    films : by the freedom of x of the journal; y follows it
    spin_rad_per_s : Ω

    Returns
    -------
    frequencies in Hz and damping ratios of the oscillating modes
    """
    damping, stiffness = spin_rad_per_s * rotor.gyroscopic, rotor.stiffness.copy()
    for at, film in films.items():
        stiffness[at : at + 2, at : at + 2] += film.stiffness_n_per_m
        damping[at : at + 2, at : at + 2] += film.damping_ns_per_m
    zero, one = np.zeros_like(stiffness), np.eye(len(stiffness))
    lower = -np.linalg.solve(rotor.mass, np.hstack((stiffness, damping)))
    values = np.linalg.eigvals(np.vstack((np.hstack((zero, one)), lower)))
    values = values[values.imag > 1.0]
    values = values[np.argsort(values.imag)]
    return values.imag / (2.0 * np.pi), -values.real / np.abs(values)
