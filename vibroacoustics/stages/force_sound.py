"""A study whose radiation and room are measured: sound pressure by force."""

from ..base.registry import register
from ..measured.sound_functions import force_sound_of
from ..study.study import Study
from ..transfer.force_sound import ForceSound
from .chain import Chain
from .stage import Given, Stage, Trial, advanced


@register
class MeasuredForceSound(Stage):
    """Measured pressure per force, in place of transfer vectors."""

    name = "force-sound"
    gives = (ForceSound,)

    def applies(self, study: Study) -> bool:
        return study.measured is not None and study.measured.sound is not None

    def run(self, chain: Chain) -> Given:
        return Given(products=(force_sound_of(chain.study),))

    def tried(self, chain: Chain, study: Study) -> Trial:
        return Trial(advanced(chain, self))
