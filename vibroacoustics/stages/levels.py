"""Levels of all sources at the receivers, their loudness, and the sound of the plate below."""

from ..base.registry import register
from ..levels.axes import LevelAxes
from ..levels.nominal import NominalSound
from ..levels.remainder import UNMODELLED_MIDDLE_HZ
from ..levels.structure_borne import structure_borne_variables
from ..machine.cases import Cases
from ..radiation.spreading import spreading_of
from ..sound.ingredients import AT_MICROPHONE, IN_ROOM
from ..sound.of_results import hearing_variables
from ..sound.tone_spectra import tone_variables
from ..sources.cases import sources_of
from ..study.study import Study
from ..transfer.contributions import Transmission
from ..transfer.plate.under_feet import plate_sound
from .chain import Chain
from .forces import PublishedCases, with_published
from .stage import Given, Stage, Trial, timed


@register
class Levels(Stage):
    """Levels of lines, noise, sources and totals, with the unmodelled noise."""

    name = "levels"
    reads = (
        Cases, PublishedCases, Transmission, "velocity_order", "force_amplitude",
        "moment_amplitude", "largest_foot_force",
    )  # fmt: skip
    gives = (
        NominalSound, "pressure_line", "order_level", "noise_band_level", "unmodelled_band_level",
        "total_band_level", "sources_band_level", "level_modelled", "level_unmodelled",
        "level_total", "residual_level", "order_change", "change_1x", "change_modelled",
        "change_total", "force_change_1x", "moment_change_1x", "foot_force_change_1x",
        "increase_probability", "decrease_probability", "source_level", "source_band_level",
        "source_share", "unmodelled_share", "baseline_*", "tone_*", "decisive_audibility",
        "tonal_adjustment", "largest_tone_excess", "any_tone_probability",
    )  # fmt: skip

    def run(self, chain: Chain) -> Given:
        study, results = chain.study, chain.results
        spreading = spreading_of(study, UNMODELLED_MIDDLE_HZ)
        axes = LevelAxes.of(study, list(sources_of(study)), results, spreading)
        received = chain[Transmission].received(with_published(chain)[Cases])
        nominal = NominalSound.of(study, axes, received)
        levels = nominal.levels(received, results["order_frequency"])
        changes = nominal.changes(levels, results)
        return Given(levels.merge(changes).merge(tone_variables(levels)), (nominal,))

    def tried(self, chain: Chain, study: Study) -> Trial:
        return timed(chain, self, len(study.operation.speed_rpm))


@register
class Loudness(Stage):
    """Loudness and sharpness at the microphones and in a room."""

    name = "loudness"
    reads = (*AT_MICROPHONE, *IN_ROOM, "representative_value")
    gives = ("loudness", "sharpness", "loudness_in_room")

    def run(self, chain: Chain) -> Given:
        return Given(hearing_variables(chain.results))


@register
class StructureBorneSound(Stage):
    """Sound of the plate under the feet."""

    name = "structure-borne"
    reads = (Cases, "pressure_line", "level_total")
    gives = ("structure_borne_*", "level_both_ways")

    def applies(self, study: Study) -> bool:
        return study.structure_borne is not None

    def run(self, chain: Chain) -> Given:
        study, results, settings = chain.study, chain.results, chain.study.structure_borne
        if settings is None:
            return Given()
        frequency = results["tone_frequency"].transpose("speed", "line")
        sound = plate_sound(settings, chain[Cases], list(study.options), frequency)
        away_m = [receiver.distance_m for receiver in study.receivers.values()]
        return Given(structure_borne_variables(settings, sound, away_m, results))
