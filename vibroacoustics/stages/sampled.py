"""Sound of every case with every sample."""

from collections.abc import Callable, Mapping
from typing import NamedTuple

from ..base.arrays import Array
from ..machine.source import CaseKey
from ..study.sampling import Draw
from ..transfer.received import Transmission
from ..uncertainty.drawn import DrawnCases
from ..uncertainty.draws import of_every_draw
from ..uncertainty.first_order import unknown_first_order
from .chain import Cases, Chain
from .levels import NominalSound, Sound, by_source


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
    chain: Chain, samples: list[Draw], progress: Callable[[int], None]
) -> list[SampledSound]:
    """Compute the sound of every case of a chain with every sample.

    Parameters
    ----------
    chain : with the nominal cases, paths and sound
    samples : values by table and field
    progress : called with the number of samples that are done
    """
    nominal, cases = chain[NominalSound], chain[Cases].cases

    def sound_of(sample: Draw) -> SampledSound:
        at = chain.at(sample)
        received = at[Transmission].received(at[Cases].cases, at[Cases].loads)
        sound = by_source(chain.study, nominal.axes, received)
        return SampledSound(sound, at[DrawnCases].first_order)

    unknown = {key: nominal.sound[key].unknown for key in cases}
    without = SampledSound(unknown, unknown_first_order(cases))
    return of_every_draw(samples, sound_of, without, progress)
