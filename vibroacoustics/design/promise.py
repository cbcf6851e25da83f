"""What a design promises of the pieces that are built: from samples that no search has seen."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from ..base.arrays import Array
from .problem import Problem, more_is_better
from .statistics import over

_SET: Final = 1
"""Of the samples that the promise is made of; the search has set 0."""
_DEVIATIONS: Final = 1.96


@dataclass(frozen=True)
class Promise:
    """Values of one design over fresh pieces, by objective and constraint, shape (wanted,).

    Attributes
    ----------
    meant : of the piece as meant, without a tolerance
    promised : the statistic over samples that the study asks for
    low, high : 95 % limits of the promised value, from the number of samples alone
    samples : number of pieces
    """

    meant: Array
    promised: Array
    low: Array
    high: Array
    samples: int


def promise(problem: Problem, design: Array, count: int, number: int = _SET) -> Promise:
    """What a design promises.

    Parameters
    ----------
    problem : that it belongs to
    design : shape (variable,), SI
    count : of samples
    number : of the set of samples
    """
    samples = problem.samples(count, number)
    by_sample = problem.by_sample(design[None], samples)[0]
    as_meant = problem.by_sample(design[None], np.full((1, samples.shape[1]), 0.5))[0, 0]
    columns = []
    for values, wanted in zip(by_sample.T, problem.wanted.values(), strict=True):
        upwards = more_is_better(wanted)
        value = over(values, 0, wanted.samples, upwards)
        low, high = _limits(values, wanted.samples, upwards)
        columns.append((float(value), low, high))
    promised, low, high = np.array(columns).T
    return Promise(as_meant, promised, low, high, len(samples))


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
