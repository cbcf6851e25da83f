"""From the forces of the feet through the plate under them to the microphones."""

import numpy as np

from ..base.arrays import Array
from ..base.registry import register
from ..levels.structure_borne import (
    PlateSound,
    mean_square_per_power,
    spread_of_power,
    structure_borne_variables,
)
from ..study.structure_borne import StructureBorne
from ..study.study import Study
from ..transfer import on_mounts
from ..transfer.foot_lines import force_at_lines
from ..transfer.plate.under_feet import plate_power
from .chain import Cases, Chain
from .stage import Given, Stage


@register
class StructureBorneSound(Stage):
    """Sound of the plate under the feet."""

    name = "structure-borne"
    reads = (Cases, "pressure_line", "level_total")
    gives = (
        "structure_borne_input_power", "structure_borne_power", "structure_borne_level",
        "structure_borne_level_low", "structure_borne_level_high", "structure_borne_line_level",
        "structure_borne_line_low", "structure_borne_line_high", "level_both_ways",
    )  # fmt: skip

    def applies(self, study: Study) -> bool:
        return study.structure_borne is not None

    def run(self, chain: Chain) -> Given:
        settings, results = chain.study.structure_borne, chain.results
        if settings is None:
            return Given()
        frequency_hz = results["tone_frequency"].transpose("speed", "line").values
        sound = _plate_sound(chain, settings, frequency_hz)
        away_m = np.array([one.distance_m for one in chain.study.receivers.values()])
        return Given(
            structure_borne_variables(
                sound,
                mean_square_per_power(away_m, settings.absorption_area_m2),
                frequency_hz,
                spread_of_power(sound, frequency_hz, settings.deviation_db),
                results["level_total"],
                [str(name) for name in results["line"].values],
            )
        )


def _plate_sound(chain: Chain, settings: StructureBorne, frequency_hz: Array) -> PlateSound:
    """Power of every case, (speed, option, line)."""
    study, of, results = chain.study, chain[Cases], chain.results
    names = [str(name) for name in results["line"].values]
    shape = (3, len(study.operation.speed_rpm), len(study.options), len(names))
    power = np.zeros(shape)
    for s, speed in enumerate(study.operation.speed_rpm):
        for o, option in enumerate(study.options):
            case = of.cases[speed, option]
            wrenches = of.wrenches[speed, option]
            force = force_at_lines(case, of.loads[speed, option], wrenches, names)
            hertz = np.nan_to_num(frequency_hz[s])
            power[:, s, o] = plate_power(settings, on_mounts(case.machine), force, hertz)
    return PlateSound(*power)
