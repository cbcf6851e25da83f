"""All cases with the samples that go on."""

from collections.abc import Mapping
from typing import Final

from ..base.registry import register
from ..levels.nominal import NominalSound
from ..machine.cases import Cases
from ..study.study import Study
from ..transfer.contributions import Transmission
from ..uncertainty.alternative_sounds import ComputedSamples
from ..uncertainty.cost import samples_cost
from ..uncertainty.evidence import Evidence
from ..uncertainty.prior_ensemble import PriorEnsemble
from ..uncertainty.sample_variables import SampleValues, sample_variables
from .chain import Chain
from .forces import PublishedCases, with_published
from .sampled import timed_sounds, values_of
from .stage import Given, Stage, Trial

_TIMED: Final = 2
"""Number of samples that are timed."""


def _computed(solved: Mapping[tuple[int, int], SampleValues]) -> ComputedSamples:
    """Sound and foot force of samples by their number in the ensemble and how often they count."""
    numbers, counts = zip(*solved, strict=True)
    mutual = tuple(values.mutual for values in solved.values())
    force = tuple(values.forces["largest_foot_force"][..., 1] for values in solved.values())
    return ComputedSamples(numbers, counts, mutual, force)


@register
class Samples(Stage):
    """Levels, changes and forces of all cases with the samples that go on."""

    name = "samples"
    reads = (
        Cases, PublishedCases, Transmission, NominalSound, PriorEnsemble, Evidence, "rating_limit",
        "force_amplitude", "moment_amplitude", "foot_force_amplitude", "reported_figure",
    )  # fmt: skip
    gives = (
        ComputedSamples, "*_by_sample", "sample_weight", "sampled_value", "choice_utility",
        "perfect_information", "parameter_information*",
    )  # fmt: skip
    estimates = (
        "force_amplitude", "moment_amplitude", "foot_force_amplitude", "largest_foot_force",
        "reported_figure", "force_change_1x", "moment_change_1x", "foot_force_change_1x",
        "order_level", "level_modelled", "level_total", "level_unmodelled", "residual_level",
        "noise_band_level", "unmodelled_band_level", "total_band_level", "sources_band_level",
        "order_change", "change_1x", "change_modelled", "change_total", "increase_probability",
        "decrease_probability", "source_level", "source_band_level", "source_share",
        "unmodelled_share", "tone_level", "tone_excess", "largest_tone_excess", "tone_audibility",
        "decisive_audibility", "tonal_adjustment", "tone_probability", "any_tone_probability",
        "rating_level", "rating_adjustment", "limit_probability",
    )  # fmt: skip

    def applies(self, study: Study) -> bool:
        return bool(study.ranges)

    def run(self, chain: Chain) -> Given:
        ensemble = chain[PriorEnsemble]
        if not ensemble.suffices:
            return Given()
        index, count = ensemble.chosen(chain.study.uncertainty.seed)
        numbers = list(zip(index.tolist(), count.tolist(), strict=True))

        values = values_of(
            with_published(chain), ensemble, numbers,
            lambda done: chain.progress("sources", done, len(numbers)),
        )  # fmt: skip
        solved = {key: of for key, of in zip(numbers, values, strict=True) if of is not None}
        if not solved:
            return Given()
        statistics, kept = sample_variables(
            chain.study,
            [ensemble.samples[number] for number, _ in solved],
            list(solved.values()),
            ensemble.prior_names,
            chain.results,
        )
        return Given(kept, (_computed(solved),), statistics)

    def tried(self, chain: Chain, study: Study) -> Trial:
        sounds, seconds = timed_sounds(with_published(chain), study, _TIMED)
        return Trial(chain, (samples_cost(study, len(sounds), seconds),))
