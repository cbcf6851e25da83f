"""SI units of channels, and the factors that take samples to them."""

from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np

from ..base.arrays import Array
from ..base.errors import ParameterError
from .quantities import Quantity, quantity

FACTORS: Final = (1e-15, 1e15)
"""Sizes of calibration factors: squares of samples stay numbers."""


def si_scale(
    names: Sequence[str], units: Sequence[str], calibration: Mapping[str, float]
) -> tuple[list[str], list[float]]:
    """SI unit of each channel, and the factor that takes its samples to it."""
    measured = [_quantity(name, unit) for name, unit in zip(names, units, strict=True)]
    factors = [
        _calibration(name, calibration) * kind.factor
        for name, kind in zip(names, measured, strict=True)
    ]
    return [kind.unit for kind in measured], factors


def scale_in_place(signal: Array, names: Sequence[str], factors: Sequence[float]) -> None:
    """Multiply the samples of each channel, shape (channel, time), by its factor."""
    for name, factor, samples in zip(names, factors, signal, strict=True):
        with np.errstate(over="ignore"):  # told in the next line
            np.multiply(samples, factor, out=samples)
        check_finite(name, samples)


def _quantity(name: str, unit: str) -> Quantity:
    try:
        return quantity(unit)
    except ParameterError as error:
        raise ParameterError(f"channel {name!r}: {error}") from None


def _calibration(name: str, calibration: Mapping[str, float]) -> float:
    factor = float(calibration.get(name, 1.0))
    if not FACTORS[0] <= abs(factor) <= FACTORS[1]:
        raise ParameterError(
            f"channel {name!r}: calibration factor {factor:g}: must not be zero, but "
            f"{FACTORS[0]:g} to {FACTORS[1]:g} in size"
        )
    return factor


def check_finite(name: str, samples: Array) -> None:
    """Refuse samples of a channel that are not finite.

    Raises
    ------
    ParameterError
        Says how many there are and which is the first.
    """
    wrong = np.flatnonzero(~np.isfinite(samples))
    if wrong.size:
        raise ParameterError(
            f"channel {name!r}: {wrong.size} of {samples.size} samples are not finite, the first "
            f"is sample {wrong[0] + 1} ({samples[wrong[0]]})"
        )
