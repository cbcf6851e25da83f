"""Oil film of a short plain bearing for small motions about its steady position."""

from dataclasses import dataclass
from math import pi, sqrt
from typing import Final

import numpy as np
from scipy.optimize import brentq

from ..base.arrays import Array, ComplexArray
from ..base.errors import ParameterError

DEEPEST: Final = 0.999
"""Eccentricity ratio up to which an equilibrium is sought."""


@dataclass(frozen=True)
class JournalFilm:
    """Film under a load that turns with the journal, in axes that turn with the load.

    Attributes
    ----------
    eccentricity_ratio : eccentricity of the journal per clearance
    stiffness : shape (2, 2), N/m
    damping : shape (2, 2), N s/m
    """

    eccentricity_ratio: float
    stiffness: Array
    damping: Array

    def flexibility(self, joint_stiffness: complex, omega: Array) -> ComplexArray:
        """Flexibility of film and joint in series, alike in all directions, m/N.

        The reciprocal of half the trace of their dynamic stiffness: its mean over a turn. Trace and
        determinant of the film's dynamic stiffness suffice.

        Parameters
        ----------
        joint_stiffness : with loss, N/m
        omega : shape (frequency,), rad/s
        """
        film = self.stiffness + 1j * omega[:, None, None] * self.damping
        trace = film[:, 0, 0] + film[:, 1, 1]
        determinant = film[:, 0, 0] * film[:, 1, 1] - film[:, 0, 1] * film[:, 1, 0]
        joint = 1.0 / joint_stiffness
        numerator = 1.0 + joint * trace + joint**2 * determinant
        return np.asarray(2.0 * numerator / (trace + 2.0 * joint * determinant))


def short_bearing(
    diameter_m: float, length_m: float, clearance_m: float, viscosity_pa_s: float,
    speed_rad_per_s: float, load_n: float,
) -> JournalFilm:  # fmt: skip
    """Film of a short bearing, cavitated over half the turn (Ocvirk; Friswell et al. 2010, 5.5).

    A load that turns with the journal gives the coefficients of one at rest: seen from the load
    the sleeve turns backwards as fast.

    Parameters
    ----------
    diameter_m, length_m : diameter and length of the bearing
    clearance_m : radial
    viscosity_pa_s : viscosity of the oil
    speed_rad_per_s : speed of the journal
    load_n : constant, turning with the journal or at rest, along the first axis

    Raises
    ------
    ParameterError
        The film cannot carry the load.
    """
    scale = viscosity_pa_s * speed_rad_per_s * diameter_m * length_m**3 / (8.0 * clearance_m**2)
    most = scale * _force(DEEPEST) / (1.0 - DEEPEST**2) ** 2
    if not 0.0 < load_n <= most:
        raise ParameterError(
            f"load_n = {load_n:g} N: must be above 0 and at most {most:g} N, what the film carries "
            f"at an eccentricity ratio of {DEEPEST:g}"
        )
    ratio = float(brentq(_excess, 0.0, DEEPEST, (load_n / scale,), 1e-15))
    e2, gap = ratio**2, 1.0 - ratio**2
    common, cross = (pi**2 * gap + 16.0 * e2) ** -1.5, ratio * sqrt(gap)
    swirl = pi**2 * (1.0 + 2.0 * e2) - 16.0 * e2
    stiffness = np.array(
        [
            [
                4.0 * (pi**2 * (1.0 + 2.0 * e2) + 32.0 * e2 * (1.0 + e2) / gap),
                pi * (pi**2 * gap * (1.0 + 2.0 * e2) + 32.0 * e2 * (1.0 + e2)) / cross,
            ],
            [
                -pi * (pi**2 * gap**2 - 16.0 * e2**2) / cross,
                4.0 * (pi**2 * (2.0 - e2) + 16.0 * e2),
            ],
        ]
    )
    damping = np.array(
        [
            [2.0 * pi * (pi**2 * gap**2 + 48.0 * e2) / cross, 8.0 * swirl],
            [8.0 * swirl, 2.0 * pi * sqrt(gap) * swirl / ratio],
        ]
    )
    per_length = common * load_n / clearance_m
    return JournalFilm(ratio, per_length * stiffness, per_length / speed_rad_per_s * damping)


def _excess(ratio: float, load: float) -> float:
    return _force(ratio) - load * (1.0 - ratio**2) ** 2


def _force(ratio: float) -> float:
    """Load times (1 - ε²)² over μ Ω R L³/4c² of a short bearing at an eccentricity ratio ε."""
    return ratio * sqrt(16.0 * ratio**2 + pi**2 * (1.0 - ratio**2))
