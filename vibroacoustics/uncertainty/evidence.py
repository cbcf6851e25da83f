"""Samples with their discrepancies beside published data or a measured baseline."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Final, NamedTuple

import numpy as np
from scipy.special import logsumexp

from ..base.arrays import Array, IndexArray
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import power_of_level
from ..levels.agreement import LEVELS_DB, Datum, Prior, log_weight_of_points, log_weights
from ..levels.nominal import NominalSound, Sound
from ..levels.published import Published, published_of
from ..levels.remainder import over_published, unmodelled_bands
from ..machine.machine import Machine
from .discrepancy import Discrepancy

PAIRS: Final = 10
"""Number of pairs of a discrepancy and an unmodelled level that stay with a sample."""


class Pairs(NamedTuple):
    """Pairs of a sample.

    Attributes
    ----------
    discrepancy : its number, shape (pair,)
    unmodelled_db : level of unmodelled noise relative to the published one, shape (pair,)
    weight : relative to the first prior, shape (prior, pair)
    """

    discrepancy: IndexArray
    unmodelled_db: Array
    weight: Array


@dataclass(frozen=True)
class Evidence:
    """What weighs the samples of a study.

    Attributes
    ----------
    nominal : at the receivers and cases that weigh
    """

    nominal: NominalSound

    @cached_property
    def published(self) -> Published:
        """Published data of the machine."""
        return published_of(self.nominal.study)

    def modelled_db(self, sounds: Sequence[Sound]) -> Array:
        """Modelled levels relative to the published one without discrepancy, (sample,), dB."""
        return over_published(self.nominal.study, self.nominal.axes, sounds)

    def discrepancy(self, number: int) -> Discrepancy:
        """Return the discrepancies of the sample of a number."""
        study = self.nominal.study
        return Discrepancy.of(study.uncertainty, len(self.nominal.axes.sources), number)

    def mutual(self, sound: Sound) -> Array:
        """Mutual energies at the published point, shape (source, source, band), Pa²."""
        study = self.nominal.study
        receiver = list(self.nominal.axes.receivers).index(study.catalogue_receiver)
        return sound[study.catalogue_case].mutual[:, :, receiver]

    def unmodelled(self, machine: Machine) -> Array:
        """Unmodelled noise of a sample at the published level, A-weighted, shape (band,), Pa²."""
        return unmodelled_bands(self.nominal.study, machine)

    def log_weights(
        self,
        sound: Sound,
        machine: Machine,
        number: int,
        data: Sequence[Datum],
        priors: Sequence[Prior],
    ) -> Array:
        """Logarithms of the weights of a sample, shape (prior, discrepancy, unmodelled level).

        Parameters
        ----------
        sound : of the sample, at the cases that weigh
        machine : of the sample
        number : of the sample
        data : published ones that weigh
        priors : of the level of unmodelled noise
        """
        of_sample, study = self.discrepancy(number), self.nominal.study
        modelled = with_gain(self.mutual(sound), of_sample.gain)
        unmodelled = self.unmodelled(machine)
        weights = np.array([log_weights(modelled, unmodelled, data, prior) for prior in priors])
        if study.baseline is None or not self.nominal.points:
            return weights
        relative = np.array(
            [self.nominal.relative_to_measured(each) for each in of_sample.sounds(sound)]
        )
        tolerance = study.baseline.tolerance_db
        measured = [log_weight_of_points(relative.T, tolerance, prior) for prior in priors]
        with np.errstate(invalid="ignore"):
            weights -= logsumexp(weights, axis=2, keepdims=True)
        return np.nan_to_num(weights, nan=-np.inf) + np.array(measured)[..., None]

    def pairs_of(self, sound: Sound, machine: Machine, number: int) -> Pairs:
        """Return pairs of a sample with all published data; parameters as `log_weights`."""
        published = self.published
        of_sample = self.log_weights(sound, machine, number, published.data, published.priors)
        return self.pairs(of_sample, number)

    def unmodelled_pa2(self, pairs: Pairs) -> Array:
        """Return the unmodelled noise of pairs, A-weighted, shape (pair,), Pa²; 0 without data."""
        level = self.published.level_dba + pairs.unmodelled_db
        return np.asarray(
            REFERENCE_PRESSURE_PA**2 * power_of_level(level) * bool(self.published.data)
        )

    def pairs(self, log_weights: Array, number: int) -> Pairs:
        """Return pairs in proportion to their weights with the first prior, in random order.

        Parameters
        ----------
        log_weights : of the sample, see `log_weights`
        number : of the sample
        """
        rng = np.random.default_rng((self.nominal.study.uncertainty.seed, number, PAIRS))
        flat = log_weights.reshape(len(log_weights), -1)
        order = rng.permutation(flat.shape[1])  # else the picks would follow the grid
        weight = np.exp(flat[0, order] - flat[0].max())
        cell = order[systematic(weight, PAIRS, rng.uniform())]
        discrepancy, level = np.divmod(cell, LEVELS_DB.size)
        level_db = LEVELS_DB[level] + rng.uniform(-0.5, 0.5, PAIRS)  # within the step
        return Pairs(discrepancy, level_db, np.exp(flat[:, cell] - flat[0, cell]))


def systematic(weight: Array, count: int, start: float) -> IndexArray:
    """Numbers picked by systematic resampling, rising; large weights several times.

    Kitagawa 1996, Journal of Computational and Graphical Statistics 5, appendix.

    Parameters
    ----------
    weight : of each, shape (number,)
    count : of picks
    start : from 0 to 1
    """
    share = np.cumsum(weight) / weight.sum()
    picks = np.searchsorted(share, (np.arange(count) + start) / count)
    return np.asarray(np.minimum(picks, share.size - 1))


def with_gain(mutual: Array, gain: Array) -> Array:
    """Bands of all sources together with gains, shape (discrepancy, band), Pa².

    Parameters
    ----------
    mutual : shape (source, source, band)
    gain : factors on the power, shape (discrepancy, source, band)
    """
    root = np.sqrt(gain)
    return np.asarray(np.einsum("ksi,kti,sti->ki", root, root, mutual))
