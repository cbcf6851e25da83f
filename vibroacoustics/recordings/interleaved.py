"""Columns of a table that a program wrote one number after the other, as one channel."""

from typing import Final

import numpy as np

from ..base.arrays import Array

_MOST_COLUMNS: Final = 4
_RATIO: Final = 0.1
"""Mean square of differences over k samples to that of neighbours. One sine is below it within
0.05 of the sample rate of its k-th part, sin² πkf / sin² πf. Assumed, 0.03 to 0.15."""
_LIVELY: Final = 0.05
"""Least share of the variance within columns: a tone of k samples a period has none."""
_COMMON: Final = 0.02
"""Least share of the variance that columns have in common, by which three or four are recognised: a
tone near a third or fourth of the sample rate has less. Assumed, 0.01 to 0.05."""
_LEAST_SAMPLES: Final = 64


def interleaved_columns(samples: Array) -> int:
    """Number of columns that samples seem to have one after the other; 1 for a plain channel.

    Parameters
    ----------
    samples : shape (time,)
    """
    if samples.size < _LEAST_SAMPLES:
        return 1
    values = samples - np.mean(samples)
    variance, neighbours = float(np.var(values)), float(np.mean(np.diff(values) ** 2))
    for columns in range(2, _MOST_COLUMNS + 1):
        apart = float(np.mean((values[columns:] - values[:-columns]) ** 2))
        if not apart < _RATIO * neighbours:
            continue
        table = values[: values.size // columns * columns].reshape(-1, columns)
        is_lively = float(np.mean(np.var(table, axis=0))) > _LIVELY * variance
        mean_varies = float(np.var(np.mean(table, axis=1))) > _COMMON * variance
        if is_lively and (columns == 2 or mean_varies):
            return columns
    return 1
