"""Paths from the loads of every case to the receivers, measured ones too, and sound by path."""

from ..base.registry import register
from ..levels.contribution_choice import chosen_speeds, loudest_orders
from ..levels.contributions import MEDIANS, contribution_variables, with_gain
from ..levels.nominal import NominalSound
from ..machine.cases import Cases
from ..measured.sound_functions import force_sound_of
from ..radiation.pressure import pressure_per_shell_velocity
from ..radiation.transfer_vectors import pressure_per_velocity
from ..study.study import Study
from ..transfer.contributions import Transmission
from ..transfer.force_sound import ForceSound
from ..transfer.observers import Observers
from ..transfer.path import ShellPath
from .chain import Chain
from .representative import Representative
from .stage import Given, Stage


@register
class Paths(Stage):
    """Paths of the sound, with the nominal values."""

    name = "paths"
    is_tried = True
    reads = (ShellPath, ForceSound, "transfer_vector", "pattern_transfer_vector")
    gives = (Transmission,)

    def run(self, chain: Chain) -> Given:
        results, measured, shell = chain.results, chain.get(ForceSound), chain.get(ShellPath)
        rigid = measured or pressure_per_velocity(results["transfer_vector"])
        modes = None if shell is None else pressure_per_shell_velocity(results)
        return Given(products=(Transmission(chain.study, Observers(rigid, modes), shell),))


@register
class MeasuredForceSound(Stage):
    """Measured pressure per force, in place of transfer vectors."""

    name = "force-sound"
    is_tried = True
    gives = (ForceSound,)

    def applies(self, study: Study) -> bool:
        return study.measured is not None and study.measured.sound is not None

    def run(self, chain: Chain) -> Given:
        return Given(products=(force_sound_of(chain.study),))


@register
class ContributionsByPath(Stage):
    """Pressure and shares of the transfer paths; with samples of one of them, at median levels."""

    name = "contributions"
    reads = (Cases, Transmission, NominalSound, Representative, *MEDIANS)
    gives = ("path_*", "motion_*", "modelled_band_level")

    def run(self, chain: Chain) -> Given:
        speeds, nominal, split = chosen_speeds(chain.study), chain[Cases], {}
        chosen = chain.get(Representative)
        every = nominal if chosen is None else chosen.cases
        cases = every.some(key for key in nominal.cases if key[0] in speeds)
        chain.progress("sound by path", 0, len(cases.cases))
        for key, of_case in chain[Transmission].contributions(cases):
            split[key] = of_case if chosen is None else with_gain(of_case, chosen.gain[key])
            chain.progress("sound by path", len(split), len(cases.cases))
        orders, medians = loudest_orders(chain.results), chain.results if chosen else None
        return Given(contribution_variables(chain[NominalSound].axes, split, orders, medians))
