"""Levels over the speed with their bands: by option, by source, of recordings."""

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np
import xarray as xr

from ...base.arrays import Array
from ...base.vocabulary import REFERENCE_OPTION
from ..estimates import interval, is_sampled
from ..stored_study import a_weighted, catalogue_receiver, options, source_name
from ..titles import chosen

MOST_CURVES: Final = 8
STEADY_RATIO: Final = 0.02
"""A speed that stays within this share of its mean is no run-up."""


class LevelCurve(NamedTuple):
    """A level over the speed.

    Attributes
    ----------
    label : label of the channel or source
    speed_rpm : rising, shape (point,)
    level_db : shape (point,)
    band_db : ends of the interval, shape (2, point); none without samples
    """

    label: str
    speed_rpm: Array
    level_db: Array
    band_db: Array | None = None


def option_curves(
    results: xr.Dataset, name: str, receiver: str | None = None, of: Sequence[str] = ()
) -> list[LevelCurve]:
    """Curves of options, by default the first eight, A-weighted; the first with its interval."""
    where = {"receiver": chosen(results, "receiver", receiver or catalogue_receiver(results))}
    names = [chosen(results, "option", option) for option in of] or options(results)[:MOST_CURVES]
    levels = a_weighted(interval(results, name).sel(where))
    sampled = is_sampled(results, name)
    return [
        _curve(levels, sampled and option == names[0], option, option=option) for option in names
    ]


def source_curves(
    results: xr.Dataset, receiver: str | None = None, option: str = REFERENCE_OPTION
) -> list[LevelCurve]:
    """Curves of each source alone, A-weighted, with its interval."""
    where = {
        "receiver": chosen(results, "receiver", receiver or catalogue_receiver(results)),
        "option": chosen(results, "option", option),
    }
    levels = interval(results, "source_level").sel(where)
    sampled = is_sampled(results, "source_level")
    return [
        _curve(levels, sampled, source_name(results, source), sound_source=source)
        for source in map(str, levels["sound_source"].values)
    ]


def recorded_curves(mapped: xr.Dataset, channel: str | None = None) -> list[LevelCurve]:
    """Return levels of a channel of sound pressure by weighting, block by block."""
    of_pressure = mapped.sel(channel=mapped["channel_unit"] == "Pa")
    blocks = of_pressure["block_level"].sel(channel=chosen(of_pressure, "channel", channel))
    blocks = blocks.sortby("block_speed")
    return [
        LevelCurve(
            "unweighted" if weighting == "Z" else f"{weighting}-weighted",
            blocks["block_speed"].values,
            blocks.sel(weighting=weighting).values,
        )
        for weighting in map(str, blocks["weighting"].values)
    ]


def is_run_up(speed_rpm: xr.DataArray) -> bool:
    """Whether the speed of a recording's blocks goes up or down."""
    return bool(np.ptp(speed_rpm.values) > STEADY_RATIO * float(speed_rpm.mean()))


def _curve(levels: xr.Dataset, sampled: bool, label: str, **where: str) -> LevelCurve:
    level = levels.sel(where).sortby("speed")
    band = np.array([level["low"].values, level["high"].values]) if sampled else None
    return LevelCurve(label, level["speed"].values, level["value"].values, band)
