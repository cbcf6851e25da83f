"""Sound of every case with every sample."""

import os
from collections.abc import Callable, Mapping
from typing import NamedTuple

from ..base.arrays import Array
from ..levels.nominal import NominalSound, Sound, by_source
from ..machine.cases import Cases
from ..machine.source import CaseKey
from ..study.samples import batches_of_samples
from ..study.sampling import Sample
from ..study.study import Study
from ..transfer.received import Transmission
from ..uncertainty.every_sample import in_every_sample
from ..uncertainty.first_order import changed_first_order, unknown_first_order
from .chain import Chain


class SampledSound(NamedTuple):
    """What a sample makes.

    Attributes
    ----------
    sound : mean squares by source of every case
    first_order : forces at 1x of the cases that move otherwise than the nominal ones
    """

    sound: Sound
    first_order: Mapping[CaseKey, Array]


def sounds_of(
    chain: Chain, samples: list[Sample], progress: Callable[[int], None]
) -> list[SampledSound]:
    """Compute the sound of every case of a chain with every sample.

    Parameters
    ----------
    chain : with the nominal cases, paths and sound
    samples : values by table and field
    progress : called with the number of samples that are done
    """
    nominal, cases, path = chain[NominalSound], chain[Cases], chain[Transmission]

    def sound_of(sample: Sample) -> SampledSound:
        sampled = chain.at(sample)[Cases]
        sound = by_source(chain.study, nominal.axes, path.received(sampled))
        return SampledSound(sound, changed_first_order(cases, sampled))

    unknown = {key: nominal.sound[key].unknown for key in cases.cases}
    without = SampledSound(unknown, unknown_first_order(unknown))
    return in_every_sample(samples, sound_of, without, progress)


def timed_sounds(chain: Chain, study: Study, count: int) -> tuple[list[Sound], float]:
    """Compute the sound of the first samples of a study; also the processor time of all, s.

    Parameters
    ----------
    chain : at the first speed
    study : with all speeds
    count : number of samples
    """
    samples = next(batches_of_samples(study))[:count]
    start = _processor_time_s()
    sampled = sounds_of(chain, samples, lambda _: None)
    return [each.sound for each in sampled], _processor_time_s() - start


def _processor_time_s() -> float:
    """Return the processor time of this process and of its ended workers."""
    return sum(os.times()[:4])
