"""Criteria, scores, ranks and how sure they are, whatever the weights and the samples."""

from ..results.utility import utilities
from .acceptability import any_weights, rank_acceptability
from .scores import METHODS, given_values, published_table, score, topsis, weighted_sum
from .study_scores import study_scores
from .text import ranking_text

__all__ = [
    "METHODS",
    "any_weights",
    "given_values",
    "published_table",
    "rank_acceptability",
    "ranking_text",
    "score",
    "study_scores",
    "topsis",
    "utilities",
    "weighted_sum",
]
