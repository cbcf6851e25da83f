"""From the forces of the feet through the plate under them to the microphones."""

from ..base.registry import register
from ..levels.structure_borne import structure_borne_variables
from ..machine.cases import Cases
from ..study.study import Study
from ..transfer.plate.under_feet import plate_sound
from .chain import Chain
from .stage import Given, Stage


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
