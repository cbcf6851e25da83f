"""Samples of the machine: their sound where it is published, and all that goes on of them."""

import os
from collections.abc import Callable

from ..levels.nominal import NominalSound, Sound, by_source
from ..levels.rating import sampled_rating
from ..levels.sample_levels import Deviating, sample_levels
from ..machine.cases import Cases
from ..study.samples import batches_of_samples
from ..study.sampling import Sample
from ..study.study import Study
from ..transfer.contributions import Transmission
from ..uncertainty.every_sample import in_every_sample
from ..uncertainty.evidence import Evidence, Pairs
from ..uncertainty.prior_ensemble import PriorEnsemble
from ..uncertainty.sample_variables import SampleValues
from ..uncertainty.sampled_forces import force_variables, sampled_forces, sampled_tones
from .chain import Chain


def sounds_of(chain: Chain, samples: list[Sample], progress: Callable[[int], None]) -> list[Sound]:
    """Compute the sound of every case of a chain with every sample."""
    nominal, path = chain[NominalSound], chain[Transmission]

    def sound_of(sample: Sample) -> Sound:
        return by_source(chain.study, nominal.axes, path.received(chain.at(sample)[Cases]))

    unknown = {key: nominal.sound[key].unknown for key in chain[Cases].cases}
    return in_every_sample(samples, sound_of, unknown, progress, "ensemble", chain.study)


def values_of(
    chain: Chain,
    ensemble: PriorEnsemble,
    numbers: list[tuple[int, int]],
    progress: Callable[[int], None],
) -> list[SampleValues | None]:
    """Compute levels and forces of the samples that go on; none of those without a solution."""

    def of_number(counted: tuple[int, int]) -> SampleValues | None:
        return _values(chain, ensemble, *counted)

    return in_every_sample(numbers, of_number, None, progress, "samples", chain.study)


def _values(chain: Chain, ensemble: PriorEnsemble, number: int, count: int) -> SampleValues:
    """Levels and forces of a sample with its pairs of discrepancy and unmodelled level."""
    study, axes = chain.study, chain[NominalSound].axes
    sample, pairs, sampled, sound = deviating(chain, ensemble, number)
    levels = sample_levels(study, axes, chain.results["order_frequency"].values, sample)
    lines = chain.results["judged_tone"].values.tolist()
    levels |= sampled_tones(study, axes, lines, sample, levels)
    levels |= sampled_rating(study, axes, levels)
    changed = sampled_forces(study, chain[Cases], sampled, chain.results)
    forces = force_variables(changed, chain.results)
    receiver = list(axes.receivers).index(study.catalogue_receiver)
    mutual = axes.gathered(sound, "mutual")[:, :, :, :, receiver]
    return SampleValues.of(levels, forces, pairs.repeated(count), mutual)


def deviating(
    chain: Chain, ensemble: PriorEnsemble, number: int
) -> tuple[Deviating, Pairs, Cases, Sound]:
    """Compute the sound of a sample with the discrepancies of its pairs.

    Returns
    -------
    sound, pairs of discrepancy and unmodelled level, cases of the sample, and its sound without
    discrepancy
    """
    study, evidence, axes = chain.study, chain[Evidence], chain[NominalSound].axes
    sampled = chain.at(ensemble.samples[number])[Cases]
    received = chain[Transmission].received(sampled)
    sound = by_source(study, axes, received)
    at_published, machine = ensemble.batch.sounds[number], ensemble.batch.machines[number]
    pairs = evidence.pairs_of(at_published, machine, number)
    gains, sounds = pairs.discrepancy.gains(sound), pairs.discrepancy.sounds(sound)
    noise = evidence.unmodelled_pa2(pairs, machine)
    return Deviating(received, gains, sounds, machine, noise), pairs, sampled, sound


def timed_sounds(chain: Chain, study: Study, count: int) -> tuple[list[Sound], float]:
    """Compute the sound of the first samples of a study; also the processor time of all, s."""
    samples = next(batches_of_samples(study))[:count]
    start = _processor_time_s()
    sounds = sounds_of(chain, samples, lambda _: None)
    return sounds, _processor_time_s() - start


def _processor_time_s() -> float:
    """Return the processor time of this process and of its ended workers."""
    return sum(os.times()[:4])
