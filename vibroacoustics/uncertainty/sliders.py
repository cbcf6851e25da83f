"""Choice of sliders: parameters that move the level of the weighted samples smoothly."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import Final

import numpy as np
import xarray as xr
from scipy.stats import rankdata

from ..base.arrays import Array
from ..base.vocabulary import REFERENCE_OPTION
from ..levels.changes import change_at, total_change
from ..levels.labelled import level
from ..results.estimates import sample_weights, weighted_estimate
from ..study.sampling import Sample, sample_at
from ..study.uncertainty import Range
from .evidence import PAIRS, systematic

LEAST_DB: Final = 0.5
"""Least change of the level over the range of a slider."""
MOST_ERROR_DB: Final = 1.0
"""Largest error between the nodes of a slider."""
MOST_CANDIDATES: Final = 10
"""Parameters whose ends of the range are computed."""
MOST_SLIDERS: Final = 5
"""Sliders of parameters."""
NODES: Final = 7
"""Values over the range of a slider."""
MACHINES: Final = 8
"""Weighted samples that the sliders change, at most."""
TRIED: Final = 2
"""Samples among them with which candidates are tried."""
_SHARES: Final[Array] = np.arange(2 * NODES - 1) / (2.0 * NODES - 2.0)
"""Parts of the range below the nodes, and below the values halfway between them."""
_QUIETEST: Final = 1e-9
"""Part of the energy of all bands that a band has at least: its changes stay finite."""

Setting = tuple[int, Sample]
"""Number of a weighted sample, and values in place of its own."""
Compute = Callable[[Sequence[Setting]], list[Array | None]]
"""Mean squares in third octaves with these values, shape (option, receiver, band), Pa²; none
without a solution."""


@dataclass(frozen=True)
class Slider:
    """A parameter and the changes of the level where all samples have one value of it.

    Attributes
    ----------
    limits : range
    nodes : increasing, shape (node,)
    change_db : against the sample's own value, in third octaves without an option, shape (node,
        machine, receiver, band)
    error_db : largest error of the interpolated change of the level halfway between the nodes
    """

    limits: Range
    nodes: Array
    change_db: Array
    error_db: float

    def sample(self, value: float) -> Sample:
        """Return one value of the parameter as part of a sample."""
        return {(self.limits.table, self.limits.field): value}


def machine_count(random_samples: int) -> int:
    """Number of weighted samples that sliders change: one of four that a study wants."""
    return int(np.clip(random_samples // 4, TRIED, MACHINES))


def starts(sliders: Sequence[Slider], results: xr.Dataset) -> dict[str, float]:
    """Return the weighted median of each slider's parameter by its name."""
    weight, values = sample_weights(results), results["sampled_value"]
    names = [slider.limits.name for slider in sliders]
    columns = [values.sel(uncertain_parameter=name).values for name in names]
    medians = [weighted_estimate(column, weight).value for column in columns]
    return dict(zip(names, medians, strict=True))


def spread_pairs(results: xr.Dataset, random_samples: int) -> list[tuple[int, int]]:
    """Weighted samples, one for each equal part of the weight by the modelled level.

    Each has its row among those that were computed, and the number of its pair.
    """
    weight, count = sample_weights(results), machine_count(random_samples)
    level_db = results["level_modelled_by_sample"].sel(option=REFERENCE_OPTION)
    others = [dim for dim in level_db.dims if dim != "sample"]
    order = np.argsort(level_db.mean(others).values)
    picks = order[systematic(weight[order], count, 0.5)]
    picks = np.roll(picks, TRIED + 1)  # candidates are tried with loud ones, not the loudest
    return [divmod(row, PAIRS) for row in picks.tolist()]


