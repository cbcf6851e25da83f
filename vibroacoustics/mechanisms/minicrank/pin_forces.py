"""Forces at the pins of a scroll with one rigid mini-crank (Zhao et al. 2013)."""

import numpy as np

from ...base.arrays import Array
from ...base.constants import STANDARD_GRAVITY_M_PER_S2
from ...base.errors import ParameterError
from ...mechanics.crankshaft import acceleration_of
from ...mechanics.rotation import Rotation
from .cycle import ScrollLoad, weight_moment
from .four_bar import FourBarMotion
from .links import Links
from .parameters import Masses


def minicrank_pin_force(
    links: Links, moved: FourBarMotion, masses: Masses, load: ScrollLoad, rotation: Rotation
) -> Array:
    """Force of the scroll on the mini-crank, x and y, shape (2, samples), N.

    From the moments of the scroll about the crank pin and of the mini-crank about its axis.

    Raises
    ------
    ParameterError
        The links are a parallelogram: a single mini-crank cannot hold the scroll where all links
        are in line.
    """
    if links.is_parallelogram:
        raise ParameterError(
            "crank_error_um, scroll_error_um, minicrank_error_um, bracket_error_um = 0 µm: a "
            "parallelogram with one mini-crank takes no moment where its links are in line"
        )
    second, third = moved.scroll_angle, moved.minicrank_angle
    scroll_turn, minicrank_turn = (acceleration_of(angle, rotation) for angle in (second, third))
    on_scroll = load.moment_n_m - masses.scroll_inertia_kg_m2 * scroll_turn
    on_minicrank = masses.minicrank_inertia_kg_m2 * minicrank_turn
    on_minicrank = on_minicrank + weight_moment(links, moved, masses)
    along_third = on_scroll / links.scroll_m
    along_second = -on_minicrank / links.minicrank_m
    sine = np.sin(third[0] - second[0])
    return np.asarray(
        (along_third * direction(third[0]) + along_second * direction(second[0])) / sine
    )


def crank_pin_force(
    links: Links, moved: FourBarMotion, masses: Masses, load: ScrollLoad, rotation: Rotation
) -> Array:
    """Force of the scroll on the crank pin, x and y, shape (2, samples), N.

    Gas, weight and inertia of the scroll, less what the mini-crank takes (Zhao et al. 2013,
    figure 3).

    Raises
    ------
    ParameterError
        As `minicrank_pin_force`.
    """
    outward, forward = direction(moved.crank_angle), direction(moved.crank_angle + 0.5 * np.pi)
    gas = -load.tangential_force_n * forward - load.radial_force_n * outward
    weight = np.array([[0.0], [-masses.scroll_mass_kg * STANDARD_GRAVITY_M_PER_S2]])
    inertia = turning_force(masses.scroll_mass_kg * links.crank_m, moved.crank_angle, rotation)
    taken = minicrank_pin_force(links, moved, masses, load, rotation)
    return np.asarray(gas + weight + inertia - taken)


def turning_force(mass_moment_kg_m: float, crank_angle: Array, rotation: Rotation) -> Array:
    """-Σ m a of a mass moment that turns with the crankshaft, x and y, shape (2, samples), N."""
    outward, forward = direction(crank_angle), direction(crank_angle + 0.5 * np.pi)
    along = rotation.speed_rad_per_s**2 * outward - rotation.acceleration_rad_per_s2 * forward
    return np.asarray(mass_moment_kg_m * along)


def direction(angle: Array) -> Array:
    """Unit vectors x and y, shape (2, samples)."""
    return np.stack([np.cos(angle), np.sin(angle)])
