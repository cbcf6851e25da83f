"""Sound of the samples with the likelihood of each alternative to a study."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Final, NamedTuple

import numpy as np
from scipy.special import logsumexp

from ..base.arrays import Array
from ..base.decibel import level_of_power
from ..base.vocabulary import REFERENCE_OPTION
from ..levels.agreement import Datum, with_noise
from ..levels.changes import FORCES, TOTAL, change_db
from ..levels.declared_level import Published
from ..levels.nominal import Sound
from ..levels.remainder import remaining
from ..levels.spectrum_data import SpectrumData
from ..machine.machine import Machine
from .alternatives import Alternative
from .discrepancy import Discrepancy, with_added
from .evidence import Evidence, Pairs, with_gain
from .prior_ensemble import PriorEnsemble

CHANGES: Final = (TOTAL, FORCES[-1])
"""Quantities whose changes by options the first screen of a report gives."""


@dataclass(frozen=True)
class ComputedSamples:
    """Samples that were computed in all cases.

    Attributes
    ----------
    numbers : in the ensemble
    counts : how many times each counts
    mutual : A-weighted mean squares of pairs of sources at the published microphone, of each
        sample, shape (speed, option, source, source, gain band), Pa²
    foot_force : largest force into a foot at 1x, of each sample, shape (speed, option), N
    """

    numbers: tuple[int, ...] = ()
    counts: tuple[int, ...] = ()
    mutual: tuple[Array, ...] = ()
    foot_force: tuple[Array, ...] = ()


class SampleSound(NamedTuple):
    """Sound of a sample with the pairs that an alternative chooses.

    Attributes
    ----------
    log_weight : logarithm of the likelihood of the sample
    parts : energy of sources, with half of their interference, and of unmodelled noise at the
        published point, shape (pair, part), Pa²; None of a sample without weight
    changes : changes of `CHANGES`, shape (pair, quantity, speed, option), dB; None of a sample
        that was not computed in all cases
    """

    log_weight: float
    parts: Array | None = None
    changes: Array | None = None


def sounds_of_alternatives(
    evidence: Evidence,
    ensemble: PriorEnsemble,
    computed: ComputedSamples,
    alternatives: Sequence[Alternative],
) -> list[list[SampleSound]]:
    """Return the sound of all samples for each alternative.

    Parameters
    ----------
    evidence : data of the study
    ensemble : samples of the prior
    computed : samples with all cases
    alternatives : to the study
    """
    nominal, batch = evidence.nominal, ensemble.batch
    of_settings = {
        each.study.uncertainty: Evidence(replace(nominal, study=each.study))
        for each in alternatives
    }
    rows = {number: row for row, number in enumerate(computed.numbers)}
    sounds: list[list[SampleSound]] = [[] for _ in alternatives]
    for number, (sound, machine) in enumerate(zip(batch.sounds, batch.machines, strict=True)):
        likelihoods = {
            settings: SampleLikelihood(each, sound, machine, number)
            for settings, each in of_settings.items()
        }
        for of_alternative, each in zip(sounds, alternatives, strict=True):
            likelihood = likelihoods[each.study.uncertainty]
            of_alternative.append(likelihood.sound_of(each.published, computed, rows.get(number)))
    return sounds


@dataclass(frozen=True)
class SampleLikelihood:
    """Likelihood of a sample with its discrepancies; what alternatives share is computed once.

    Attributes
    ----------
    evidence : with the settings of the discrepancy
    sound, machine : sound and machine of the sample
    number : number of the sample
    """

    evidence: Evidence
    sound: Sound
    machine: Machine
    number: int
    _at_points: dict[str, Array] = field(default_factory=dict)
    _by_datum: dict[tuple[str, float], Array] = field(default_factory=dict)
    _sounds: dict[tuple[object, ...], SampleSound] = field(default_factory=dict)

    def sound_of(
        self, published: Published, computed: ComputedSamples, row: int | None
    ) -> SampleSound:
        """Return the sound with the data and the prior of an alternative.

        Parameters
        ----------
        published : data and one prior
        computed : samples with all cases
        row : row of the sample among them; None where it is none of them
        """
        key = (published.priors[0].name, *map(_key, _data(published)))
        if key not in self._sounds:
            self._sounds[key] = self._sound_of(published, computed, row)
        return self._sounds[key]

    def _sound_of(
        self, published: Published, computed: ComputedSamples, row: int | None
    ) -> SampleSound:
        log_weights = published.priors[0].log_density + sum(
            self._log_likelihood(datum, published) for datum in _data(published)
        )
        log_weight = float(logsumexp(log_weights))
        if not np.isfinite(log_weight):
            return SampleSound(-np.inf)
        pairs = self.evidence.pairs(log_weights[None], self.number)
        changes = None if row is None else self._changes(pairs, computed, row)
        return SampleSound(log_weight, self._parts(pairs), changes)

    def _log_likelihood(self, datum: Datum, published: Published) -> Array:
        """Logarithm of the likelihood of one datum, shape (discrepancy, unmodelled level)."""
        key = _key(datum)
        if key not in self._by_datum:
            of_spectrum = published.spectrum is not None and datum in published.spectrum.data
            bands = self._bands(published.spectrum if of_spectrum else None)
            self._by_datum[key] = datum.log_likelihood(bands)
        return self._by_datum[key]

    def _bands(self, spectrum: SpectrumData | None) -> Array:
        """Bands at the point of a spectrum, shape (discrepancy, unmodelled level, band), Pa².

        Without any discrepancy one of them stands for all.
        """
        name = "" if spectrum is None else spectrum.receiver
        if name not in self._at_points:
            discrepancy = self.evidence.discrepancy(self.number)
            if np.all(discrepancy.gain == 1.0) and np.all(discrepancy.unmodelled == 1.0):
                discrepancy = discrepancy.some(slice(1))
            growth = self.evidence.growth(self.machine, spectrum)
            unmodelled = growth * self.evidence.unmodelled(self.machine) * discrepancy.unmodelled
            modelled = with_gain(self.evidence.mutual(self.sound, spectrum), discrepancy.gain)
            self._at_points[name] = with_noise(modelled, unmodelled)
        return self._at_points[name]

    def _parts(self, pairs: Pairs) -> Array:
        """Energy of sources and unmodelled noise, shape (pair, part), Pa²."""
        root = np.sqrt(pairs.discrepancy.gain)
        mutual = self.evidence.mutual(self.sound)
        of_sources = np.einsum("ksi,kti,sti->ks", root, root, mutual)
        noise = self.evidence.unmodelled_pa2(pairs, self.machine).sum(axis=1)
        return np.column_stack((of_sources, noise))

    def _changes(self, pairs: Pairs, computed: ComputedSamples, row: int) -> Array:
        """Changes of `CHANGES`, shape (pair, quantity, speed, option), dB."""
        nominal = self.evidence.nominal
        reference = list(nominal.axes.options).index(REFERENCE_OPTION)
        receiver = list(nominal.axes.receivers).index(nominal.study.catalogue_receiver)
        noise_pa2 = self.evidence.unmodelled_pa2(pairs, self.machine)
        factor = remaining(nominal.study, nominal.axes, self.machine, np.ones(noise_pa2.shape[1]))
        noise = np.einsum("xoi,ki->kxo", factor[:, :, receiver], noise_pa2)
        modelled = modelled_energy(pairs.discrepancy, computed.mutual[row], reference)
        total = np.asarray(level_of_power(modelled + noise))
        of_total = total - total[..., [reference]]
        of_force = change_db(computed.foot_force[row], reference)
        return np.stack([of_total, np.broadcast_to(of_force, of_total.shape)], axis=1)


def modelled_energy(discrepancy: Discrepancy, mutual: Array, reference: int) -> Array:
    """Compute the energy of all sources with discrepancies, (discrepancy, speed, option), Pa².

    Parameters
    ----------
    discrepancy : discrepancies of the pairs
    mutual : shape (speed, option, source, source, gain band), Pa²
    reference : number of the option without a change
    """
    energy = np.einsum("xossi->xosi", mutual)[:, :, None, :, None]
    gain = with_added(discrepancy.gain, discrepancy.added, energy, energy[:, [reference]])
    root = np.sqrt(gain[..., 0, :])
    return np.asarray(np.einsum("xoksi,xokti,xosti->kxo", root, root, mutual))


def _data(published: Published) -> tuple[Datum, ...]:
    """Published data and, with a spectrum, its octaves."""
    measured = () if published.spectrum is None else published.spectrum.data
    return (*published.data, *measured)


def _key(datum: Datum) -> tuple[str, float]:
    return datum.name, datum.deviation
