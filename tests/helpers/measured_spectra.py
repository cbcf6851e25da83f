"""Machines inferred from their level and third octaves, by a second implementation.

Level, octaves and shares of all samples are arrays; only the weights differ between machines.
"""

from dataclasses import dataclass

import numpy as np

from vibroacoustics.levels.by_source import GAIN_BANDS
from vibroacoustics.uncertainty.evidence import with_gain

REFERENCE_PA2 = 4e-10
DEVIATION_DB = 2.0
"""Of the level, and of every third octave."""
GRID_DB = np.arange(-26.0, 4.5, 1.0)
"""Flat prior of unmodelled noise, about the median of the modelled levels."""
MIDDLE_HZ = np.array([band.middle_hz for band in GAIN_BANDS])
OCTAVES_HZ = (125.0, 250.0, 500.0, 1000.0, 2000.0, 4000.0)
QUANTITIES = ("gas share", "keys share", "unmodelled share", "level")
PICKS = 4000


def measured_columns(lowest_hz=95.0, highest_hz=3300.0):
    """Third octaves 100 Hz to 3.15 kHz."""
    return np.flatnonzero((lowest_hz < MIDDLE_HZ) & (highest_hz > MIDDLE_HZ))


def by_octave(columns):
    """Columns of each octave, by the nearest middle on the logarithm of frequency."""
    nearest = np.abs(np.log(MIDDLE_HZ[columns][:, None] / OCTAVES_HZ)).argmin(axis=1)
    return [columns[nearest == octave] for octave in np.unique(nearest)]


def in_db(energy):
    return 10.0 * np.log10(energy / REFERENCE_PA2)


@dataclass(frozen=True)
class Machines:
    """Bands of samples with discrepancies, Pa².

    Attributes
    ----------
    modelled : shape (sample, discrepancy, band)
    gas, keys : energy alone, shape (sample, discrepancy)
    unmodelled : at the level 0 dB, shape (sample, discrepancy, band)
    """

    modelled: np.ndarray
    gas: np.ndarray
    keys: np.ndarray
    unmodelled: np.ndarray

    @classmethod
    def of(cls, sources, mutual, unmodelled, discrepancy_of):
        """Machines of mutual energies (sample, source, source, band) with discrepancies."""
        gas, keys = sources.index("gas"), sources.index("keys")
        rows = []
        for number, (of_sample, noise) in enumerate(zip(mutual, unmodelled, strict=True)):
            found = discrepancy_of(number)
            alone = [found.gain[:, s] @ of_sample[s, s] for s in (gas, keys)]
            rows.append((with_gain(of_sample, found.gain), *alone, found.unmodelled * noise))
        return cls(*map(np.array, zip(*rows, strict=True)))

    def bands(self, number, noise_db):
        """Bands of one machine with its first discrepancy."""
        return self.modelled[number, 0] + 10.0 ** (noise_db / 10.0) * self.unmodelled[number, 0]

    def quantities(self, number, noise_db):
        """`QUANTITIES` of one machine with its first discrepancy."""
        noise = 10.0 ** (noise_db / 10.0) * self.unmodelled[number, 0].sum()
        total = self.modelled[number, 0].sum() + noise
        return np.array(
            [self.gas[number, 0] / total, self.keys[number, 0] / total, noise / total, in_db(total)]
        )


class Inference:
    """Intervals of a machine from its level alone, and from level and spectrum."""

    def __init__(self, prior, columns):
        power = 10.0 ** (GRID_DB / 10.0)
        noise = prior.unmodelled.sum(axis=2)[..., None] * power
        total = prior.modelled.sum(axis=2)[..., None] + noise
        self.level_db, self.octaves = in_db(total).astype("f4"), by_octave(columns)
        self.octave_db = [
            in_db(
                prior.modelled[..., row].sum(axis=2)[..., None]
                + prior.unmodelled[..., row].sum(axis=2)[..., None] * power
            ).astype("f4")
            for row in self.octaves
        ]
        shares = (prior.gas[..., None] / total, prior.keys[..., None] / total, noise / total)
        self.values = [*(share.astype("f4") for share in shares), self.level_db]

    def log_weights(self, level_db, third_db=None):
        """Of samples, discrepancies and unmodelled levels; third octaves in `GAIN_BANDS`."""
        log_weight = -0.5 * ((self.level_db - level_db) / DEVIATION_DB) ** 2
        for row, predicted in zip(self.octaves, self.octave_db, strict=True):
            if third_db is not None:
                measured = 10.0 * np.log10((10.0 ** (third_db[row] / 10.0)).sum())
                log_weight -= 0.5 * ((predicted - measured) / DEVIATION_DB) ** 2
        return log_weight

    def interval(self, log_weight, start, without=None):
        """Ends of 80 % intervals (2, quantity), and the effective number of samples."""
        weight = np.exp(log_weight - log_weight.max(), dtype="f8")
        if without is not None:
            weight[without] = 0.0
        by_sample = weight.sum(axis=(1, 2))
        rising = np.cumsum(weight.ravel())
        picks = np.searchsorted(rising, (np.arange(PICKS) + start) / PICKS * rising[-1])
        picks = np.minimum(picks, rising.size - 1)
        values = [value.ravel()[picks] for value in self.values]
        effective = by_sample.sum() ** 2 / (by_sample**2).sum()
        return np.quantile(values, (0.1, 0.9), axis=1), effective


def settled(inference, machines, rng, leave_out=False):
    """Statistics of synthetic machines.

    Returns
    -------
    shares of truths inside with the level alone and with the spectrum, median widths of both,
    median ratios of widths, each by quantity, and 10 and 50 % quantiles of the effective samples
    """
    rows = []
    for number in range(len(machines.gas)):
        noise_db = rng.uniform(GRID_DB[0], GRID_DB[-1])
        truth = machines.quantities(number, noise_db)
        third_db = in_db(np.maximum(machines.bands(number, noise_db), 1e-20))
        third_db = third_db + rng.normal(0.0, DEVIATION_DB, third_db.size)
        level_db, without = truth[3] + rng.normal(0.0, DEVIATION_DB), number if leave_out else None
        alone, _ = inference.interval(inference.log_weights(level_db), rng.uniform(), without)
        both, effective = inference.interval(
            inference.log_weights(level_db, third_db), rng.uniform(), without
        )
        inside = [(low <= truth) & (truth <= high) for low, high in (alone, both)]
        widths = [high - low for low, high in (alone, both)]
        rows.append((inside, widths, widths[1] / widths[0], effective))
    inside, widths, ratio, effective = (np.array(part) for part in zip(*rows, strict=True))
    return (
        inside.mean(axis=0),
        np.median(widths, axis=0),
        np.median(ratio, axis=0),
        np.quantile(effective, (0.1, 0.5)),
    )
