"""One number of a figure: over microphones, speeds and samples."""

import numpy as np

from ..base.arrays import Array
from ..base.decibel import level_of_power
from ..study.design import Statistic, Wanted
from .engine.seen import Seen
from .figure import DesignFigure, Setting


def over(values: Array, axis: int, statistic: Statistic, more_is_better: bool) -> Array:
    """Worst value, mean, or the value that a share of the values is as good as, along an axis.

    The quantile is that of sorted values without interpolation, the first that at least the share
    reaches: what it promises, that share keeps.

    Parameters
    ----------
    values : any shape
    axis : that is taken away
    statistic : worst, mean or a share
    more_is_better : whether the smallest value is the worst
    """
    if statistic == "mean":
        return np.asarray(values.mean(axis=axis))
    share = 1.0 if statistic == "worst" else float(statistic)
    better = -values if more_is_better else values
    count = values.shape[axis]
    rank = min(max(int(np.ceil(share * count - 1e-9)), 1), count) - 1
    if rank == count - 1:
        reached = better.max(axis=axis)
    else:
        reached = np.take(np.partition(better, rank, axis=axis), rank, axis=axis)
    return np.asarray(-reached if more_is_better else reached)


def of_each(figure: DesignFigure, seen: Seen, setting: Setting, more_is_better: bool) -> Array:
    """One number of each design, over microphones and speeds, shape (design,).

    A mean over microphones is one of energies; a change is taken of means, or at each microphone.
    A figure without speeds is what it is.
    """
    wanted: Wanted = setting.wanted
    values, reference = figure.values(seen, setting), figure.reference(setting)
    if figure.is_level:
        values = _level(values, wanted)
        reference = None if reference is None else _level(reference, wanted)
    if reference is not None:
        values = values - reference
    if values.ndim == 3:
        values = over(values, 2, wanted.receivers, more_is_better)
    if values.ndim == 2:
        values = over(values, 1, wanted.speeds, more_is_better)
    return values


def _level(power: Array, wanted: Wanted) -> Array:
    """Levels at each microphone, or of the mean of them."""
    mean = power.ndim == 3 and wanted.receivers == "mean"
    return level_of_power(power.mean(axis=2) if mean else power)
