"""First screen with less evidence, another prior or other laws."""

from ..base.registry import register
from ..results.estimates import prior_ensemble
from ..study.study import Study
from ..uncertainty.alternative_sounds import ComputedSamples
from ..uncertainty.alternative_variables import alternative_variables
from ..uncertainty.evidence import Evidence
from ..uncertainty.prior_ensemble import PriorEnsemble
from .chain import Chain
from .stage import Given, Stage


@register
class Alternatives(Stage):
    """Level, shares and changes by options with other inputs, by reweighting the samples."""

    name = "alternatives"
    reads = (PriorEnsemble, Evidence, ComputedSamples, "prior_sample_*", "shell_weight")
    gives = ("alternative_*",)

    def applies(self, study: Study) -> bool:
        return bool(study.ranges) and study.baseline is None

    def run(self, chain: Chain) -> Given:
        ensemble, prior = chain[PriorEnsemble], prior_ensemble(chain.results)
        if prior is None or not ensemble.suffices:
            return Given()
        computed = chain.get(ComputedSamples) or ComputedSamples()
        return Given(alternative_variables(chain[Evidence], ensemble, prior.before, computed))
