"""Loudness and audibility of tones at the microphones, of modelled sound and unmodelled noise."""

from typing import ClassVar

from ...base.arrays import Array
from ...base.decibel import power_of_level
from ...base.registry import register
from ...study.design import Wanted
from ..engine.hearing import AUDIBILITY, LOUDNESS
from ..engine.needs import Need, ResponsesByNeed
from ..figure import DesignFigure, Setting


@register
class Loudness(DesignFigure):
    """Loudness by ISO 532-1 in the free field, without rounding."""

    name = "loudness_sone"
    label = "Loudness (ISO 532-1)"
    position = 7.0

    def needs(self, wanted: Wanted) -> tuple[Need, ...]:
        """Loudness."""
        return (LOUDNESS,)

    def values(self, responses: ResponsesByNeed, setting: Setting) -> Array:
        """Loudness by speed and microphone, sone."""
        return responses[LOUDNESS]


@register
class Audibility(DesignFigure):
    """Decisive audibility of tones by ISO/PAS 20065, without the stepped adjustment."""

    name = "audibility_db"
    label = "Audibility of the most audible tone"
    position = 8.0
    is_level: ClassVar[bool] = True

    def needs(self, wanted: Wanted) -> tuple[Need, ...]:
        """Decisive audibility."""
        return (AUDIBILITY,)

    def values(self, responses: ResponsesByNeed, setting: Setting) -> Array:
        """Power that the audibility is the level of: its mean is that of energies."""
        return power_of_level(responses[AUDIBILITY])
