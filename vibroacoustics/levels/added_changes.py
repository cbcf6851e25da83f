"""Changes of third octaves by several parameters, which add in dB band by band."""

import numpy as np

from ..base.arrays import Array
from ..base.decibel import energy_sum


def change_at(value: float, nodes: Array, change_db: Array) -> Array:
    """Interpolate the change of a level between nodes, linear in the value, shape (...), dB.

    Parameters
    ----------
    value : value of the parameter, between the first and the last node
    nodes : values at which the change is known, increasing, shape (node,)
    change_db : at the nodes, shape (node, ...)
    """
    upper = int(np.clip(np.searchsorted(nodes, value), 1, nodes.size - 1))
    share = (value - nodes[upper - 1]) / (nodes[upper] - nodes[upper - 1])
    return np.asarray((1.0 - share) * change_db[upper - 1] + share * change_db[upper])


def total_change(band_level_db: Array, change_db: Array) -> Array:
    """Compute the change of the total level from changes of its third octaves, shape (...), dB.

    Parameters
    ----------
    band_level_db : levels before the change, shape (..., band)
    change_db : sums of the changes by all parameters, shape (..., band)
    """
    after = energy_sum(band_level_db + change_db, axis=-1)
    return np.asarray(after - energy_sum(band_level_db, axis=-1))
