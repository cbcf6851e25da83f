"""Prior-data conflict: how far published data are from what the model expects before them.

Without discrepancy (Box 1980, J. R. Stat. Soc. A 143, 383; Evans and Moshonov 2006, Bayesian
Analysis 1, 893).
"""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr
from scipy.special import ndtr

from ..base.arrays import Array
from ..base.quantiles import INTERVAL, weighted_quantiles
from ..base.vocabulary import stamped
from ..levels.agreement import Datum

_MOST: Final = 1000
"""Number of samples of the prior predictive of all data together."""


def conflict_variables(
    data: Sequence[Datum], expected: Array, weight: Array, generator: np.random.Generator
) -> xr.Dataset:
    """Label the data, what is expected of them, and the tails of the prior predictive.

    Parameters
    ----------
    data : published and measured ones
    expected : expected data of each sample with a solution, shape (datum, sample)
    weight : weights of the samples before the data, shape (sample,)
    generator : generator of random numbers
    """
    values, deviations = (
        np.array([getattr(datum, name) for datum in data]) for name in ("value", "deviation")
    )
    share = weight / weight.sum()
    below = ndtr((values[:, None] - expected) / deviations[:, None]) @ share
    labelled = {
        "datum_value": values,
        "datum_deviation": deviations,
        "datum_expected": [weighted_quantiles(row, weight, INTERVAL) for row in expected],
        "datum_tail": np.minimum(below, 1.0 - below),
        "conflict_tail": _tail_of_all(
            expected / deviations[:, None], values / deviations, share, generator
        ),
    }
    names = {"datum": [datum.name for datum in data], "datum_quantile": list(INTERVAL)}
    return stamped(labelled, names)


def _tail_of_all(
    expected: Array, values: Array, share: Array, generator: np.random.Generator
) -> float:
    """Probability that the density of the prior predictive is at most that at the data.

    Parameters
    ----------
    expected : relative to the deviations, shape (datum, sample)
    values : values of the data, relative to the deviations, shape (datum,)
    share : weights that sum to one, shape (sample,)
    generator : generator of random numbers
    """
    picked = generator.choice(share.size, _MOST, p=share)
    predicted = expected[:, picked] + generator.standard_normal((len(expected), _MOST))
    points = np.column_stack([predicted, values])
    square = sum((point[:, None] - row) ** 2 for point, row in zip(points, expected, strict=True))
    density = np.exp(-0.5 * np.asarray(square)) @ share
    return float((density[:-1] <= density[-1]).mean())
