"""Which unknowns the level and the changes hang on, labelled."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.vocabulary import REFERENCE_OPTION, stamped
from ..levels.agreement import ALL_ALIKE
from ..study.sampling import position_in_range
from ..study.study import Study
from ..study.uncertainty import Range
from .bank import Bank
from .shares import Shares, shares_of

BEFORE: Final = "before"
"""Knowledge of the ranges alone."""
REMAINDER: Final = "remainder.level_db"
"""Level of what is not modelled, an unknown beside the drawn values."""


def level_shares(ranges: Sequence[Range], bank: Bank, before: Array) -> xr.Dataset:
    """Shares of the drawn values in the modelled level, before and by prior of the remainder.

    Parameters
    ----------
    ranges : of the drawn values
    bank : all draws; where they do not suffice the priors' shares are empty
    before : weights of the draws before the published level, shape (draw,)
    """
    values = [[draw[limits.table, limits.field] for limits in ranges] for draw in bank.draws]
    unit = _positions(ranges, np.array(values))
    weighed = list(bank.prior_names) != [ALL_ALIKE.name]  # else after is as before
    after = bank.weight if bank.suffices else 0.0 * bank.weight
    weights = [before, *(after if weighed else ())]
    shares = [shares_of(unit, bank.modelled_db, weight) for weight in weights]
    names = {"drawn_parameter": [limits.name for limits in ranges]}
    coords = {"knowledge": [BEFORE, *(bank.prior_names if weighed else ())]}
    return _labelled("level_share", shares, coords, names)


def change_shares(study: Study, levels: xr.Dataset) -> xr.Dataset:
    """Shares of the unknowns in what each option changes of the total, over the weighed draws.

    At the microphone of the published level and the speed that is nearest to its own, with the
    first prior of the remainder. The share is what knowing the unknown is expected to take off
    the variance.

    Parameters
    ----------
    study : ranges and published level
    levels : of `draw_variables` and `drawn_values`
    """
    published = study.catalogue_speed_rpm
    nearest = int(np.abs(levels["speed"].values - published).argmin())
    there = levels.sel(receiver=study.catalogue_receiver).isel(speed=nearest)
    total = there["level_total_by_draw"].transpose("option", "draw")
    change = (total - total.sel(option=REFERENCE_OPTION)).values
    weight = levels["draw_weight"].values[0]
    rest = levels["level_remainder_by_draw"].values
    unit = np.column_stack([_positions(study.ranges, levels["drawn_value"].values), _evenly(rest)])
    shares = [shares_of(unit, one, weight) for one in change]
    names = {"unknown": [*levels["drawn_parameter"].values.tolist(), REMAINDER]}
    coords = {"option": total["option"].values.tolist()}
    variance = [one.variance for one in shares]
    of_options = stamped({"change_variance": variance}, coords)
    return _labelled("change_share", shares, coords, names).merge(of_options)


def _labelled(
    name: str, shares: Sequence[Shares], coords: dict[str, list[str]], names: dict[str, list[str]]
) -> xr.Dataset:
    share, quality = [one.share for one in shares], [one.quality for one in shares]
    return stamped({name: share, f"{name}_quality": quality}, {**coords, **names})


def _positions(ranges: Sequence[Range], values: Array) -> Array:
    """Drawn values in their ranges, from -1 to 1, shape (draw, value)."""
    rows = values.reshape(-1, len(ranges)).T
    positions = [position_in_range(limits, row) for limits, row in zip(ranges, rows, strict=True)]
    return np.transpose(positions)


def _evenly(values: Array) -> Array:
    """Values from -1 to 1 between their least and their largest."""
    span = np.ptp(values)
    return 2.0 * (values - values.min()) / span - 1.0 if span > 0.0 else 0.0 * values
