"""Sound by path, with the values as given, at few speeds and orders."""

from typing import Final

import numpy as np
import xarray as xr

from ..base.progress import Progress
from ..base.vocabulary import WEIGHTINGS
from ..levels.axes import LevelAxes
from ..levels.contributions import contribution_variables
from ..study.study import Study
from ..transfer.received import Transmission
from .motion import Motion

MOST_SPEEDS: Final = 3
"""The slowest, the fastest, and that of the published level or a middle one."""
MOST_ORDERS: Final = 12
"""The loudest ones after weighting by A, anywhere."""
QUIETEST_DB: Final = -40.0
"""Orders below this everywhere are none of them."""
ALWAYS: Final = (1, 2)
"""Orders that are among them."""


def contributions_of(
    transmission: Transmission,
    motion: Motion,
    axes: LevelAxes,
    levels: xr.Dataset,
    progress: Progress,
) -> xr.Dataset:
    """What comes by which path; no draws, as the values as given tell the paths.

    Parameters
    ----------
    transmission : from loads to sound
    motion : cases and loads
    axes : of the levels
    levels : with `order_level`
    progress : called with the number of cases that are done
    """
    speeds = chosen_speeds(transmission.study)
    cases = {key: case for key, case in motion.cases.items() if key[0] in speeds}
    split = {}
    progress("sound by path", 0, len(cases))
    for key, of_case in transmission.contributions(cases, motion.loads):
        split[key] = of_case
        progress("sound by path", len(split), len(cases))
    return contribution_variables(axes, split, loudest_orders(levels))


def chosen_speeds(study: Study) -> list[float]:
    """All speeds, or three of them."""
    speeds = list(study.operation.speed_rpm)
    if len(speeds) <= MOST_SPEEDS:
        return speeds
    published = study.catalogue_speed_rpm
    middle = published if published in speeds else float(np.mean(speeds))
    wanted = {min(speeds), min(speeds, key=lambda speed: abs(speed - middle)), max(speeds)}
    return [speed for speed in speeds if speed in wanted]


def loudest_orders(levels: xr.Dataset) -> list[int]:
    """Orders at which paths are told apart."""
    level = levels["order_level"].isel(weighting=WEIGHTINGS.index("A"))
    loudest = level.max(("speed", "option", "receiver")).values
    ranked = [int(order) for order in np.argsort(-loudest, kind="stable") if order > 0]
    others = [one for one in ranked if one not in ALWAYS and loudest[one] >= QUIETEST_DB]
    return sorted([*ALWAYS, *others[: MOST_ORDERS - len(ALWAYS)]])
