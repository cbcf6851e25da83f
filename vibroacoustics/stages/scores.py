"""Criteria, scores and ranks of the options, and results beside published values."""

from ..base.plain_bytes import canonical_json
from ..base.registry import register
from ..scoring import study_scores
from ..uncertainty.validation import validation_variables
from .chain import Chain
from .stage import EVERYTHING, Given, Stage


@register
class Scores(Stage):
    """Criteria of the options, scores by each method, ranks and how sure they are."""

    name = "scores"
    reads = (EVERYTHING,)
    gives = (
        "criterion_value", "criterion_best", "criterion_worst", "given_value", "weight", "score",
        "rank", "first_place_share", "rank_acceptability", "published_score", "published_sum",
        "recomputed_sum",
    )  # fmt: skip

    def run(self, chain: Chain) -> Given:
        return Given(study_scores(chain.study, chain.results))


@register
class Validation(Stage):
    """Error and uncertainty of results of which a value is published."""

    name = "validation"
    reads = (
        "level_modelled", "level_modelled_nominal", "force_order", "prior_sample_*", "shell_weight",
        "transfer_vector", "transfer_vector_error", "pattern_transfer_vector*",
    )  # fmt: skip
    gives = ("evidence_*",)

    def run(self, chain: Chain) -> Given:
        parameters = canonical_json(chain.study.parameters())
        return Given(validation_variables(chain.results.assign_attrs(parameters=parameters)))
