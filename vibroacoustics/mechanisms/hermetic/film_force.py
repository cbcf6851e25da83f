"""Force of an oil film in x and y: the half where the pressure is positive, or as printed."""

from collections.abc import Callable
from typing import Final

import numpy as np

from .journal_bearing import Values, sommerfeld_angle
from .parameters import JournalBearing

FilmForce = Callable[[JournalBearing, Values, Values, Values], Values]
"""Force on the journal, N, from its displacement, velocity (..., 2) and spin (...)."""

COMPLEX_STEP: Final = 1e-30
"""A complex step has no cancellation; it need only be small beside a displacement of 1 nm."""


def film_integrals(
    eccentricity: Values, start: Values, end: Values
) -> tuple[Values, Values, Values]:
    """Integrals of cos², sin cos and sin² over (1 + ε cos φ)³ from `start` to `end`."""
    gap = 1.0 - eccentricity**2

    def primitives(angle: Values) -> tuple[Values, Values, Values]:
        gamma = sommerfeld_angle(angle, eccentricity)
        half, double = 0.5 * gamma, 0.25 * np.sin(2.0 * gamma)
        cosines = half + double - 2.0 * eccentricity * np.sin(gamma) + eccentricity**2 * gamma
        mixed = 0.5 * np.sin(gamma) ** 2 + eccentricity * np.cos(gamma)
        return cosines / gap**2.5, mixed / gap**2, (half - double) / gap**1.5

    upper, lower = primitives(end), primitives(start)
    return upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]


def positive_film_force(
    bearing: JournalBearing, displacement_m: Values, velocity: Values, spin: Values
) -> Values:
    """Force of a short film over the half where its pressure is positive, whichever that is.

    With V = v - Ω/2 ẑ x e the pressure of eq. 24 is 6µ (l²/4 - z²) V·n / h³, positive on the half
    that V points to (Booker 1965), so that (26) and (27) follow for dε/dt = 0 and u > 0. The
    printed ones keep 0 ≤ φ ≤ π and suck the journal outwards where u < 0 or dε/dt < 0.

    Parameters
    ----------
    bearing : radius, width and clearance in m, viscosity in Pa s
    displacement_m : journal centre from the bearing's, shape (..., 2)
    velocity : of the journal centre, m/s, shape (..., 2)
    spin : Ω, rad/s

    Returns
    -------
    force on the journal, N, shape (..., 2)
    """
    x, y = displacement_m[..., 0], displacement_m[..., 1]
    eccentric = np.sqrt(x**2 + y**2)
    cosine, sine = -x / eccentric, -y / eccentric  # to the thickest film
    slip_x, slip_y = velocity[..., 0] + 0.5 * spin * y, velocity[..., 1] - 0.5 * spin * x
    along, across = cosine * slip_x + sine * slip_y, cosine * slip_y - sine * slip_x
    middle = _angle(along, across)
    cosines, mixed, sines = film_integrals(
        eccentric / bearing.clearance_m, middle - 0.5 * np.pi, middle + 0.5 * np.pi
    )
    scale = (
        -bearing.viscosity_pa_s * bearing.radius_m * (bearing.width_m / bearing.clearance_m) ** 3
    )
    force_along = scale * (cosines * along + mixed * across)
    force_across = scale * (mixed * along + sines * across)
    return np.stack(
        (cosine * force_along - sine * force_across, sine * force_along + cosine * force_across),
        axis=-1,
    )


def _angle(x: Values, y: Values) -> Values:
    """Angle of (x, y), differentiable by a complex step, unlike arctan2."""
    base = np.arctan2(y.real, x.real)
    turned_x = x * np.cos(base) + y * np.sin(base)
    turned_y = y * np.cos(base) - x * np.sin(base)
    return np.asarray(base + np.arctan(turned_y / turned_x))
