"""Crank angles that the rigid links of a mini-crank reach, a second way to whether they close."""

import numpy as np

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.mechanisms.minicrank.links import Links, closing_margins


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
        raise ParameterError(f"{links}: the links close at no crank angle")
    # The margins decide: at just one the quotient's rounding would cost a fraction of a degree.
    inner, outer = closing_margins(links)
    turns_inside = min(inner, links.slack_m) >= 0.0
    first = 0.0 if turns_inside else float(np.arccos(min(ends[0], 1.0)))
    last = np.pi if outer >= 0.0 else float(np.arccos(max(ends[1], -1.0)))
    return first, last
