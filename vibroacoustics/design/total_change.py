"""Changes of the total level over a design space, in words."""

from typing import Final

import numpy as np

from ..base.arrays import Array
from .problem import Problem
from .wanted import CONFIDENCE

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
