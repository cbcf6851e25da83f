"""Deflection of the housing at the loudest line, and the forces that act on the machine."""

from ..base.registry import register
from ..base.vocabulary import stamp
from ..levels.energy import loudest_line
from ..machine.source import Shared
from ..transfer.deflection import MovingCase, deflection_variables
from ..transfer.received import Transmission
from ..transfer.section import section_variables
from .chain import Chain
from .shown import SHOWN, Shown
from .stage import Given, Stage


@register
class Deflection(Stage):
    """Displacement of rings around the shell, of the feet and of the rigid body; forces."""

    name = "deflection"
    reads = (*SHOWN, "pressure_line")
    gives = ("shown_speed", "deflection*", "section_force")

    def run(self, chain: Chain) -> Given:
        shown, transmission, cases = Shown.of(chain), chain[Transmission], {}
        pressure = chain.results["pressure_line"].sel(receiver=chain.study.catalogue_receiver)
        for (speed, option), case in shown.cases.cases.items():
            key = speed, option
            cases[option] = MovingCase(
                transmission.path(Shared(), case.machine, shown.cases.loads[key]),
                transmission.lines(key, shown.cases),
                loudest_line(pressure.sel(speed=speed, option=option)),
            )
        results = deflection_variables(cases, shown.machine.shell)
        results = results.merge(section_variables(cases, shown.machine))
        return Given(results.assign(shown_speed=stamp("shown_speed", shown.speed_rpm)))
