"""Energies of lines and third octaves by source."""

from dataclasses import replace

from ..base.registry import register
from ..levels.energy import energy_variables
from ..levels.nominal import NominalSound
from ..study.study import Study
from ..transfer.received import Transmission
from .chain import Chain
from .shown import SHOWN, Shown
from .stage import Given, Stage


@register
class Energies(Stage):
    """What each source, and unmodelled noise, adds to lines and third octaves.

    None with a measured baseline, which takes the place of what the sources make.
    """

    name = "energies"
    reads = (*SHOWN, NominalSound, "pressure_line")
    gives = ("line_energy", "band_energy")

    def applies(self, study: Study) -> bool:
        return study.baseline is None

    def run(self, chain: Chain) -> Given:
        shown = Shown.of(chain)
        axes = replace(chain[NominalSound].axes, options=shown.options)
        case = {"speed": shown.speed_rpm, "option": list(shown.options)}
        pressure, sound = (
            chain.results["pressure_line"].sel(case),
            shown.received(chain[Transmission]),
        )
        return Given(energy_variables(axes, sound, pressure, shown.unmodelled))
