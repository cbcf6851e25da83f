"""Sound by path at few speeds and orders."""

from ..base.registry import register
from ..levels.contribution_choice import chosen_speeds, loudest_orders
from ..levels.contributions import contribution_variables
from ..levels.nominal import NominalSound
from ..machine.cases import Cases
from ..transfer.received import Transmission
from .chain import Chain
from .representative import Representative
from .stage import Given, Stage


@register
class ContributionsByPath(Stage):
    """Pressure and shares of the transfer paths, of the representative sample if there is one."""

    name = "contributions"
    reads = (Cases, Transmission, NominalSound, Representative, "order_level")
    gives = ("path_*", "motion_*", "modelled_band_level")

    def run(self, chain: Chain) -> Given:
        speeds, nominal, split = chosen_speeds(chain.study), chain[Cases], {}
        chosen = chain.get(Representative)
        every = nominal if chosen is None else chosen.cases
        cases = every.some(key for key in nominal.cases if key[0] in speeds)
        chain.progress("sound by path", 0, len(cases.cases))
        for key, of_case in chain[Transmission].contributions(cases):
            split[key] = of_case
            chain.progress("sound by path", len(split), len(cases.cases))
        orders = loudest_orders(chain.results)
        return Given(contribution_variables(chain[NominalSound].axes, split, orders))
