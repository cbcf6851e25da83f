"""Attenuation of sound in air."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .arrays import Array


def air_attenuation_per_m(
    frequency_hz: NDArray[np.floating[Any]],
    temperature_k: float = 293.15,
    humidity_ratio: float = 0.5,
) -> Array:
    """Attenuation of the intensity in air at 101.325 kPa, m in exp(-m x), 1/m.

    ISO 9613-1:1993, equations 3 to 6.

    Parameters
    ----------
    frequency_hz : any shape
    temperature_k, humidity_ratio : temperature and relative humidity
    """
    relative = temperature_k / 293.15
    triple = 273.16 / temperature_k
    molar = 100.0 * humidity_ratio * 10.0 ** (-6.8346 * triple**1.261 + 4.6151)
    oxygen = 24.0 + 4.04e4 * molar * (0.02 + molar) / (0.391 + molar)
    nitrogen = relative**-0.5 * (
        9.0 + 280.0 * molar * np.exp(-4.170 * (relative ** (-1.0 / 3.0) - 1.0))
    )
    squared = np.asarray(frequency_hz, dtype=float) ** 2
    relaxing = relative**-2.5 * (
        0.01275 * np.exp(-2239.1 / temperature_k) / (oxygen + squared / oxygen)
        + 0.1068 * np.exp(-3352.0 / temperature_k) / (nitrogen + squared / nitrogen)
    )
    # The standard counts decibels of the pressure; m is twice the nepers of the pressure.
    nepers: Array = squared * (1.84e-11 * relative**0.5 + relaxing)
    return 2.0 * nepers
