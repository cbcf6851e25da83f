"""Plane four-bar mechanism of a scroll with mini-crank (Zhao et al. 2013): closing and motion."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from ...errors import ParameterError
from ...moving_parts import Array
from ...parameters.minicrank import FourBar

SMALLEST_MARGIN_M: Final = 1e-9
"""Below it a four-bar that is no parallelogram is at a change point to rounding: angular
accelerations grow without bound and so do their rounding errors."""


@dataclass(frozen=True)
class Links:
    """Link lengths with their errors.

    Attributes
    ----------
    crank_m : l1, eccentricity of the crankshaft, the driver
    scroll_m : l2, from crank pin to mini-crank pin
    minicrank_m : l3
    bracket_m : l4, from crankshaft to mini-crank axis
    """

    crank_m: float
    scroll_m: float
    minicrank_m: float
    bracket_m: float

    @property
    def is_parallelogram(self) -> bool:
        return self.crank_m == self.minicrank_m and self.scroll_m == self.bracket_m


def links_of(four_bar: FourBar) -> Links:
    """Nominal lengths and errors added up."""
    return Links(
        four_bar.crank_m + four_bar.crank_error_m,
        four_bar.scroll_m + four_bar.scroll_error_m,
        four_bar.minicrank_m + four_bar.minicrank_error_m,
        four_bar.bracket_m + four_bar.bracket_error_m,
    )


def closing_margins(links: Links) -> tuple[float, float]:
    """What the links have to spare in the two collinear positions of crank and bracket, m.

    Both must hold for the crank to turn: l1 + l2 ≤ l3 + l4 and l1 + l4 ≤ l3 + l2 (Zhao et al.
    2013, eq. 19 and 20; the paper's "or" is an error). A negative margin is the clearance that
    the joints must have.

    Returns
    -------
    inner, outer : l3 + l4 - l1 - l2 with the crank pin between the axes (θ1 = 0), and
        l3 + l2 - l1 - l4 with the crank pin beyond (θ1 = 180°)
    """
    l1, l2, l3, l4 = links.crank_m, links.scroll_m, links.minicrank_m, links.bracket_m
    return l3 + l4 - l1 - l2, l3 + l2 - l1 - l4


def reachable_crank_angles(links: Links) -> tuple[float, float]:
    """Smallest and largest |θ1| that rigid links reach; (0, π) where the crank turns, rad.

    |l2 - l3| ≤ s ≤ l2 + l3 with s² = l1² + l4² - 2 l1 l4 cos θ1. Where l3 is shorter than l1 the
    crank only rocks.

    Raises
    ------
    ParameterError
        The links close at no crank angle.
    """
    l1, l2, l3, l4 = links.crank_m, links.scroll_m, links.minicrank_m, links.bracket_m
    ends = [(l1**2 + l4**2 - span**2) / (2.0 * l1 * l4) for span in (abs(l2 - l3), l2 + l3)]
    if ends[0] < -1.0 or ends[1] > 1.0:
        raise ParameterError(f"{_lengths(links)}: the links close at no crank angle")
    # The margins decide: at just one the quotient's rounding would cost a fraction of a degree.
    inner, outer = closing_margins(links)
    turns_inside = min(inner, _slack(links)) >= 0.0
    first = 0.0 if turns_inside else float(np.arccos(min(ends[0], 1.0)))
    last = np.pi if outer >= 0.0 else float(np.arccos(max(ends[1], -1.0)))
    return first, last


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
    _refuse_open(links)
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


def _slack(links: Links) -> float:
    """Third condition, l1 + l3 ≤ l2 + l4, which any scroll with small cranks meets."""
    return links.scroll_m + links.bracket_m - links.crank_m - links.minicrank_m


def _refuse_open(links: Links) -> None:
    margin = min(*closing_margins(links), _slack(links))
    if margin >= SMALLEST_MARGIN_M:
        return
    short = margin <= -SMALLEST_MARGIN_M
    found = f"{-1e6 * margin:.4g} µm are missing" if short else "they only just reach"
    raise ParameterError(
        f"{_lengths(links)}: the links do not close over a revolution of the crankshaft; {found}"
    )


def _lengths(links: Links) -> str:
    return (
        f"crank_mm, scroll_mm, minicrank_mm, bracket_mm = {1e3 * links.crank_m:.7g}, "
        f"{1e3 * links.scroll_m:.7g}, {1e3 * links.minicrank_m:.7g}, "
        f"{1e3 * links.bracket_m:.7g} mm"
    )
