"""Draws weighed by the published level: as many as are needed, and those that go on."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array, IndexArray
from ..base.vocabulary import stamped
from ..levels.agreement import PRIOR_NAMES, Prior, agreement_of_points, effective_draws
from ..study.sampling import Draw
from ..study.uncertainty import Range

MOST_DRAWS: Final = 4096
MOST_ROUNDS: Final = 41
"""Of as many draws as shall be effective: 100 reach the most draws."""
LEAST_SHARE: Final = 0.5
"""Of them that must be effective for bands and shares."""


@dataclass(frozen=True)
class Bank:
    """Draws computed at the point of the published level only, and how well they agree with it.

    Attributes
    ----------
    draws : all of them
    modelled_db : what is modelled over the published level, shape (draw,); not a number where a
        draw has no solution
    weight : by prior of the remainder, shape (prior, draw), from 0 to 1
    wanted : how many shall be effective
    prior_names : of the remainder
    """

    draws: list[Draw]
    modelled_db: Array
    weight: Array
    wanted: int
    prior_names: Sequence[str] = PRIOR_NAMES

    @property
    def effective(self) -> float:
        """Number of equal draws that would be as good, with the first prior."""
        return effective_draws(self.weight[0])

    @property
    def suffices(self) -> bool:
        """Whether bands and shares can be told from it."""
        return self.effective >= LEAST_SHARE * self.wanted

    def chosen(self, seed: int) -> tuple[IndexArray, Array]:
        """Draws that go on, and their weights (draw,) and (prior, draw), each summing up to one.

        As many as are wanted, by systematic resampling with the first prior: a draw of a large
        weight counts several times (Kitagawa 1996, Journal of Computational and Graphical
        Statistics 5, appendix).
        """
        share = np.cumsum(self.weight[0]) / self.weight[0].sum()
        start = np.random.default_rng(seed).uniform()
        picks = np.searchsorted(share, (np.arange(self.wanted) + start) / self.wanted)
        index, count = np.unique(np.minimum(picks, share.size - 1), return_counts=True)
        weight = count * self.weight[:, index] / self.weight[0, index]
        return index, weight / weight.sum(axis=1, keepdims=True)

    def some(self, index: IndexArray) -> list[Draw]:
        """Return the draws of some numbers."""
        return [self.draws[number] for number in index]

    def labelled(self, ranges: Sequence[Range], published_dba: float) -> xr.Dataset:
        """All draws, their weights, their level and their values."""
        values = {
            "bank_weight": self.weight,
            "bank_level": self.modelled_db + published_dba,
            "bank_value": [[draw[one.table, one.field] for one in ranges] for draw in self.draws],
        }
        coords = {
            "bank_draw": np.arange(1, len(self.draws) + 1),
            "drawn_parameter": [limits.name for limits in ranges],
            "prior": list(self.prior_names),
        }
        return stamped(values, coords)


def bank_of(
    batches: Iterable[list[Draw]],
    modelled_db: Callable[[list[Draw], int, int], Array],
    deviation_db: float,
    priors: Sequence[Prior],
    wanted: int,
    likelihood: Callable[[int, int], Array] | None = None,
) -> Bank:
    """Draws until as many as are wanted are effective, or `MOST_ROUNDS` batches or `MOST_DRAWS`
    draws are through.

    Parameters
    ----------
    batches : of draws
    modelled_db : of draws, how many were before them and how many are expected in all, to what is
        modelled over the published level, shape (draw,) or (1, draw), dB; further rows are over
        levels that were measured in its stead, which then weigh the draws
    deviation_db : standard deviation of the levels that weigh
    priors : of the remainder, that of the bands first
    wanted : how many shall be effective
    likelihood : of so many draws after so many, by what was measured besides, shape (draw,): a
        factor of their weights
    """
    names = [prior.name for prior in priors]
    bank = Bank([], np.zeros(0), np.zeros((len(priors), 0)), wanted, names)
    for hypercube in islice(batches, MOST_ROUNDS):
        before = len(bank.draws)
        batch = hypercube[: MOST_DRAWS - before]
        expected = before * wanted / max(bank.effective, 1.0) if before else 2.0 * wanted
        count = max(round(expected), before + len(batch) + 1)
        over = np.atleast_2d(modelled_db(batch, before, count))
        points = over[1:] if len(over) > 1 else over
        weights = np.array([agreement_of_points(points, deviation_db, prior) for prior in priors])
        if likelihood is not None:
            weights *= likelihood(before, len(batch))
        weight = np.concatenate([bank.weight, weights], axis=1)
        level = np.concatenate([bank.modelled_db, over[0]])
        bank = Bank(bank.draws + batch, level, weight, wanted, names)
        if bank.effective >= wanted or len(bank.draws) >= MOST_DRAWS:
            break
    return bank
