"""Designs as numbers that a search may change freely."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..base.arrays import Array
from .evaluation import Evaluate
from .search.problem import SearchProblem
from .variable import Variable


@dataclass(frozen=True)
class Coding:
    """Designs as numbers that a search may change freely.

    Attributes
    ----------
    variables : design variables in the order of the columns
    """

    variables: Sequence[Variable]

    def problem(self, evaluate: Evaluate) -> SearchProblem:
        """Return the problem of a search; `evaluate` takes designs in SI."""
        ends = [
            variable.limits if variable.values is None else (0.0, variable.values.size - 1.0)
            for variable in self.variables
        ]
        lower, upper = np.array(ends, dtype=float).T
        integer = np.array([variable.values is not None for variable in self.variables])
        return SearchProblem(lower, upper, integer, lambda codes: evaluate(self.designs(codes)))

    def designs(self, codes: Array) -> Array:
        """Designs in SI, shape (design, variable); a further column, of numbered runs, stays."""
        columns = [
            column if variable.values is None else variable.values[column.astype(int)]
            for variable, column in zip(self.variables, codes.T, strict=False)
        ]
        return np.column_stack([*columns, codes[:, len(columns) :]])
