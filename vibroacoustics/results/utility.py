"""Utility of options by criteria on fixed scales."""

import numpy as np

from ..base.arrays import Array


def utilities(values: Array, best: Array, worst: Array) -> Array:
    """Return the utility of each option and criterion: 1 at `best`, 0 at `worst`, linear between.

    The scale does not depend on the options at hand: adding one cannot reorder the others.
    """
    return np.clip((worst - values) / (worst - best), 0.0, 1.0)
