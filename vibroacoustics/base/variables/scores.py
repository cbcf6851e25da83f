"""Criteria, weights, scores and ranks, and a published table of them."""

from ..registry import register
from ..vocabulary import Coordinate, Variable

for _thing in (
    Coordinate("criterion", ("criterion",), "", "scoring criterion"),
    Coordinate("criterion_label", ("criterion",), "", "the criterion in plain words"),
    Coordinate("criterion_unit", ("criterion",), "", "unit of the criterion"),
    Coordinate("given_criterion", ("given_criterion",), "", "criterion whose values are given"),
    Coordinate("scoring_method", ("scoring_method",), "", "scoring method"),
    Coordinate("rank_position", ("rank_position",), "1", "rank, 1 is best"),
    Coordinate("criteria_weights", ("criteria_weights",), "", "which weights the criteria have"),
    Coordinate("published_option", ("published_option",), "", "option in the published table"),
    Coordinate("published_criterion", ("published_criterion",), "", "criterion in the table"),
    Variable("criterion_value", ("option", "criterion"), "", "criterion, unit in criterion_unit"),
    Variable(
        "given_value",
        ("option", "given_criterion"),
        "",
        "value that the study gives, not a number where none",
    ),
    Variable("weight", ("criterion",), "1", "weight of the criterion"),
    Variable("criterion_best", ("criterion",), "", "value that counts as best, utility 1"),
    Variable("criterion_worst", ("criterion",), "", "value that counts as worst, utility 0"),
    Variable("score", ("option", "scoring_method"), "1", "score, 0 worst to 1 best"),
    Variable("rank", ("option", "scoring_method"), "1", "rank, 1 is best"),
    Variable(
        "first_place_share",
        ("option",),
        "1",
        "probability of the first rank, whatever the weights, over the draws",
    ),
    Variable(
        "rank_acceptability",
        ("criteria_weights", "option", "rank_position"),
        "1",
        "probability of each rank, over the draws",
    ),
    Variable(
        "published_score",
        ("published_option", "published_criterion"),
        "1",
        "published score, as printed",
    ),
    Variable("published_sum", ("published_option",), "1", "published sum, as printed"),
    Variable("recomputed_sum", ("published_option",), "1", "sum of the published scores"),
):
    register(_thing)
