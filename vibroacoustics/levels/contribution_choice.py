"""Speeds and orders at which sound by path is kept."""

from typing import Final

import numpy as np
import xarray as xr

from ..base.vocabulary import REFERENCE_OPTION, WEIGHTINGS
from ..study.study import Study

MOST_SPEEDS: Final = 3
"""The slowest, the fastest, and that of the published level or a middle one."""
MOST_ORDERS: Final = 12
"""The loudest ones without an option after weighting by A, at any speed and receiver."""
QUIETEST_DB: Final = -40.0
"""Orders below this everywhere are none of them."""
ALWAYS: Final = (1, 2)
"""Orders that are among them."""


def chosen_speeds(study: Study) -> list[float]:
    """Choose all speeds of a study, or three of them."""
    speeds = list(study.operation.speed_rpm)
    if len(speeds) <= MOST_SPEEDS:
        return speeds
    published = study.catalogue_speed_rpm
    middle = published if published in speeds else float(np.mean(speeds))
    wanted = {min(speeds), min(speeds, key=lambda speed: abs(speed - middle)), max(speeds)}
    return [speed for speed in speeds if speed in wanted]


def loudest_orders(levels: xr.Dataset) -> list[int]:
    """Choose the orders of sound by path: 1, 2 and the loudest ones."""
    level = levels["order_level"].isel(weighting=WEIGHTINGS.index("A")).sel(option=REFERENCE_OPTION)
    loudest = level.max(("speed", "receiver")).values
    ranked = [int(order) for order in np.argsort(-loudest, kind="stable") if order > 0]
    others = [order for order in ranked if order not in ALWAYS and loudest[order] >= QUIETEST_DB]
    return sorted([*ALWAYS, *others[: MOST_ORDERS - len(ALWAYS)]])
