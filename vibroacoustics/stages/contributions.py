"""Sound by path, with the nominal values, at few speeds and orders."""

from ..base.registry import register
from ..levels.contribution_choice import chosen_speeds, loudest_orders
from ..levels.contributions import contribution_variables
from ..transfer.received import Transmission
from .chain import Cases, Chain
from .levels import NominalSound
from .stage import Given, Stage


@register
class ContributionsByPath(Stage):
    """Pressure and shares of the transfer paths."""

    name = "contributions"
    reads = (Cases, Transmission, NominalSound, "order_level")
    gives = (
        "path_pressure", "path_level", "path_share", "path_band_level", "path_band_share",
        "motion_level", "motion_share", "modelled_band_level",
    )  # fmt: skip

    def run(self, chain: Chain) -> Given:
        nominal, speeds = chain[Cases], chosen_speeds(chain.study)
        cases = {key: case for key, case in nominal.cases.items() if key[0] in speeds}
        split = {}
        chain.progress("sound by path", 0, len(cases))
        for key, of_case in chain[Transmission].contributions(cases, nominal.loads):
            split[key] = of_case
            chain.progress("sound by path", len(split), len(cases))
        orders = loudest_orders(chain.results)
        return Given(contribution_variables(chain[NominalSound].axes, split, orders))
