"""Criteria, scores, ranks and how robust the ranks are against the choice of weights."""

from .given import given_values
from .published import published_table
from .ranking import METHODS, first_place_share, topsis, utilities, weighted_sum
from .scores import score
from .study_scores import study_scores
from .text import ranking_text

__all__ = [
    "METHODS",
    "first_place_share",
    "given_values",
    "published_table",
    "ranking_text",
    "score",
    "study_scores",
    "topsis",
    "utilities",
    "weighted_sum",
]
