"""Bands of amplitudes and levels that random errors of measurements leave."""

from collections.abc import Callable, Sequence
from typing import Final

import numpy as np
from scipy.special import chndtr, chndtrinc

from ..base.arrays import Array, ComplexArray
from ..base.decibel import sound_pressure_level

SHARE: Final = 0.9
"""Probability of a band."""
TRIED: Final = (0.0, 0.005, 0.01, 0.02, 0.05, 0.1)
"""Truncations of which one is chosen."""
_GOOD_ENOUGH: Final = 1.01
"""The least truncation is taken whose error is within this factor of the least error."""


def amplitude_band(estimate: ComplexArray, sampled: ComplexArray) -> tuple[Array, Array]:
    """Limits of the 90 % confidence interval of an amplitude, 5 % to each side.

    The error of a response is, to first order in errors of measured complex values, complex
    normal and circular, so that the squared amplitude over half the variance is noncentral χ² of
    two degrees of freedom: its limits are those noncentralities that put the estimate at 95 % and
    at 5 % of the distribution. Quantiles of the sampled amplitudes themselves are too high
    where noise exceeds the response. The variance is that of the samples' median, |e|² / ln 2,
    which a few near-singular samples do not move. The estimate itself is always within.

    Parameters
    ----------
    estimate : complex, any shape
    sampled : estimates from sampled measurements, shape (sample, ...)

    Returns
    -------
    lower and upper limits, the shape of the estimate
    """
    variance = np.median(np.abs(sampled - estimate) ** 2, axis=0) / np.log(2.0)
    half = np.maximum(variance, np.finfo(float).tiny) / 2.0
    size = np.abs(estimate) ** 2 / half
    # far above the noise the normal distribution is the limit, and χ² loses its digits
    far = size > 1e6
    bounded = np.where(far, 1.0, size)
    limits = []
    for probability, normal in ((0.5 + SHARE / 2.0, -1.0), (0.5 - SHARE / 2.0, 1.0)):
        inner = chndtr(bounded, 2.0, 0.0) < probability
        power = np.where(inner, 0.0, chndtrinc(np.where(inner, 9.0, bounded), 2.0, probability))
        near = np.sqrt(power * half)
        limits.append(np.where(far, np.abs(estimate) + normal * 1.645 * np.sqrt(half), near))
    return np.minimum(limits[0], np.abs(estimate)), np.maximum(limits[1], np.abs(estimate))


def power_band(estimate: Array, sampled: Array) -> tuple[Array, Array]:
    """Band of a sum of powers, or of a ratio of such sums, not below zero.

    Quantiles of the samples, reflected at the estimate: samples lie above the estimate by the power
    of their noise, and the estimate lies as much above the truth. Basic bootstrap, Davison and
    Hinkley, Bootstrap Methods and their Application, section 5.2.1.

    Parameters
    ----------
    estimate : any shape
    sampled : samples, shape (sample, ...)
    """
    low, high = np.quantile(sampled, [0.5 - SHARE / 2.0, 0.5 + SHARE / 2.0], axis=0)
    return np.maximum(2.0 * estimate - high, 0.0), np.maximum(2.0 * estimate - low, 0.0)


def truncation_errors(
    of_measured: ComplexArray, of_samples: Sequence[Callable[[float], ComplexArray]]
) -> Array:
    """Mean error of a line's level for each of `TRIED`, dB, shape (truncation,).

    The measurements count as the truth, their samples as measured.

    Parameters
    ----------
    of_measured : predicted without truncation, shape (...)
    of_samples : functions of a truncation, each predicts from sampled measurements
    """
    level = sound_pressure_level(of_measured)
    return np.array(
        [
            np.mean(
                [
                    np.abs(sound_pressure_level(of_sample(share)) - level).mean()
                    for of_sample in of_samples
                ]
            )
            for share in TRIED
        ]
    )


def chosen_truncation(errors: Array) -> float:
    """The least truncation that does about as well as the best.

    Parameters
    ----------
    errors : errors of each of `TRIED`, shape (truncation,)
    """
    good = errors <= _GOOD_ENOUGH * errors.min()
    return TRIED[int(np.argmax(good))]
