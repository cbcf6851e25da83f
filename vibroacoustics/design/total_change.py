"""Changes of the total level over a design space in words, and the values promised of a design."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from ..base.arrays import Array
from ..base.quantiles import weighted_quantiles
from ..results.estimates import QUANTILES
from .problem import Problem
from .wanted import CONFIDENCE, more_is_better

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


LOWERING_DB: Final = 3.0
"""Change of the total that an engineer looks for."""


def total_changes(problem: Problem, designs: Array) -> Array | None:
    """Compute how designs change each total among the objectives, dB.

    Parameters
    ----------
    problem : problem that was searched
    designs : shape (design, variable), SI

    Returns
    -------
    shape (total, design, 2): the median, and the change that a share `CONFIDENCE` of the samples
    stays below; None where no objective is a total
    """
    changes = [other.evaluate(designs).values for other in problem.total_changes()]
    return np.array(changes) if changes else None


def no_change_words(problem: Problem, changes: Array | None) -> str:
    """Return what is said where no design changes a total measurably; empty where one does.

    Parameters
    ----------
    problem : problem that was searched
    changes : changes of each total, dB, see `total_changes`
    """
    least = problem.study.scoring.measurable.level_db
    if changes is None:
        return ""
    every = np.nan_to_num(changes[..., 0].ravel())
    largest = float(every[np.argmax(np.abs(every))])
    if abs(largest) >= least:
        return ""
    return (
        f"nothing in this space changes the total by {least:g} dB "
        f"(largest change found: {largest:.2g} dB)"
    )


def lowering_words(problem: Problem, designs: Array, changes: Array | None) -> str:
    """Return which design is the first that lowers the total by `LOWERING_DB`, or that none does.

    Parameters
    ----------
    problem : problem that was searched
    designs : shape (design, variable), SI, in their order
    changes : changes of each total, dB, see `total_changes`
    """
    if changes is None:
        return ""
    share = f"{100.0 * CONFIDENCE:g} %"
    sure = f"with {share} confidence" if problem.is_sampled else f"in {share} of nominal pieces"
    with_nan = np.where(np.isfinite(changes[0]), changes[0], np.inf)
    enough = np.flatnonzero(with_nan[:, 1] <= -LOWERING_DB)
    if enough.size:
        first = int(enough[0])
        values = problem.space.written(designs[first])
        words = ", ".join(f"{key} = {value:g}" if isinstance(value, float) else f"{key} = {value}"
                          for key, value in values.items())  # fmt: skip
        option = problem.space.option_of(designs[first])
        return (
            f"option {option} with {words} is the first design that lowers the total by "
            f"{LOWERING_DB:g} dB(A) {sure}: median {with_nan[first, 0]:+.1f} dB"
        )
    median, confident = with_nan[int(np.argmin(with_nan[:, 0]))]
    return (
        f"none of {len(designs)} designs lowers the total by {LOWERING_DB:g} dB(A) {sure}; "
        f"the lowest change found is {median:+.2g} dB in the median, {confident:+.2g} dB or lower "
        f"{sure}"
    )
