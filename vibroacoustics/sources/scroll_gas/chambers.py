"""Volumes of an opened pair of pockets and of the chamber inside it, in closed form.

Inside a pair of contacts at the contact angle t there is q t²/2 + const, q = 2 r_b r_o h.
When a pair opens its inner contacts stand at t_i, its outer ones a turn further out, at t_o; after
half a turn pair and chamber are one, and that is the chamber at the next opening.
"""

import numpy as np

from ...base.arrays import Array
from .parameters import ScrollWraps
from .pockets import contact_angle


def swept_volume_m3(wraps: ScrollWraps) -> float:
    """q = 2 r_b r_o h: a pair of contacts at t sweeps q t a radian, m³."""
    return 2.0 * wraps.base_radius_m * wraps.orbit_radius_m * wraps.height_m


def contacts_at_opening(wraps: ScrollWraps) -> tuple[float, float]:
    """Contact angles of the outer and the inner end of a pocket that opens, rad."""
    outer = float(contact_angle(wraps, np.asarray(wraps.opening_angle_rad)))
    return outer, outer - 2.0 * np.pi


def pair_volume_m3(wraps: ScrollWraps, since_opening: Array) -> Array:
    """Both pockets of an opened pair until they are one with the chamber, m³.

    Parameters
    ----------
    wraps : geometry
    since_opening : crank angle, 0 to π, rad
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
    since_opening : crank angle, 0 to 2π, rad
    """
    outer, inner = contacts_at_opening(wraps)
    ends_at = np.where(since_opening < np.pi, inner, outer) - since_opening
    return np.asarray(at_opening_m3 + 0.5 * swept_volume_m3(wraps) * (ends_at**2 - inner**2))


def least_chamber_volume_m3(wraps: ScrollWraps) -> float:
    """What a chamber must exceed when a pair opens, so that gas is left in it throughout, m³.

    The chamber shrinks until its contacts reach t = 0, or until it is one with the pair.
    """
    _, inner = contacts_at_opening(wraps)
    left = max(inner - np.pi, 0.0)
    return 0.5 * swept_volume_m3(wraps) * (inner**2 - left**2)


def full_gap_area_m2(wraps: ScrollWraps) -> float:
    """2 h r_o: the gap of a pair is this times 1 - cos φ, φ the crank angle since its opening."""
    return 2.0 * wraps.height_m * wraps.orbit_radius_m
