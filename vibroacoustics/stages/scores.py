"""Criteria, scores and ranks of the options."""

from ..base.registry import register
from ..scoring import study_scores
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
