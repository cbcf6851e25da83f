"""Sound by path, with the nominal values, at few speeds and orders."""

from ..base.registry import register
from ..levels.contribution_choice import chosen_speeds, loudest_orders
from ..levels.contributions import contribution_variables
from ..machine.source import CaseKey
from ..radiation.pressure import wrench_pressure_by_dof
from ..transfer.force_sound import ForceSound
from ..transfer.received import (
    BySource,
    Transmission,
    by_case_and_source,
    wrench_pressure_by_motion,
)
from .chain import Cases, Chain
from .levels import NominalSound
from .stage import Given, Stage


@register
class ContributionsByPath(Stage):
    """Pressure and shares of the transfer paths."""

    name = "contributions"
    reads = (Cases, Transmission, NominalSound, ForceSound, "order_level", "velocity_order")
    gives = (
        "path_pressure", "path_level", "path_share", "path_band_level", "path_band_share",
        "motion_level", "motion_share", "modelled_band_level",
    )  # fmt: skip

    def run(self, chain: Chain) -> Given:
        nominal, speeds = chain[Cases], chosen_speeds(chain.study)
        cases = {key: case for key, case in nominal.cases.items() if key[0] in speeds}
        split = {}
        chain.progress("sound by path", 0, len(cases))
        paths = chain[Transmission].contributions(cases, nominal.loads, _of_wrenches(chain, speeds))
        for key, of_case in paths:
            split[key] = of_case
            chain.progress("sound by path", len(split), len(cases))
        orders = loudest_orders(chain.results)
        return Given(contribution_variables(chain[NominalSound].axes, split, orders))


def _of_wrenches(chain: Chain, speeds: list[float]) -> dict[CaseKey, BySource]:
    """Pressure of the wrenches over crank angle by motion, (receiver, 6, order), Pa."""
    of, sound = chain[Cases], chain.get(ForceSound)
    if sound is not None:
        return dict(wrench_pressure_by_motion(chain.results, of.cases, of.source_of_wrench, sound))
    by_motion = wrench_pressure_by_dof(chain.results.sel(speed=speeds))
    return dict(by_case_and_source(by_motion, of.source_of_wrench))
