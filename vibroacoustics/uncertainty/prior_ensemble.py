"""Samples weighted by published data: as many as are needed, and those that go on."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import Final, NamedTuple

import numpy as np
import xarray as xr

from ..base.arrays import Array, IndexArray
from ..base.vocabulary import stamped
from ..levels.agreement import PRIOR_NAMES, effective_samples
from ..levels.nominal import Sound
from ..machine.machine import Machine
from ..study.sampling import Sample
from ..study.uncertainty import Range
from .evidence import systematic

MOST_SAMPLES: Final = 4096
MOST_ROUNDS: Final = 41
"""Number of batches, each of as many samples as shall be effective."""
LEAST_SHARE: Final = 0.5
"""Share of the wanted samples that must be effective for intervals and shares."""


class Weighted(NamedTuple):
    """A batch of samples.

    Attributes
    ----------
    sounds, machines : sound at the cases that weigh, and machine, of each sample
    modelled_db : modelled level relative to the published one, shape (sample,); not a number
        without a solution
    log_weight : by prior of the unmodelled noise, shape (prior, sample)
    """

    sounds: list[Sound]
    machines: list[Machine]
    modelled_db: Array
    log_weight: Array


@dataclass(frozen=True)
class PriorEnsemble:
    """Prior ensemble at the point of the published level, and its weights.

    Attributes
    ----------
    samples : all samples
    batch : their sounds, levels and weights
    wanted : number of samples that shall be effective
    prior_names : names of the priors of the unmodelled noise
    """

    samples: list[Sample]
    batch: Weighted
    wanted: int
    prior_names: Sequence[str] = PRIOR_NAMES

    @property
    def modelled_db(self) -> Array:
        """Modelled level relative to the published one, shape (sample,), dB."""
        return self.batch.modelled_db

    @property
    def weight(self) -> Array:
        """Weights by prior, the largest of each is 1, shape (prior, sample)."""
        largest = self.batch.log_weight.max(axis=1, keepdims=True, initial=-np.inf)
        weight = np.exp(self.batch.log_weight - np.where(np.isfinite(largest), largest, 0.0))
        return np.asarray(weight)

    @property
    def effective(self) -> float:
        """Number of equal samples of the same worth, with the first prior."""
        return effective_samples(self.weight[0])

    @property
    def suffices(self) -> bool:
        """Whether intervals and shares follow from it."""
        return self.effective >= LEAST_SHARE * self.wanted

    def chosen(self, seed: int) -> tuple[IndexArray, IndexArray]:
        """Samples that go on, and how many times each counts, shape (sample,).

        As many as are wanted, by systematic resampling with the first prior.
        """
        start = np.random.default_rng(seed).uniform()
        picks = systematic(self.weight[0], self.wanted, start)
        index, count = np.unique(picks, return_counts=True)
        return index, count

    def labelled(self, ranges: Sequence[Range], published_dba: float) -> xr.Dataset:
        """All samples, their weights, their levels and their values."""
        values = {
            "prior_sample_weight": self.weight,
            "prior_sample_level": self.modelled_db + published_dba,
            "prior_sample_value": [
                [sample[limits.table, limits.field] for limits in ranges] for sample in self.samples
            ],
        }
        coords = {
            "prior_sample": np.arange(1, len(self.samples) + 1),
            "uncertain_parameter": [limits.name for limits in ranges],
            "prior": list(self.prior_names),
        }
        return stamped(values, coords)


def prior_ensemble_of(
    batches: Iterable[list[Sample]],
    weigh: Callable[[list[Sample], int, int], Weighted],
    prior_names: Sequence[str],
    wanted: int,
) -> PriorEnsemble:
    """Return samples until as many as are wanted are effective.

    At most `MOST_ROUNDS` batches or `MOST_SAMPLES` samples.

    Parameters
    ----------
    batches : batches of samples
    weigh : weighs samples, given how many were before them and how many are expected in all
    prior_names : names of the priors of the unmodelled noise, that of the intervals first
    wanted : number of samples that shall be effective
    """
    empty = Weighted([], [], np.zeros(0), np.zeros((len(prior_names), 0)))
    ensemble = PriorEnsemble([], empty, wanted, prior_names)
    for hypercube in islice(batches, MOST_ROUNDS):
        before = len(ensemble.samples)
        batch = hypercube[: MOST_SAMPLES - before]
        expected = before * wanted / max(ensemble.effective, 1.0) if before else 2.0 * wanted
        further = weigh(batch, before, max(round(expected), before + len(batch) + 1))
        joined = Weighted(
            ensemble.batch.sounds + further.sounds,
            ensemble.batch.machines + further.machines,
            np.concatenate([ensemble.modelled_db, further.modelled_db]),
            np.concatenate([ensemble.batch.log_weight, further.log_weight], axis=1),
        )
        ensemble = PriorEnsemble(ensemble.samples + batch, joined, wanted, prior_names)
        if ensemble.effective >= wanted or len(ensemble.samples) >= MOST_SAMPLES:
            break
    return ensemble
