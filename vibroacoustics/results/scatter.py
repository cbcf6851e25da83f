"""Scatter of levels over runs and specimens: energy mean, deviations, uncertainty of the mean."""

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np
from scipy.special import stdtrit

from ..base.arrays import Array
from ..base.decibel import energy_mean

COVERAGE: Final = 0.95
"""Probability that the interval holds the mean."""


class Scatter(NamedTuple):
    """Scatter of levels over several runs, shape (...) each; not a number where the runs do not
    show it.

    Attributes
    ----------
    mean : energy mean of the specimens' energy means, dB
    run_deviation : standard deviation between runs of one specimen, dB
    specimen_deviation : between specimens without what runs scatter; with it where each specimen
        ran once, dB
    uncertainty : standard uncertainty of the mean, dB
    interval : half width of the 95 % interval of the mean, dB
    """

    mean: Array
    run_deviation: Array
    specimen_deviation: Array
    uncertainty: Array
    interval: Array


def scatter(level_db: Array, specimens: Sequence[str]) -> Scatter:
    """Analysis of variance in one way, random effects (ISO 5725-2:2019, 7.4), every specimen alike.

    With n_i runs of k specimens, s_w² = Σ (n_i - 1) s_i² / Σ (n_i - 1) of the runs and s_m² of the
    specimens' mean levels, s_b² = s_m² - s_w² mean(1/n_i), at least 0. The mean's uncertainty is
    s_m/√k; of one specimen s_w/√n, which holds for that specimen alone. The 95 % interval is the
    mean ± t times that, with Student's t of k - 1 or n - 1 degrees of freedom.

    Parameters
    ----------
    level_db : shape (run, ...)
    specimens : specimen of each run
    """
    groups = _groups(level_db, specimens)
    count = np.array([len(group) for group in groups])
    nothing = np.full(level_db.shape[1:], np.nan)
    run = nothing
    if (count > 1).any():
        squares = [(len(g) - 1) * np.var(g, axis=0, ddof=1) for g in groups if len(g) > 1]
        run = np.sqrt(np.sum(squares, axis=0) / np.sum(count - 1))
    mean = energy_mean(np.array([energy_mean(group) for group in groups]))
    if len(groups) == 1:
        return Scatter(mean, run, nothing, *_of_mean(run, count[0]))
    of_means = np.var([group.mean(axis=0) for group in groups], axis=0, ddof=1)
    between = of_means - np.nan_to_num(run) ** 2 * np.mean(1.0 / count)
    specimen = np.sqrt(np.maximum(between, 0.0))
    return Scatter(mean, run, specimen, *_of_mean(np.sqrt(of_means), len(groups)))


def by_specimen(level_db: Array, specimens: Sequence[str]) -> tuple[Array, Array]:
    """Compute energy mean and standard deviation of the runs of each specimen, dB.

    Parameters
    ----------
    level_db : shape (run, ...)
    specimens : specimen of each run

    Returns
    -------
    both of shape (specimen, ...), in the order of the first runs; the deviation of a single run is
    not a number
    """
    groups = _groups(level_db, specimens)
    nothing = np.full(level_db.shape[1:], np.nan)
    deviations = [np.std(g, axis=0, ddof=1) if len(g) > 1 else nothing for g in groups]
    return np.array([energy_mean(group) for group in groups]), np.array(deviations)


def _groups(level_db: Array, specimens: Sequence[str]) -> list[Array]:
    """Levels (run, ...) of each specimen."""
    names = dict.fromkeys(specimens)
    return [level_db[[specimen == name for specimen in specimens]] for name in names]


def _of_mean(deviation: Array, count: int) -> tuple[Array, Array]:
    """Standard uncertainty and half width of the interval of a mean of so many values, dB."""
    uncertainty = deviation / np.sqrt(count)
    return uncertainty, stdtrit(count - 1, 0.5 + 0.5 * COVERAGE) * uncertainty
