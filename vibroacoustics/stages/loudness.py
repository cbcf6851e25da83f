"""Loudness and sharpness of the sound of every option."""

from ..base.registry import register
from ..sound.ingredients import AT_MICROPHONE, IN_ROOM
from ..sound.loudness import available
from ..sound.of_results import hearing_variables
from ..study.study import Study
from .chain import Chain
from .stage import Given, Stage


@register
class Loudness(Stage):
    """Loudness and sharpness at the microphones and in a room, where mosqito is installed."""

    name = "loudness"
    reads = (*AT_MICROPHONE, *IN_ROOM, "representative_value")
    gives = ("loudness", "sharpness", "loudness_in_room")

    def applies(self, study: Study) -> bool:
        return available()

    def run(self, chain: Chain) -> Given:
        return Given(hearing_variables(chain.results))
