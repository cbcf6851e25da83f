"""Random errors of measured functions: from repeats, from coherence, or as stated."""

from typing import Final

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..base.errors import ParameterError

RANDOM_STATE: Final = 19
"""Draws are the same in every run."""


def error_of_repeats(repeats: ComplexArray) -> Array:
    """RMS of the complex error of a mean of repeats, shape (frequency,).

    Parameters
    ----------
    repeats : at least two, shape (repeat, frequency)
    """
    deviations = repeats - repeats.mean(axis=0)
    count = len(repeats)
    return np.asarray(np.sqrt(np.sum(np.abs(deviations) ** 2, axis=0) / (count - 1) / count))


def error_of_coherence(values: ComplexArray, coherence: Array, averages: int) -> Array:
    """RMS of the complex random error of a frequency response, shape (frequency,).

    √2 times that of its magnitude, |H| √((1 - γ²) / (2 γ² n)): Bendat and Piersol, Random Data,
    4th edition, section 9.2.3. It holds no bias, such as that of a line wider than a resonance.

    Parameters
    ----------
    values : shape (frequency,)
    coherence : γ², above 0 up to 1, shape (frequency,)
    averages : n, independent

    Raises
    ------
    ParameterError
        A coherence is outside its range.
    """
    outside = (coherence <= 0.0) | (coherence > 1.0 + 1e-6)
    if np.any(outside):
        raise ParameterError(f"coherence {coherence[outside][0]:g}: must be above 0 up to 1")
    noise = np.maximum(1.0 - coherence, 0.0)
    return np.asarray(np.abs(values) * np.sqrt(noise / (coherence * averages)))


def measured_again(values: ComplexArray, error: Array, count: int) -> list[ComplexArray]:
    """Functions with errors drawn anew, of the size that their own have.

    Parameters
    ----------
    values, error : estimates and the RMS of their complex error, any shape
    count : number of samples
    """
    random = np.random.default_rng(RANDOM_STATE)
    shape = values.shape
    return [
        values
        + error
        * (random.standard_normal(shape) + 1j * random.standard_normal(shape))
        / np.sqrt(2.0)
        for _ in range(count)
    ]
