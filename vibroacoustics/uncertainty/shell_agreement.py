"""Agreement of a sample's shell with hammer tests: in gain, natural frequencies and loss."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from ..base.arrays import Array
from .shell_features import Features

MOST_DEVIATIONS: Final = 4.0
"""A peak that lies further off counts as this many tolerances, as one that is not there."""
LARGEST_MISFIT: Final = 1000.0
"""Bound that keeps a likelihood above zero, so that weights without it can be computed."""


@dataclass(frozen=True)
class Tolerances:
    """Standard deviations of what is compared: of the model more than of the test.

    Attributes
    ----------
    gain_db : tolerance of the mean level of mobilities in a third octave, dB
    frequency_ratio : tolerance of a natural frequency, as a ratio
    loss_ratio : tolerance of a loss factor, as a ratio
    """

    gain_db: float
    frequency_ratio: float
    loss_ratio: float


@dataclass(frozen=True)
class ShellAgreement:
    """A sample beside the test.

    Attributes
    ----------
    likelihood : from 0 to 1
    gain_db : mean level over that measured
    frequency_ratio : median of the natural frequencies over those measured
    loss_ratio : median of the loss factors over those measured; not a number without a peak
    """

    likelihood: float
    gain_db: float
    frequency_ratio: float
    loss_ratio: float


def shell_agreement(
    measured: Features, sampled: Features, tolerances: Tolerances
) -> ShellAgreement:
    """Likelihood exp(-(a + b + c)/2) of mean squared deviations in tolerances.

    a of the levels of all bands, b of the natural frequencies, each against the
    nearest clear peak of the sample, c of the loss factors of the peaks that so meet. The mean, not
    the sum: what a model of one shell makes wrong is alike in all its bands and peaks, so that each
    of the three counts as one measurement however many lines there are (composite likelihood:
    Varin, Reid and Firth 2011, Statistica Sinica 21, 5, section 2.3).

    Parameters
    ----------
    measured, sampled : features of the same mobilities at the same lines
    tolerances : tolerances of each kind of feature
    """
    levels = sampled.level_db - measured.level_db
    misfit = float(np.mean((levels / tolerances.gain_db) ** 2))
    frequency, loss = _of_peaks(measured, sampled)
    if measured.peak_hz.size:
        off = np.log(frequency) / np.log1p(tolerances.frequency_ratio)
        misfit += float(np.mean(np.minimum(np.abs(off), MOST_DEVIATIONS) ** 2))
        meets = np.abs(off) < MOST_DEVIATIONS
        lossy = np.log(loss) / np.log1p(tolerances.loss_ratio)
        misfit += float(np.mean(lossy[meets] ** 2)) if np.any(meets) else MOST_DEVIATIONS**2
    return ShellAgreement(
        float(np.exp(-0.5 * min(misfit, LARGEST_MISFIT))),
        float(levels.mean()),
        float(np.median(frequency)) if frequency.size else float("nan"),
        float(np.median(loss)) if loss.size else float("nan"),
    )


def _of_peaks(measured: Features, sampled: Features) -> tuple[Array, Array]:
    """Natural frequency and loss factor of the nearest peak over those measured, each (peak,)."""
    if not sampled.peak_hz.size:
        nothing = np.full(measured.peak_hz.size, np.inf)
        return nothing, np.ones_like(nothing)
    ratio = sampled.peak_hz / measured.peak_hz[:, None]
    nearest = np.argmin(np.abs(np.log(ratio)), axis=1)
    rows = np.arange(len(ratio))
    return ratio[rows, nearest], sampled.loss_ratio[nearest] / measured.loss_ratio
