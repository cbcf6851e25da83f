"""Pieces of designs that are computed together, and one number of a figure over them."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ..base.arrays import Array
from ..base.decibel import level_of_power
from ..base.quantiles import weighted_quantiles
from ..study.design import Statistic, Wanted
from .engine.needs import ResponsesByNeed
from .engine.option_engine import ON_PATH
from .engine.recognition import Route
from .figure import DesignFigure, Setting


@dataclass(frozen=True)
class Splitting:
    """Variables that decide which designs are computed together.

    Attributes
    ----------
    paths : numbers of the variables that change the path from the loads to the microphones
    loads : numbers of the other variables of which every value takes runs
    variables : number of variables of a design; a further column is the number of a run
    most : largest number of designs of a piece
    """

    paths: tuple[int, ...]
    loads: tuple[int, ...]
    variables: int
    most: int

    @classmethod
    def of(cls, routes: Sequence[Sequence[Route]], most: int) -> "Splitting":
        """Sort the variables of designs by their routes.

        Parameters
        ----------
        routes : routes of each variable, by option
        most : largest number of designs of a piece
        """
        numbers = range(len(routes))
        paths = [n for n in numbers if any(route.reason == ON_PATH for route in routes[n])]
        runs = [n for n in numbers if not all(route.linear for route in routes[n])]
        loads = tuple(n for n in runs if n not in paths)
        return cls(tuple(paths), loads, len(routes), most)

    @property
    def slow(self) -> list[int]:
        """Numbers of the variables that take runs, those of the path first."""
        return [*self.paths, *self.loads]

    def pieces(self, designs: Array) -> Iterator[Array]:
        """Split designs into pieces with one path, and with one load that no piece before has.

        A process that computes all pieces makes one run a piece at most. Every numbered run is a
        piece.

        Parameters
        ----------
        designs : shape (design, variable), SI; or (design, variable + 1) of numbered runs
        """
        loads = designs[:, [*self.loads, *range(self.variables, designs.shape[1])]]
        begins = np.zeros(len(designs), dtype=bool)
        if loads.size:
            begins[np.unique(loads, axis=0, return_index=True)[1]] = True
        begins[1:] |= (np.diff(designs[:, self.paths], axis=0) != 0.0).any(axis=1)
        for part in np.split(designs, np.flatnonzero(begins[1:]) + 1):
            yield from (part[first : first + self.most] for first in range(0, len(part), self.most))


def statistic_of(values: Array, axis: int, statistic: Statistic, more_is_better: bool) -> Array:
    """Return the worst value, the mean, or the quantile that a share reaches, along an axis.

    The quantile is that of sorted values without interpolation, the first that at least the share
    reaches: what it promises, that share keeps.

    Parameters
    ----------
    values : any shape
    axis : axis that is reduced
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


def weighted_statistic(
    values: Array, weight: Array, statistic: Statistic, more_is_better: bool
) -> Array:
    """Compute the worst value, the mean or a quantile of weighted samples, shape (design,).

    Parameters
    ----------
    values : shape (design, sample)
    weight : weights of the samples, shape (sample,)
    statistic : worst, mean or a share; 0.5 is the median
    more_is_better : whether the smallest value is the worst
    """
    if isinstance(statistic, str):
        if statistic == "mean":
            return np.asarray(values @ weight / weight.sum())
        return statistic_of(values[:, weight > 0.0], 1, statistic, more_is_better)
    share = 1.0 - statistic if more_is_better else statistic
    return np.asarray(weighted_quantiles(values.T, weight, (share,))[0])


def of_each(
    figure: DesignFigure,
    responses: ResponsesByNeed,
    setting: Setting,
    more_is_better: bool,
    reference: Array | None = None,
) -> Array:
    """One number of each design, over microphones and speeds, shape (design,).

    A mean over microphones is one of energies; a change is taken of means, or at each microphone.
    A figure without speeds is what it is.

    Parameters
    ----------
    figure : figure of the designs
    responses : responses of the designs, by need
    setting : settings of the figure
    more_is_better : whether the smallest value is the worst
    reference : reference of a change, from `by_speed` for the machine without an option
    """
    wanted: Wanted = setting.wanted
    values = by_speed(figure, responses, setting)
    if reference is not None:
        values = values - reference
    if values.ndim == 3:
        values = statistic_of(values, 2, wanted.receivers, more_is_better)
    if values.ndim == 2:
        values = statistic_of(values, 1, wanted.speeds, more_is_better)
    return values


def by_speed(figure: DesignFigure, responses: ResponsesByNeed, setting: Setting) -> Array:
    """Compute a figure by design, speed and, where it has them, microphone; levels in dB."""
    values = figure.values(responses, setting)
    return _level(values, setting.wanted) if figure.is_level else values


def _level(power: Array, wanted: Wanted) -> Array:
    """Levels at each microphone, or of the mean of them."""
    mean = power.ndim == 3 and wanted.receivers == "mean"
    return level_of_power(power.mean(axis=2) if mean else power)
