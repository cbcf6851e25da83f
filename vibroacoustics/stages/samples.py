"""All cases with the samples that go on."""

from typing import Final

from ..base.registry import register
from ..levels.nominal import NominalSound
from ..machine.cases import Cases
from ..study.study import Study
from ..transfer.received import Transmission
from ..uncertainty.bank import Bank
from ..uncertainty.cost import samples_cost
from ..uncertainty.evidence import Evidence
from ..uncertainty.sample_variables import sample_variables
from .chain import Chain
from .forces import PublishedCases, with_published
from .sampled import sounds_of, timed_sounds
from .stage import Given, Stage, Trial

_TIMED: Final = 2
"""Number of samples that are timed."""


@register
class Samples(Stage):
    """Levels, changes and forces of all cases with the samples that go on."""

    name = "samples"
    reads = (
        Cases, PublishedCases, Transmission, NominalSound, Bank, Evidence, "force_amplitude",
        "moment_amplitude", "foot_force_amplitude",
    )  # fmt: skip
    gives = (
        "*_by_sample", "sample_weight", "sampled_value", "choice_utility", "perfect_information",
        "parameter_information*",
    )  # fmt: skip

    def applies(self, study: Study) -> bool:
        return bool(study.ranges)

    def run(self, chain: Chain) -> Given:
        bank, nominal = chain[Bank], chain[NominalSound]
        if not bank.suffices:
            return Given()
        chosen = bank.chosen(chain.study.uncertainty.seed)
        samples = [bank.samples[number] for number in chosen[0].tolist()]

        def done(number: int) -> None:
            chain.progress("sources", number, len(samples))

        sampled = sounds_of(with_published(chain), samples, done)
        sounds, first_order = zip(*sampled, strict=True)
        return Given(
            sample_variables(
                nominal, chain[Evidence], bank, chosen, sounds, first_order, chain.results
            )
        )

    def tried(self, chain: Chain, study: Study) -> Trial:
        sounds, seconds = timed_sounds(with_published(chain), study, _TIMED)
        return Trial(chain, (samples_cost(study, len(sounds), seconds),))
