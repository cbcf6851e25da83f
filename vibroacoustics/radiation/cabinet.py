"""A cabinet around the machine: its panels as blocks."""

from collections.abc import Iterator
from typing import Final

import numpy as np

from ..base.errors import ParameterError
from ..study.surroundings import Cabinet, Opening, PanelSide
from .arrays import Array
from .bodies import Body, block

_LEAST_GAP_M: Final = 0.01


def check_fits(machine: Body, cabinet: Cabinet, floor_z_m: float) -> None:
    """Refuse a machine that is not clear of the panels.

    Raises
    ------
    ParameterError
        It is not.
    """
    lower, upper = machine.bounds()
    room = np.array([cabinet.depth_m, cabinet.width_m, 2.0 * (floor_z_m + cabinet.height_m)]) / 2.0
    gap = float(min(np.min(room - upper), np.min(room[:2] + lower[:2])))
    if gap < _LEAST_GAP_M:
        raise ParameterError(
            f"radiation.surroundings.cabinet: the machine is {1e3 * gap:.4g} mm off the panels; "
            f"needed at least {1e3 * _LEAST_GAP_M:g} mm"
        )


def cabinet_panels(cabinet: Cabinet, floor_z_m: float) -> Iterator[Body]:
    """The panels of a cabinet as blocks that overlap at its edges.

    A panel with an opening is four blocks around it.
    """
    half = np.array([cabinet.depth_m / 2.0, cabinet.width_m / 2.0])
    inner_lower = np.array([*-half, floor_z_m])
    inner_upper = np.array([*half, floor_z_m + cabinet.height_m])
    thickness = cabinet.panel_thickness_m
    outer_lower, outer_upper = inner_lower - thickness, inner_upper + thickness
    outer_lower[2] = floor_z_m
    for side, (axis, upward) in _SIDES.items():
        if side in cabinet.open_sides:
            continue
        lower, upper = outer_lower.copy(), outer_upper.copy()
        if upward:
            lower[axis] = inner_upper[axis]
        else:
            upper[axis] = inner_lower[axis]
        opening = cabinet.openings.get(side)
        if opening is None:
            yield block(lower, upper)
        else:
            yield from _around_opening(lower, upper, axis, opening, floor_z_m)


_SIDES: Final[dict[PanelSide, tuple[int, bool]]] = {
    "-x": (0, False),
    "+x": (0, True),
    "-y": (1, False),
    "+y": (1, True),
    "top": (2, True),
}


def _around_opening(
    lower: Array, upper: Array, axis: int, opening: Opening, floor_z_m: float
) -> Iterator[Body]:
    """Yield the rest of a panel around a rectangular hole: four blocks, fewer if it reaches an
    edge."""
    along, up = [other for other in range(3) if other != axis]
    middle_up = opening.up_m + (floor_z_m if up == 2 else 0.0)
    hole_lower, hole_upper = lower.copy(), upper.copy()
    for across, middle, size in (
        (along, opening.along_m, opening.width_m),
        (up, middle_up, opening.height_m),
    ):
        hole_lower[across] = np.clip(middle - size / 2.0, lower[across], upper[across])
        hole_upper[across] = np.clip(middle + size / 2.0, lower[across], upper[across])
    strip_lower, strip_upper = lower.copy(), upper.copy()
    for across in (along, up):
        before, after = strip_upper.copy(), strip_lower.copy()
        before[across], after[across] = hole_lower[across], hole_upper[across]
        for block_lower, block_upper in ((strip_lower, before), (after, strip_upper)):
            if np.all(block_upper - block_lower > 1e-9):
                yield block(block_lower, block_upper)
        # What is left between both strips, with the hole in it.
        strip_lower, strip_upper = strip_lower.copy(), strip_upper.copy()
        strip_lower[across], strip_upper[across] = hole_lower[across], hole_upper[across]
