"""Plane four-bar mechanism of a scroll with mini-crank (Zhao et al. 2013): closing and motion."""

from dataclasses import dataclass

import numpy as np

from ...base.arrays import Array
from ...base.errors import ParameterError
from .links import Links, why_open


@dataclass(frozen=True)
class FourBarMotion:
    """Angles over crank angle, each with first and second derivative, shape (3, samples).

    Attributes
    ----------
    crank_angle : θ1 from the bracket's line, shape (samples,), rad
    scroll_angle : θ2, continuous over crank angle
    minicrank_angle : θ3, continuous over crank angle
    """

    crank_angle: Array
    scroll_angle: Array
    minicrank_angle: Array


def four_bar_motion(links: Links, crank_angle: Array, branch: int) -> FourBarMotion:
    """Scroll and mini-crank angles of one branch (Zhao et al. 2013, eq. 5 and 6; ideal: 7).

    With errors a branch is never left: the mini-crank runs along with the crankshaft on one half
    of the revolution and back on the other. Only a true parallelogram, in which both branches
    meet, turns through; it follows (7).

    Parameters
    ----------
    links : lengths, m
    crank_angle : shape (samples,), rad
    branch : M of (5), 1 or -1; with -1 the mini-crank runs along for θ1 from 0 to 180°, and the
        hinges of crank, scroll and bracket stand clockwise (the paper's text has it inverted)

    Raises
    ------
    ParameterError
        The links do not close at every crank angle, or only just.
    """
    if links.is_parallelogram:
        turning, still = np.zeros((2, 3, crank_angle.size))
        turning[0], turning[1] = crank_angle, 1.0
        return FourBarMotion(crank_angle, still, turning)
    if reason := why_open(links):
        raise ParameterError(reason)
    l1, l2, l3, l4 = links.crank_m, links.scroll_m, links.minicrank_m, links.bracket_m
    A, B = l4 - l1 * np.cos(crank_angle), -l1 * np.sin(crank_angle)
    span = np.hypot(A, B)
    # √(A² + B² - C²) and that with D, as products: their differences cancel near collinearity.
    area = np.sqrt((l2 + l3 - span) * (l2 + l3 + span) * (l3 + span - l2) * (l2 + span - l3))
    C = (l2**2 - l3**2 + span**2) / (2.0 * l2)
    D = (l2**2 - l3**2 - span**2) / (2.0 * l3)
    second = np.unwrap(2.0 * np.arctan2(B - branch * area / (2.0 * l2), A + C))
    third = np.unwrap(2.0 * np.arctan2(B - branch * area / (2.0 * l3), A + D))
    sine = np.sin(third - second)
    second_1 = l1 * np.sin(crank_angle - third) / (l2 * sine)
    third_1 = l1 * np.sin(crank_angle - second) / (l3 * sine)
    second_2 = l1 * np.cos(crank_angle - third) + second_1**2 * l2 * np.cos(second - third)
    third_2 = l1 * np.cos(crank_angle - second) + second_1**2 * l2
    return FourBarMotion(
        crank_angle,
        np.stack([second, second_1, (second_2 - third_1**2 * l3) / (l2 * sine)]),
        np.stack(
            [third, third_1, (third_2 - third_1**2 * l3 * np.cos(third - second)) / (l3 * sine)]
        ),
    )


def three_minicranks_motion(links: Links, crank_angle: Array) -> FourBarMotion:
    """Scroll on three mini-cranks at 120° with equal elastic pins, the first with the errors.

    Each turns freely about its axis, so its pin holds the scroll along the crank's direction only.
    There pin k is strained by g_k - l2 θ2 sin(θ1 - β_k) with g_1 = (l4 - l2) cos θ1 + l3 - l1
    and no g of the others. The least Σ strain² gives θ2 = (2/(3 l2)) g_1 sin θ1 (positive with
    the crank), as Σ sin²(θ1 - β_k) = 3/2 at every crank angle: no change point is left. With one
    mini-crank it would be g_1/(l2 sin θ1), which the links in line do not bound. Our derivation,
    to first order in the errors; the mini-cranks then turn with the crank.

    Parameters
    ----------
    links : lengths of the crankshaft and the first mini-crank's loop, m
    crank_angle : shape (samples,), rad
    """
    in_line = (links.bracket_m - links.scroll_m) / (3.0 * links.scroll_m)
    longer = 2.0 * (links.minicrank_m - links.crank_m) / (3.0 * links.scroll_m)
    once, twice = np.sin(crank_angle), np.sin(2.0 * crank_angle)
    slope = longer * np.cos(crank_angle) + 2.0 * in_line * np.cos(2.0 * crank_angle)
    turn = np.stack(
        [longer * once + in_line * twice, slope, -longer * once - 4.0 * in_line * twice]
    )
    even = np.zeros((3, crank_angle.size))
    even[0], even[1] = crank_angle, 1.0
    return FourBarMotion(crank_angle, turn, even)
