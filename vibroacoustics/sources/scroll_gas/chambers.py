"""Volumes of an opened pair of pockets and of the chamber inside it, in closed form.

Inside a pair of contacts at the contact angle t there is q t²/2 + const, q = 2 r_b r_o h.
When a pair opens its inner contacts stand at t_i, its outer ones a turn further out, at t_o; after
half a turn pair and chamber are one, and that is the chamber at the next opening.
"""

import numpy as np

from ...base.arrays import Array
from .parameters import ScrollWraps


def swept_volume_m3(wraps: ScrollWraps) -> float:
    """q = 2 r_b r_o h: a pair of contacts at t sweeps q t a radian, m³."""
    return 2.0 * wraps.base_radius_m * wraps.orbit_radius_m * wraps.height_m


def contacts_at_opening(wraps: ScrollWraps) -> tuple[float, float]:
    """Contact angles of the outer and the inner end of a pocket that opens, rad."""
    outer = float(contact_angle(wraps, np.asarray(wraps.opening_angle_rad)))
    return outer, outer - 2.0 * np.pi


def pair_volume_m3(wraps: ScrollWraps, since_opening: Array) -> Array:
    """Volume of both pockets of an opened pair until they are one with the chamber, m³.

    Parameters
    ----------
    wraps : geometry
    since_opening : crank angle, 0 to π, shape (...), rad
    """
    outer, _ = contacts_at_opening(wraps)
    mean = outer - np.pi - since_opening
    return np.asarray(2.0 * np.pi * swept_volume_m3(wraps) * mean)


def chamber_volume_m3(wraps: ScrollWraps, at_opening_m3: float, since_opening: Array) -> Array:
    """The chamber inside all closed pockets, from half a turn on with the opened pair, m³.

    Parameters
    ----------
    wraps : geometry
    at_opening_m3 : its volume when a pair opens
    since_opening : crank angle, 0 to 2π, shape (...), rad
    """
    outer, inner = contacts_at_opening(wraps)
    ends_at = np.where(since_opening < np.pi, inner, outer) - since_opening
    return np.asarray(at_opening_m3 + 0.5 * swept_volume_m3(wraps) * (ends_at**2 - inner**2))


def least_chamber_volume_m3(wraps: ScrollWraps) -> float:
    """Return the least chamber volume when a pair opens, so that gas remains in it, m³.

    The chamber shrinks until its contacts reach t = 0, or until it is one with the pair.
    """
    _, inner = contacts_at_opening(wraps)
    inner_turn = max(inner - np.pi, 0.0)
    return 0.5 * swept_volume_m3(wraps) * (inner**2 - inner_turn**2)


def full_gap_area_m2(wraps: ScrollWraps) -> float:
    """2 h r_o: the gap of a pair is this times 1 - cos φ, φ the crank angle since its opening."""
    return 2.0 * wraps.height_m * wraps.orbit_radius_m


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
