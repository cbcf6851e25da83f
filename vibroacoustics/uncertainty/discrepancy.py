"""Model discrepancy: errors of the model that no range of a value covers.

The level of source s in third octave i deviates by

    D = d_path + d_s + e_s,i dB

with normal deviations of zero mean: one common to all sources, one of each source, and one of each
band with the correlation exp(-octaves). They are the same for all options, speeds and microphones
of a sample, so that most of them cancels in changes. What an option adds to the sound of a source
deviates by d_r besides (Kennedy and O'Hagan 2001, J. R. Stat. Soc. B 63, 425). Where a measured
spectrum weighs, bands of unmodelled noise deviate as e_s,i: its smooth shape is assumed.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Final

import numpy as np

from ..base.arrays import Array, IndexArray
from ..base.decibel import power_of_level
from ..base.vocabulary import REFERENCE_OPTION
from ..levels.by_source import GAIN_BANDS, SourceSound
from ..machine.source import CaseKey
from ..study.uncertainty import Uncertainty

DISCREPANCIES: Final = 50
"""Number of a sample."""
WITH_SPECTRUM: Final = 200
"""Number of a sample where a measured spectrum weighs: few agree with all of its octaves."""
_KEPT: Final = 128
"""Samples whose discrepancies are kept, 75 or 350 kB each: several steps ask for them in turn."""
_OCTAVES: Final[Array] = np.arange(len(GAIN_BANDS)) / 3.0
_CORRELATED: Final[Array] = np.linalg.cholesky(np.exp(-np.abs(_OCTAVES[:, None] - _OCTAVES)))
"""Factor of the correlation of the bands."""


@dataclass(frozen=True)
class Discrepancy:
    """Discrepancies of a sample.

    Attributes
    ----------
    gain : factors on the power of sources, shape (discrepancy, source, band)
    added : factors on what options add, shape (discrepancy,)
    unmodelled : factors on unmodelled noise, 1 without a measured spectrum, shape (discrepancy,
        band)
    """

    gain: Array
    added: Array
    unmodelled: Array

    @classmethod
    @lru_cache(maxsize=_KEPT)
    def of(
        cls, settings: Uncertainty, sources: int, number: int, with_spectrum: bool = False
    ) -> "Discrepancy":
        """Return the discrepancies of the sample of a number, the same at each call.

        Parameters
        ----------
        settings : standard deviations and seed
        sources : number of sources of sound
        number : number of the sample
        with_spectrum : whether a measured spectrum weighs; bands of unmodelled noise deviate too
        """
        count, bands = WITH_SPECTRUM if with_spectrum else DISCREPANCIES, len(GAIN_BANDS)
        normal = np.random.default_rng((settings.seed, number)).standard_normal
        path = settings.path_deviation_db * normal((count, 1, 1))
        source = settings.source_deviation_db * normal((count, sources, 1))
        white = normal((count, sources, bands))
        band = settings.band_deviation_db * (white @ _CORRELATED.T)
        added = settings.added_deviation_db * normal(count)
        unmodelled: Array = np.zeros((count, bands))
        if with_spectrum:
            white = normal((count, bands))
            unmodelled = settings.band_deviation_db * (white @ _CORRELATED.T)
        levels_db = (path + source + band, added, unmodelled)
        return cls(*map(power_of_level, levels_db))

    def some(self, index: IndexArray | slice) -> "Discrepancy":
        """Return the discrepancies of some numbers."""
        return Discrepancy(self.gain[index], self.added[index], self.unmodelled[index])

    def sounds(self, sound: Mapping[CaseKey, SourceSound]) -> list[dict[CaseKey, SourceSound]]:
        """Return the sound of a sample with each discrepancy.

        Parameters
        ----------
        sound : sound of every case, without discrepancy
        """
        gains = self.gains(sound)
        return [
            {key: of_case.scaled(gains[key][number]) for key, of_case in sound.items()}
            for number in range(self.added.size)
        ]

    def gains(self, sound: Mapping[CaseKey, SourceSound]) -> dict[CaseKey, Array]:
        """Return the factors on the power of the sources in every case.

        Parameters
        ----------
        sound : sound of every case, without discrepancy

        Returns
        -------
        shape (discrepancy, source, receiver, gain band)
        """
        return {
            key: with_added(self.gain, self.added, of_case.energy, _before(sound, key))
            for key, of_case in sound.items()
        }


def with_added(gain: Array, added: Array, energy: Array, before: Array) -> Array:
    """Compute factors on the power of sources, (..., discrepancy, source, receiver, band).

    Parameters
    ----------
    gain : factors of the discrepancies, shape (discrepancy, source, band)
    added : factors on what an option adds, shape (discrepancy,)
    energy : energy of each source alone, shape (..., 1, source, receiver, band) or without the
        first ones, Pa²
    before : energy of each source without an option, shape (source, receiver, band), Pa²
    """
    more = np.maximum(energy - before, 0.0)
    part = np.divide(more, energy, out=np.zeros_like(more), where=energy > 0.0)
    return np.asarray(gain[:, :, None] * (1.0 + (added - 1.0)[:, None, None, None] * part))


def _before(sound: Mapping[CaseKey, SourceSound], key: CaseKey) -> Array:
    """Energy of each source without an option, that of the case where it is unknown."""
    return sound.get((key[0], REFERENCE_OPTION), sound[key]).energy
