"""Counts of a converter that stand for values of a unit by a factor that the file lacks."""

from collections.abc import Mapping
from typing import Any, Final

import numpy as np

from .quantities import find_quantity
from .recorded import Samples

FACTOR_NAMES: Final = (
    "conversion", "conversion_factor", "calibration", "calibration_factor", "cal_factor", "factor",
    "gain", "scale", "scaling", "scale_factor", "sensitivity", "slope", "lsb", "multiplier",
)  # fmt: skip
"""Names of factors that programs give; blanks and capitals do not count."""
_COUNTED: Final = ("rpm", "rad/s", "rad", "1")
"""SI units of channels that may count whole numbers."""


def is_factor(name: str) -> bool:
    """Whether an attribute of this name is a factor of a channel."""
    return name.strip().lower().replace(" ", "_") in FACTOR_NAMES


def count_words(unit: str, samples: Samples, attributes: Mapping[str, Any]) -> str:
    """Words on whole numbers of a unit without a factor; empty where they may be values.

    Parameters
    ----------
    unit : unit that the file states
    samples : stored samples, shape (time,)
    attributes : attributes of the channel, among which the factor may have another name
    """
    quantity = find_quantity(unit) if unit else None
    if samples.dtype.kind not in "iu" or quantity is None or quantity.unit in _COUNTED:
        return ""
    words = f"samples are whole numbers of {8 * samples.dtype.itemsize} bits with the unit {unit!r}"
    for name, value in attributes.items():
        if is_factor(name):
            number = np.asarray(value).ravel()
            if number.size == 1 and number.dtype.kind in "iuf":
                return f"{words}; {name} = {float(number[0]):g} may be their factor"
    return f"{words} and without a factor"
