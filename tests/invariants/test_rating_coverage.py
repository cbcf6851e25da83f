"""Rating levels of synthetic units: intervals hold the truth, probabilities are calibrated.

A unit has a tone, noise of its sources and unmodelled noise, and a loss to the window. Its
published level is its own with an error of 2 dB. One prior ensemble serves all units; the weights
are those of the package.
"""

import numpy as np
import pytest
from scipy.stats import binom

from vibroacoustics.base.quantiles import weighted_quantiles
from vibroacoustics.levels.agreement import LEVELS_DB, Datum, Prior, log_weights
from vibroacoustics.levels.rating import rating_levels
from vibroacoustics.study.rating import Rating

UNITS, SAMPLES, DEVIATION_DB = 400, 1500, 2.0
RATING = Rating.model_validate(
    {
        "windows": {
            "bedroom": {"receiver": "window", "area": "general-residential", "operating_s": 2400.0}
        }
    }
)
FLAT = Prior("flat", "made up", lambda level: np.where(abs(level + 8.0) <= 8.0, 1.0, 0.0))
BANDS = np.array([0.3, 0.7])
"""Shares of two bands in the unmodelled noise."""


def parts(count, random):
    """Tone and noise of the sources at the published microphone, and loss to the window, dB."""
    tone, noise = random.normal(46.0, 5.0, count), random.normal(49.0, 4.0, count)
    return tone, noise, random.normal(14.0, 1.5, count)


def rated(tone, noise, loss, unmodelled):
    """Rating level and whether it meets the limit, by level, audibility and time."""
    around = 10.0 * np.log10(10.0 ** (noise / 10.0) + 10.0 ** (unmodelled / 10.0))
    level = 10.0 * np.log10(10.0 ** (tone / 10.0) + 10.0 ** (around / 10.0)) - loss
    found = rating_levels(RATING, ["window"], level[..., None], (tone - around + 6.0)[..., None])
    return found["rating_level"][..., 0], found["limit_probability"][..., 0]


def published(tone, noise, unmodelled):
    return 10.0 * np.log10(sum(10.0 ** (part / 10.0) for part in (tone, noise, unmodelled)))


@pytest.mark.long
def test_rating_levels_of_400_units():
    random = np.random.default_rng(17)
    prior = parts(SAMPLES, random)
    modelled = 4e-10 * np.stack([10.0 ** (part / 10.0) for part in prior[:2]], axis=1)
    inside, shares, met = 0, [], []
    for _ in range(UNITS):
        truth = [part[0] for part in parts(1, random)]
        grid = LEVELS_DB[FLAT.density(LEVELS_DB) > 0.0]
        rest = 55.0 + random.choice(grid)
        level = published(*truth[:2], rest) + random.normal(0.0, DEVIATION_DB)
        datum = Datum(
            "level", level, DEVIATION_DB, lambda bands: 10.0 * np.log10(bands.sum(-1) / 4e-10)
        )
        weights = log_weights(modelled, 4e-10 * 10.0**5.5 * BANDS, [datum], FLAT)
        weight = np.exp(weights - weights.max())
        columns = [part[:, None] + np.zeros(LEVELS_DB.size) for part in prior]
        values, meets = rated(*columns, 55.0 + LEVELS_DB + np.zeros_like(columns[0]))
        low, high = weighted_quantiles(values.ravel(), weight.ravel() / weight.sum(), (0.1, 0.9))
        own, own_meets = rated(*(np.array([part]) for part in truth), np.array([rest]))
        inside += low <= own[0] <= high
        shares.append((meets * weight).sum() / weight.sum())
        met.append(own_meets[0])
    print(f"\ninside {inside / UNITS:.3f}")
    assert 0.75 <= inside / UNITS <= 0.85
    shares, met = np.array(shares), np.array(met)
    number = np.minimum((shares * 10).astype(int), 9)
    for one in range(10):
        chosen = number == one
        count, mean = int(chosen.sum()), float(shares[chosen].mean()) if chosen.any() else 0.0
        low, high = binom.interval(0.995, count, mean) if count else (0, 0)
        print(f"bin {one}: {count} units, expected {mean * count:.1f}, met {met[chosen].sum():.0f}")
        assert low <= met[chosen].sum() <= high