def candidates(
    ranges: Sequence[Range], modelled_db: Array, samples: Sequence[Sample]
) -> list[Range]:
    """Return the continuous parameters that go with the level, by their rank correlation.

    Spearman 1904, American Journal of Psychology 15, 72.

    Parameters
    ----------
    ranges : ranges of all uncertain parameters
    modelled_db : level of the samples, shape (sample,), dB; not a number without a solution
    samples : samples of the prior ensemble
    """
    values = np.array(
        [[sample[limits.table, limits.field] for limits in ranges] for sample in samples]
    )
    table = np.column_stack([modelled_db, values])[np.isfinite(modelled_db)]
    ranks = rankdata(table, axis=0)
    centred = ranks - ranks.mean(axis=0)
    product = np.abs(centred[:, 0] @ centred[:, 1:])
    spread = np.linalg.norm(centred[:, 1:], axis=0)
    correlation = np.divide(product, spread, out=np.zeros_like(product), where=spread > 0.0)
    order = np.argsort(-correlation, kind="stable").tolist()
    continuous = [ranges[number] for number in order if not ranges[number].integer]
    return continuous[:MOST_CANDIDATES]


def chosen_sliders(
    ranges: Sequence[Range], machines: int, receiver: int, compute: Compute
) -> list[Slider]:
    """Return the parameters that move the level and whose changes can be interpolated.

    Parameters
    ----------
    ranges : ranges of the candidates, in the order of their importance
    machines : number of the weighted samples
    receiver : number of the microphone at which sliders are chosen
    compute : gives the third octaves without an option, shape (1, receiver, band)
    """
    unchanged = compute([(number, {}) for number in range(machines)])
    if any(square is None for square in unchanged):
        return []
    before = np.array([square[0] for square in unchanged if square is not None])
    tried = list(range(min(TRIED, machines)))
    swing = {}
    for limits in ranges:
        ends = _swept(limits, _SHARES[[0, -1]], tried, compute)
        if ends is not None:
            level_db = level(np.append(ends, before[None, tried], axis=0)[:, :, receiver].sum(-1))
            swing[limits.name] = float(np.ptp(level_db, axis=0).max())
    wide = [limits for limits in ranges if swing.get(limits.name, 0.0) >= LEAST_DB]
    wide.sort(key=lambda limits: -swing[limits.name])
    sliders = (_slider(limits, before, receiver, compute) for limits in wide)
    return list(islice(filter(None, sliders), MOST_SLIDERS))


def band_levels(squares: Array) -> Array:
    """Return levels of third octaves, finite where a band is silent, shape (..., band), dB."""
    least = _QUIETEST * squares.sum(axis=-1, keepdims=True)
    return np.asarray(level(np.maximum(squares, least)))


def values_at(limits: Range, shares: Array) -> Array:
    """Return the values of a parameter that so large shares of its range lie below."""
    key = limits.table, limits.field
    return np.array([sample_at([limits], np.array([share]))[key] for share in shares])


def _swept(limits: Range, shares: Array, machines: Sequence[int], compute: Compute) -> Array | None:
    """Mean squares over the range of a parameter, shape (value, machine, receiver, band).

    None where a sample has no solution at one of the values.
    """
    values = [sample_at([limits], np.array([share])) for share in shares]
    squares = compute([(number, value) for value in values for number in machines])
    solved = [square[0] for square in squares if square is not None]
    if len(solved) < len(squares):
        return None
    return np.array(solved).reshape(len(values), len(machines), *solved[0].shape)


def _slider(limits: Range, before: Array, receiver: int, compute: Compute) -> Slider | None:
    """Return the slider of a parameter; None where it errs between its nodes, or is not solved.

    A few samples show how far interpolated changes err; the others follow where they do not.
    """
    tried, others = np.split(np.arange(len(before)), [TRIED])
    bands, values = band_levels(before), values_at(limits, _SHARES)
    few = _swept(limits, _SHARES, tried.tolist(), compute)
    if few is None:
        return None
    nodes, change = values[::2], band_levels(few) - bands[tried]
    halfway = [change_at(value, nodes, change[::2]) for value in values[1::2].tolist()]
    error = total_change(bands[tried], np.array(halfway)) - total_change(bands[tried], change[1::2])
    largest_db = float(np.abs(error[..., receiver]).max())
    if largest_db > MOST_ERROR_DB:
        return None
    if not others.size:
        return Slider(limits, nodes, change[::2], largest_db)
    more = _swept(limits, _SHARES[::2], others.tolist(), compute)
    if more is None:
        return None
    every = np.append(change[::2], band_levels(more) - bands[others], axis=1)
    return Slider(limits, nodes, every, largest_db)
