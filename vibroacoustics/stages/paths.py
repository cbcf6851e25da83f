"""Paths from the loads of every case to the receivers, measured ones too, and sound by path."""

from ..base.registry import register
from ..base.vocabulary import REFERENCE_OPTION
from ..levels.contribution_choice import chosen_speeds, loudest_orders
from ..levels.contributions import Row, path_rows
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
from ..uncertainty.alternative_sounds import ComputedSamples
from ..uncertainty.every_sample import in_every_sample
from ..uncertainty.evidence import Evidence
from ..uncertainty.path_variables import path_variables
from ..uncertainty.prior_ensemble import PriorEnsemble
from .chain import Chain
from .forces import PublishedCases, with_published
from .sampled import deviating
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
    """Levels and shares of the transfer paths without an option, over the weighted samples."""

    name = "contributions"
    reads = (
        Cases, PublishedCases, Transmission, NominalSound, PriorEnsemble, Evidence, ComputedSamples,
        "order_level",
    )  # fmt: skip
    gives = ("path_*", "motion_*", "modelled_band_level")

    def run(self, chain: Chain) -> Given:
        study, axes, computed = chain.study, chain[NominalSound].axes, chain.get(ComputedSamples)
        keys = [(speed, REFERENCE_OPTION) for speed in chosen_speeds(study)]
        split, orders = chain[Transmission].contributions, loudest_orders(chain.results)
        without = chain.having(chain[Cases].some(keys))
        if computed is None:
            nominal = path_rows(split(without[Cases]), {}, axes, orders)
            return Given(path_variables(axes, orders, [nominal]))
        published, ensemble = with_published(without), chain[PriorEnsemble]

        def of_sample(number: int) -> list[Row]:
            sample, _, cases, _ = deviating(published, ensemble, number)
            return path_rows(split(cases.some(keys)), sample.gain, axes, orders)

        def done(number: int) -> None:
            chain.progress("sound by path", number, len(computed.numbers))

        nothing: list[Row] = []
        every = in_every_sample(computed.numbers, of_sample, nothing, done, self.name, study)
        return Given(path_variables(axes, orders, every, computed.counts))
