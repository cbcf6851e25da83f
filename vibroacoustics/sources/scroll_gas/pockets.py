"""Pockets between two involute wraps: where they touch, what they hold, in closed form.

The two wraps touch in pairs of contacts. At a contact the inner flank of one wrap, at the involute
angle φ, meets the outer flank of the other, at φ - π; its contact angle is their mean, t = φ - π/2.
It falls by the crank angle, and the next contact inwards lies a turn further in.
"""

import numpy as np

from ...base.arrays import Array
from .parameters import ScrollWraps


def contact_angle(wraps: ScrollWraps, angle_since_closing: Array) -> Array:
    """Contact angle t of the outer end of a pocket, rad.

    Parameters
    ----------
    wraps : geometry
    angle_since_closing : crank angle since the pocket has closed, any shape, rad
    """
    return np.asarray(wraps.end_angle_rad - 0.5 * np.pi - angle_since_closing)


def contact_count(wraps: ScrollWraps, equalisation_angle_rad: float) -> int:
    """Largest number of contacts of a pair of flanks at a time.

    A contact that has just opened counts as long as its pocket comes to the discharge pressure.
    """
    kept = wraps.opening_angle_rad + equalisation_angle_rad
    return int(np.ceil(kept / (2.0 * np.pi))) + 1


def pocket_volume(wraps: ScrollWraps, angle_since_closing: Array) -> Array:
    """Volume of one pocket, V = 2π r_b r_o h t with the mean t of its two contacts, m³.

    Linear in the crank angle; displacement and volume ratio are those of Bell's PDSim
    (`Scroll.Vdisp`, `Scroll.Vratio`).

    Parameters
    ----------
    wraps : geometry
    angle_since_closing : crank angle since the pocket has closed, any shape, rad
    """
    mean = contact_angle(wraps, angle_since_closing) - np.pi
    return 2.0 * np.pi * wraps.base_radius_m * wraps.orbit_radius_m * wraps.height_m * mean


def area_inside(wraps: ScrollWraps, contact: Array) -> Array:
    """Plate area on which a pressure step at a pair of contacts acts axially, m².

    A = π r_b² (t² + a² + π²/12 - 1 + 4a/π), a = thickness/(2 r_b): all inside the two contacts,
    gas and wraps, and half the tips of the half turns of wrap that part the pressures there, as
    the pressure is taken to fall linearly across a tip. The shape of the wraps' starts does not
    matter, for the pressure is the same around them.

    From ½∮ r x dr along the closed line of the two inner flanks from φ - π to φ, where
    r x dr = r_b² u² dφ with u = φ - a, and across the two wraps at φ - π.

    Parameters
    ----------
    wraps : geometry
    contact : contact angle t, any shape, rad
    """
    a = wraps.half_thickness_angle
    square = contact**2 + a**2 + np.pi**2 / 12.0 - 1.0 + 4.0 * a / np.pi
    return np.asarray(np.pi * wraps.base_radius_m**2 * square)
