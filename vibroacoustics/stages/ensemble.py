"""Samples of the ranges, weighted by the published level or a measured baseline."""

from typing import Final

from ..base.registry import register
from ..levels.nominal import NominalSound, Sound
from ..machine.cases import Cases
from ..study.sampling import Sample
from ..study.study import Study
from ..transfer.contributions import Transmission
from ..transfer.path import ShellPath
from ..transfer.study_path import projection_errors
from ..uncertainty.cost import ensemble_cost
from ..uncertainty.every_sample import errors_of_projection
from ..uncertainty.evidence import Evidence
from ..uncertainty.hammer_test import HammerTest
from ..uncertainty.posterior import posterior
from ..uncertainty.prior_ensemble import PriorEnsemble
from .chain import Chain
from .forces import PublishedCases, with_published
from .radiation import Radiated
from .sampled import sounds_of, timed_sounds
from .stage import Given, Stage, Trial

_WEIGHTED: Final = "samples at the published level"
_TIMED: Final = 12
"""Number of samples that are timed."""


@register
class PosteriorEnsemble(Stage):
    """Samples of the ranges, weighted by the published level or a measured baseline."""

    name = "ensemble"
    reads = (Cases, PublishedCases, Transmission, NominalSound, ShellPath, HammerTest)
    gives = (
        PriorEnsemble, Evidence, "prior_sample_*", "datum_*", "conflict_tail", "model_level",
        "spectrum_*", "level_share*", "projection_error", "shell_likelihood", "shell_gain",
        "shell_*_ratio", "shell_value", "shell_level_before", "shell_weight", "shell_peak_loss",
    )  # fmt: skip

    def applies(self, study: Study) -> bool:
        return bool(study.ranges)

    def run(self, chain: Chain) -> Given:
        study, shell, weighing = chain.study, chain.get(ShellPath), _weighing(chain)
        evidence = Evidence(weighing[NominalSound])

        def sounds_at_evidence(batch: list[Sample], before: int, expected: int) -> list[Sound]:
            return sounds_of(
                weighing, batch, lambda done: chain.progress(_WEIGHTED, before + done, expected)
            )

        test = chain.get(HammerTest)
        ensemble, results = posterior(evidence, sounds_at_evidence, test, chain.progress)
        chain.progress(_WEIGHTED, len(ensemble.samples), len(ensemble.samples))
        errors = {} if shell is None else projection_errors(study, shell, chain.progress)
        results = results.merge(errors_of_projection(study.ranges, errors))
        return Given(results, (ensemble, evidence))

    def tried(self, chain: Chain, study: Study) -> Trial:
        weighing, was_cached = _weighing(chain), chain[Radiated].was_cached
        sounds, seconds = timed_sounds(weighing, study, _TIMED)
        cost = ensemble_cost(Evidence(weighing[NominalSound]), sounds, seconds, was_cached)
        return Trial(chain, (cost,))


def _weighing(chain: Chain) -> Chain:
    """The chain at the receivers and cases alone that weigh the samples."""
    nominal = chain[NominalSound]
    weighing = nominal.weighing()
    rows = [nominal.axes.receivers.index(name) for name in weighing.axes.receivers]
    cases = with_published(chain)[Cases].some(weighing.sound)
    return chain.having(cases, chain[Transmission].to(rows), weighing)
