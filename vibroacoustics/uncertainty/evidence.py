"""Samples with their discrepancies beside published and measured data of the machine."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Final, NamedTuple

import numpy as np
from scipy.special import logsumexp

from ..base.arrays import Array, IndexArray
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import power_of_level
from ..levels.agreement import LEVELS_DB, log_likelihood, log_weight_of_points, log_weights
from ..levels.by_source import gain_band_number
from ..levels.declared_level import Published, published_of
from ..levels.nominal import NominalSound, Sound
from ..levels.remainder import (
    UNMODELLED_MIDDLE_HZ,
    in_spectrum,
    over_published,
    unmodelled_bands,
)
from ..levels.spectrum_data import SpectrumData
from ..machine.machine import Machine
from .discrepancy import Discrepancy

PAIRS: Final = 10
"""Number of pairs of a discrepancy and an unmodelled level that stay with a sample."""


class Pairs(NamedTuple):
    """Pairs of a sample.

    Attributes
    ----------
    discrepancy : discrepancy of each pair
    unmodelled_db : level of unmodelled noise relative to the published one, shape (pair,)
    weight : relative to the first prior, shape (prior, pair)
    """

    discrepancy: Discrepancy
    unmodelled_db: Array
    weight: Array

    def repeated(self, count: int) -> Array:
        """Return the weights of a sample that was chosen several times, shape (prior, pair)."""
        return count * self.weight


@dataclass(frozen=True)
class Evidence:
    """Data that weigh the samples of a study.

    Attributes
    ----------
    nominal : at the receivers and cases that weigh
    """

    nominal: NominalSound

    @cached_property
    def published(self) -> Published:
        """Published and measured data of the machine."""
        return published_of(self.nominal.study)

    def modelled_db(self, sounds: Sequence[Sound]) -> Array:
        """Modelled levels relative to the published one without discrepancy, (sample,), dB."""
        return over_published(self.nominal.study, self.nominal.axes, sounds)

    def discrepancy(self, number: int) -> Discrepancy:
        """Return the discrepancies of the sample of a number."""
        settings, sources = self.nominal.study.uncertainty, len(self.nominal.axes.sources)
        return Discrepancy.of(settings, sources, number, self.published.spectrum is not None)

    def mutual(self, sound: Sound, spectrum: SpectrumData | None = None) -> Array:
        """Mutual energies at the published point or a spectrum's, (source, source, band), Pa²."""
        study, name = self.nominal.study, self.nominal.study.catalogue_receiver
        case = study.catalogue_case
        if spectrum is not None:
            name, case = spectrum.receiver, spectrum.case
        receiver = list(self.nominal.axes.receivers).index(name)
        return sound[case].mutual[:, :, receiver]

    def unmodelled(self, machine: Machine) -> Array:
        """Unmodelled noise of a sample at the published level, A-weighted, shape (band,), Pa²."""
        return unmodelled_bands(self.nominal.study, machine)

    def growth(self, machine: Machine, spectrum: SpectrumData | None) -> float:
        """Unmodelled noise at a spectrum's speed relative to the published one; 1 without one."""
        published_rpm = self.nominal.study.catalogue_speed_rpm
        speed_rpm = published_rpm if spectrum is None else spectrum.case[0]
        return float(machine.remainder.speed_factor(np.array(speed_rpm), published_rpm))

    def expected(
        self, sound: Sound, machine: Machine, power: float, spectrum: SpectrumData | None
    ) -> Array:
        """Bands of the machine without discrepancy, A-weighted, shape (band,), Pa².

        Parameters
        ----------
        sound, machine : sound and machine of the sample
        power : power of unmodelled noise relative to the published level
        spectrum : at whose point; at the published one where it is None
        """
        noise = power * self.growth(machine, spectrum) * self.unmodelled(machine)
        return np.asarray(self.mutual(sound, spectrum).sum(axis=(0, 1)) + noise)

    def log_weights(
        self, sound: Sound, machine: Machine, number: int, published: Published
    ) -> Array:
        """Logarithms of the weights of a sample, shape (prior, discrepancy, unmodelled level).

        Parameters
        ----------
        sound : sound of the sample, at the cases that weigh
        machine : machine of the sample
        number : number of the sample
        published : data that weigh, and priors of the level of unmodelled noise
        """
        of_sample, study = self.discrepancy(number), self.nominal.study
        modelled, priors = with_gain(self.mutual(sound), of_sample.gain), published.priors
        unmodelled = self.unmodelled(machine) * of_sample.unmodelled
        weights = np.array(
            [log_weights(modelled, unmodelled, published.data, prior) for prior in priors]
        )
        if published.spectrum is not None:
            modelled = with_gain(self.mutual(sound, published.spectrum), of_sample.gain)
            unmodelled = self.growth(machine, published.spectrum) * unmodelled
            weights += log_likelihood(modelled, unmodelled, published.spectrum.data)
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
        """Return pairs of a sample with all data; parameters as `log_weights`."""
        return self.pairs(self.log_weights(sound, machine, number, self.published), number)

    def unmodelled_pa2(self, pairs: Pairs, machine: Machine) -> Array:
        """Return the unmodelled noise of pairs, A-weighted, (pair, band), Pa²; 0 without data.

        The bands are `UNMODELLED_BANDS`.
        """
        level = self.published.level_dba + pairs.unmodelled_db
        square = REFERENCE_PRESSURE_PA**2 * power_of_level(level) * bool(self.published.data)
        factor = pairs.discrepancy.unmodelled[:, gain_band_number(UNMODELLED_MIDDLE_HZ)]
        return np.asarray(factor * square[:, None] * in_spectrum(machine, 1.0))

    def pairs(self, log_weights: Array, number: int) -> Pairs:
        """Return pairs in proportion to their weights with the first prior, in random order.

        Parameters
        ----------
        log_weights : logarithms of the sample's weights, see `log_weights`
        number : number of the sample
        """
        rng = np.random.default_rng((self.nominal.study.uncertainty.seed, number, PAIRS))
        flat = log_weights.reshape(len(log_weights), -1)
        order = rng.permutation(flat.shape[1])  # else the picks would follow the grid
        weight = np.exp(flat[0, order] - flat[0].max())
        cell = order[systematic(weight, PAIRS, rng.uniform())]
        discrepancy, level = np.divmod(cell, LEVELS_DB.size)
        level_db = LEVELS_DB[level] + rng.uniform(-0.5, 0.5, PAIRS)  # within the step
        of_pairs = self.discrepancy(number).some(discrepancy)
        return Pairs(of_pairs, level_db, np.exp(flat[:, cell] - flat[0, cell]))


def systematic(weight: Array, count: int, start: float) -> IndexArray:
    """Numbers picked by systematic resampling, rising; large weights several times.

    Kitagawa 1996, Journal of Computational and Graphical Statistics 5, appendix.

    Parameters
    ----------
    weight : weight of each, shape (number,)
    count : number of picks
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
