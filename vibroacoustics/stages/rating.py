"""Rating level at the windows of a study."""

from ..base.registry import register
from ..levels.rating import rating_variables
from ..study.study import Study
from .chain import Chain
from .stage import Given, Stage


@register
class RatingAtWindows(Stage):
    """Rating level at windows, the limits, and whether they are met."""

    name = "rating"
    reads = ("level_total", "decisive_audibility")
    gives = ("rating_level", "rating_adjustment", "rating_limit", "limit_probability")

    def applies(self, study: Study) -> bool:
        return study.rating is not None

    def run(self, chain: Chain) -> Given:
        rating = chain.study.rating
        return Given() if rating is None else Given(rating_variables(rating, chain.results))
