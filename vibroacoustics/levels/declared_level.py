"""Published and measured levels of a machine, and the upper limit of a declared one (ISO 4871)."""

from typing import Final, NamedTuple

import numpy as np
from scipy.special import ndtr

from ..base.arrays import Array
from ..base.quantiles import weighted_quantiles
from ..study.study import Study
from .agreement import ALL_ALIKE, Datum, Prior, data_of, priors_of
from .spectrum_data import SpectrumData, spectrum_data


class Published(NamedTuple):
    """Data of the machine, as they weigh samples.

    Attributes
    ----------
    level_dba : that of the machine by the published one; zero without, to which levels then are
        relative
    data : empty without a published level
    priors : priors of the unmodelled noise; the first one is that of all intervals
    spectrum : measured third octaves; None without any
    """

    level_dba: float
    data: tuple[Datum, ...]
    priors: tuple[Prior, ...]
    spectrum: SpectrumData | None = None


def published_of(study: Study) -> Published:
    """Return the published data of a study's machine."""
    noise = study.machine.overall_noise
    priors = priors_of(study.machine.remainder) if noise or study.baseline else (ALL_ALIKE,)
    level_dba = 0.0 if noise is None else noise.likely_level_dba
    return Published(level_dba, data_of(noise), priors, spectrum_data(study))


MEASUREMENT_DEVIATION_DB: Final = 1.5
"""Standard deviation of reproducibility of A-weighted levels by ISO 3744, grade 2."""
SHARE: Final = 0.95
"""Share of measured machines below L_WA + K_WA."""
_REACH: Final = 8.0
"""Standard deviations from the samples to the ends of the search."""
_STEPS: Final = 60
"""Halvings of the search: below rounding errors."""


def combined_deviation_db(batch_deviation_db: float | None) -> float:
    """Return the standard deviation of what a measured machine adds to the level of the design, dB.

    Measurement and production are independent: σ² = σ_R² + σ_P².

    Parameters
    ----------
    batch_deviation_db : σ_P, scatter of the machines of a batch; none of a single machine
    """
    return float(np.hypot(MEASUREMENT_DEVIATION_DB, batch_deviation_db or 0.0))


def upper_limit_db(level_db: Array, weight: Array, deviation_db: float) -> float:
    """Return the level that machine and measurement stay below with a probability of 95 %, dB.

    A measured level is X = L + E. The weighted samples give the distribution of the level L of the
    machine, with the uncertainty of the model in it. E is normal with mean 0 and deviation σ, of
    measurement and production, and does not depend on L. So

        P(X ≤ x) = Σ w_i Φ((x - L_i)/σ).

    The limit x is where this is 0.95, or the 95 % quantile of L where that is higher, which is
    possible in samples with two clusters. So both the machine and its measurement stay below x
    with a probability of at least 95 %. With K = x - L_WA and L_WA the median of L:

    - samples that do not differ give K = 1.645 σ, the formula of ISO 4871 for a single machine;
    - samples with normal levels of deviation s give K = 1.645 (s² + σ²)^½;
    - skewed samples count by their own upper tail, whatever their lower one is.

    ISO 4871 writes 1.5 σ + 0.564 (2.5 dB - σ) for a batch of which samples are tested; here
    x holds for every machine of the batch, so that the formula of the single machine stays.

    Parameters
    ----------
    level_db : sound power level in each sample, shape (sample,)
    weight : weight of the samples, of sum one, shape (sample,)
    deviation_db : σ
    """
    level, of_level = level_db[weight > 0.0], weight[weight > 0.0]
    reach = _REACH * deviation_db
    low, high = float(level.min()) - reach, float(level.max()) + reach
    for _ in range(_STEPS):
        middle = 0.5 * (low + high)
        below = float(of_level @ ndtr((middle - level) / deviation_db))
        low, high = (middle, high) if below < SHARE else (low, middle)
    return max(high, float(weighted_quantiles(level_db, weight, (SHARE,))[0]))
