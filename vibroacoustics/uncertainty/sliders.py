"""Choice of sliders: parameters that move the level of the representative sample smoothly."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np
from scipy.stats import rankdata

from ..base.arrays import Array
from ..levels.changes import change_at, total_change
from ..levels.labelled import level
from ..study.sampling import Sample, sample_at
from ..study.uncertainty import Range

LEAST_DB: Final = 0.5
"""Least change of the level over the range of a slider, and largest error between its nodes."""
MOST_CANDIDATES: Final = 20
"""Parameters whose ends of the range are computed."""
MOST_SLIDERS: Final = 6
"""Sliders of parameters."""
NODES: Final = 7
"""Values over the range of a slider, beside that of the representative sample."""
_SHARES: Final[Array] = np.arange(2 * NODES - 1) / (2.0 * NODES - 2.0)
"""Parts of the range below the nodes, and below the values halfway between them."""
_QUIETEST: Final = 1e-9
"""Part of the energy of all bands that a band has at least: its changes stay finite."""

Compute = Callable[[Sequence[Sample]], list[Array | None]]
"""Mean squares in third octaves with other values of some parameters, Pa²; none without a
solution."""


@dataclass(frozen=True)
class Slider:
    """A parameter and the changes of the level over its range.

    Attributes
    ----------
    limits : range
    nodes : increasing, the value of the representative sample among them, shape (node,)
    change_db : in third octaves at the nodes, shape (node, receiver, band)
    error_db : largest error of the interpolated change of the level halfway between the nodes
    """

    limits: Range
    nodes: Array
    change_db: Array
    error_db: float

    def sample(self, value: float) -> Sample:
        """Return one value of the parameter as part of a sample."""
        return {(self.limits.table, self.limits.field): value}


class _Sweep(NamedTuple):
    """Mean squares over the range of a parameter, shape (value, receiver, band)."""

    limits: Range
    squares: Array


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
    ranges: Sequence[Range], nominal: Sample, receiver: int, compute: Compute
) -> list[Slider]:
    """Return the parameters that move the level and whose changes can be interpolated.

    Parameters
    ----------
    ranges : ranges of the candidates, in the order of their importance
    nominal : values of the representative sample
    receiver : number of the microphone at which sliders are chosen
    compute : gives the third octaves without an option, shape (1, receiver, band)
    """
    (before,) = compute([{}])
    if before is None:
        return []
    (before,) = before
    ends = _sweeps(ranges, _SHARES[[0, -1]], compute)
    wide = [sweep for sweep in ends if _swing(sweep, before, receiver) >= LEAST_DB]
    inner = {
        sweep.limits.name: sweep.squares
        for sweep in _sweeps([sweep.limits for sweep in wide], _SHARES[1:-1], compute)
    }
    sweeps = [
        _Sweep(sweep.limits, np.insert(sweep.squares, 1, inner[sweep.limits.name], axis=0))
        for sweep in wide
        if sweep.limits.name in inner
    ]
    sliders = [_slider(sweep, nominal, before, receiver) for sweep in sweeps]
    return [slider for slider in sliders if slider.error_db <= LEAST_DB][:MOST_SLIDERS]


def band_levels(squares: Array) -> Array:
    """Return levels of third octaves, finite where a band is silent, shape (..., band), dB."""
    least = _QUIETEST * squares.sum(axis=-1, keepdims=True)
    return np.asarray(level(np.maximum(squares, least)))


def _sweeps(ranges: Sequence[Range], shares: Array, compute: Compute) -> list[_Sweep]:
    """Compute all values of the parameters; not of those without a solution at one."""
    squares = compute([sample_at([limits], np.array([n])) for limits in ranges for n in shares])
    sweeps = []
    for number, limits in enumerate(ranges):
        part = squares[number * shares.size : (number + 1) * shares.size]
        solved = [square for square in part if square is not None]
        if len(solved) == len(part):
            sweeps.append(_Sweep(limits, np.concatenate(solved)))
    return sweeps


def _swing(sweep: _Sweep, before: Array, receiver: int) -> float:
    """Range of the level, dB."""
    squares = np.concatenate([before[None], sweep.squares])[:, receiver]
    return float(np.ptp(level(squares.sum(axis=-1))))


def _slider(sweep: _Sweep, nominal: Sample, before: Array, receiver: int) -> Slider:
    """Compare interpolated changes with those computed halfway between the nodes."""
    limits, bands = sweep.limits, band_levels(before)
    key = limits.table, limits.field
    values = np.array([sample_at([limits], np.array([share]))[key] for share in _SHARES])
    change = band_levels(sweep.squares) - bands
    row = int(np.searchsorted(values[::2], nominal[key]))
    nodes = np.insert(values[::2], row, nominal[key])
    at_nodes = np.insert(change[::2], row, 0.0, axis=0)
    between = np.array([change_at(value, nodes, at_nodes) for value in values[1::2].tolist()])
    error = total_change(bands, between) - total_change(bands, change[1::2])
    return Slider(limits, nodes, at_nodes, float(np.abs(error[:, receiver]).max()))
