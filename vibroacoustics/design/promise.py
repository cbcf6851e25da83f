"""Promised values of a design over the pieces that are built, from samples no search has used."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from ..base.arrays import Array
from ..base.quantiles import weighted_quantiles
from ..results.estimates import QUANTILES
from .problem import Problem
from .wanted import more_is_better

_SET: Final = 1
"""Number of the set of samples from which the promise is computed; the search uses set 0."""
_DEVIATIONS: Final = 1.96


@dataclass(frozen=True)
class Promise:
    """Values of one design over fresh pieces, by objective and constraint, shape (wanted,).

    Attributes
    ----------
    meant : values of the piece as meant, without a tolerance
    promised : the statistic over samples that the study asks for
    low, high : ends of the 80 % interval over samples of the machine and pieces; of a nominal
        machine 95 % limits of the promised value, from the number of pieces alone
    samples : number of samples
    is_sampled : whether the samples are of the machine too
    """

    meant: Array
    promised: Array
    low: Array
    high: Array
    samples: int
    is_sampled: bool


def promise(problem: Problem, design: Array, count: int) -> Promise:
    """Estimate the promised values of a design.

    Parameters
    ----------
    problem : problem that it belongs to
    design : shape (variable,), SI
    count : number of samples
    """
    samples = problem.samples(count, _SET)
    as_meant = problem.evaluate(design[None], problem.pieces.as_meant).values[0]
    by_sample = problem.by_sample(design[None], samples)
    promised = problem.over_samples(by_sample, problem.weight(samples))[0]
    if problem.is_sampled:
        low, high = weighted_quantiles(by_sample[0], problem.weight(samples), QUANTILES)
    else:
        each = zip(by_sample[0].T, problem.wanted.values(), strict=True)
        ends = [
            _limits(column, problem.statistic(wanted), more_is_better(wanted))
            for column, wanted in each
        ]
        low, high = np.array(ends).T
    return Promise(as_meant, promised, low, high, by_sample.shape[1], problem.is_sampled)


def _limits(values: Array, statistic: str | float, upwards: bool) -> tuple[float, float]:
    """95 % limits: of a mean by its standard error, of a quantile by the order statistics."""
    count = len(values)
    if statistic == "mean":
        half = _DEVIATIONS * float(values.std()) / np.sqrt(count)
        return float(values.mean() - half), float(values.mean() + half)
    if statistic == "worst":  # of these pieces; of all that are built it may be worse
        worst = float(values.min() if upwards else values.max())
        return worst, worst
    share = 1.0 - float(statistic) if upwards else float(statistic)
    half = _DEVIATIONS * np.sqrt(share * (1.0 - share) / count)
    low, high = np.quantile(values, np.clip([share - half, share + half], 0.0, 1.0))
    return float(low), float(high)
