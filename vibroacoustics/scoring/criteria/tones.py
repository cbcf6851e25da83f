"""Tones of the sound, and the rating level that they raise."""

from ...base.registry import register
from ...study.criterion import Criterion


@register
class ToneExcess(Criterion):
    """Largest excess of a tone over its criterion.

    Worst over the microphones and speeds; prominent from 0 dB, between -60 and 60 dB.
    """

    name = "tone_excess_db"
    label = "Most prominent tone over its criterion"
    unit = "dB"
    position = 8.0
    variable = "largest_tone_excess"


@register
class Audibility(Criterion):
    """Level of the most audible tone over its masked threshold.

    Worst over the microphones and speeds; audible from 0 dB, between -10 and 60 dB.
    """

    name = "audibility_db"
    label = "Most audible tone over its masked threshold"
    unit = "dB"
    position = 8.5
    variable = "decisive_audibility"


@register
class RatingLevel(Criterion):
    """Rating level, with its adjustments for tones; worst over windows and speeds."""

    name = "rating_level_dba"
    label = "Rating level, worst over the windows"
    unit = "dB(A)"
    position = 8.7
    variable = "rating_level"
    table = "rating"
