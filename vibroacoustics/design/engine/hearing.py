"""Loudness and audibility of tones of many designs: plain functions on arrays of spectra.

Axes are design, pair of a discrepancy and an unmodelled level, receiver, and line or third octave.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Final, NamedTuple

import numpy as np

from ...base.arrays import Array, IndexArray
from ...base.errors import ParameterError
from ...levels.measured_points import MIDDLE_HZ
from ...sound.loudness import filter_gain, noise_gain, thirds_db
from ...sound.predicted_audibility import predicted_audibility
from ...sound.zwicker import LOUDEST_DB, core_loudness, total_loudness
from .needs import Need

LOUDNESS: Final = Need("loudness")
AUDIBILITY: Final = Need("audibility")
HEARING: Final = (LOUDNESS, AUDIBILITY)
_LOW: Final = slice(0, 11)
"""Third octaves below 300 Hz."""
MOST_VALUES: Final = 2_000_000
"""Mean squares of lines that are computed together."""


class Spectrum(NamedTuple):
    """Sound of designs at one speed.

    Attributes
    ----------
    frequency_hz : frequency of the lines, shape (line,), Hz
    square : mean squares of the lines, shape (design, pair, receiver, line), Pa²
    noise : mean squares of the noise in the third octaves of a baseline, shape (design or 1, pair,
        receiver, band), Pa²
    """

    frequency_hz: Array
    square: Array
    noise: Array


@dataclass
class Hearing:
    """Loudness and audibility of designs, computed for many at a time.

    Attributes
    ----------
    needs : among others `LOUDNESS` and `AUDIBILITY`
    take : stores the results of numbered designs, or why they failed
    """

    needs: Sequence[Need]
    take: Callable[[IndexArray, Mapping[Need, Array] | Exception], None]
    _waiting: dict[bytes, list[tuple[IndexArray, Sequence[Spectrum]]]] = field(
        default_factory=dict, repr=False
    )

    def add(self, rows: IndexArray, spectra: Sequence[Spectrum]) -> None:
        """Add the spectra of designs by speed; those of equal frequencies are computed together."""
        key = b"".join(of_speed.frequency_hz.tobytes() for of_speed in spectra)
        waiting = self._waiting.setdefault(key, [])
        waiting.append((rows, spectra))
        values = sum(spectrum.square.size for _, each in waiting for spectrum in each)
        if values > MOST_VALUES:
            self._compute(self._waiting.pop(key))

    def finish(self) -> None:
        """Compute the designs that are left."""
        for waiting in self._waiting.values():
            self._compute(waiting)
        self._waiting.clear()

    def _compute(self, waiting: Sequence[tuple[IndexArray, Sequence[Spectrum]]]) -> None:
        rows = np.concatenate([some for some, _ in waiting])
        try:
            each = [
                hearing_of(self.needs, *_joined(speed))
                for speed in zip(*(spectra for _, spectra in waiting), strict=True)
            ]
        except ParameterError as error:
            self.take(rows, error)
            return
        result = {need: np.stack([part[need] for part in each], axis=2) for need in each[0]}
        self.take(rows, result)


def _joined(spectra: Sequence[Spectrum]) -> Spectrum:
    """Join the spectra of designs at one speed."""
    noise = [np.broadcast_to(s.noise, (len(s.square), *s.noise.shape[1:])) for s in spectra]
    square = np.concatenate([spectrum.square for spectrum in spectra])
    return Spectrum(spectra[0].frequency_hz, square, np.concatenate(noise))


def hearing_of(
    needs: Iterable[Need], frequency_hz: Array, square: Array, noise: Array
) -> dict[Need, Array]:
    """Compute loudness, sone, and decisive audibility, dB, shape (design, pair, receiver).

    Parameters
    ----------
    needs : among others `LOUDNESS` and `AUDIBILITY`
    frequency_hz : frequency of the lines, shape (line,), Hz
    square : mean squares of the lines, shape (design, pair, receiver, line), Pa²
    noise : mean squares of the noise in the third octaves of a baseline, shape (design or 1, pair,
        receiver, band), Pa²
    """
    wanted: Mapping[Need, object] = dict.fromkeys(needs)
    result: dict[Need, Array] = {}
    if LOUDNESS in wanted:
        of_lines, of_noise = _filters(tuple(frequency_hz.tolist()))
        result[LOUDNESS] = loudness_sone(square @ of_lines + noise @ of_noise)
    if AUDIBILITY in wanted:
        result[AUDIBILITY] = decisive_audibility_db(frequency_hz, square, noise)
    return result


def loudness_sone(mean_square: Array) -> Array:
    """Compute the loudness of third octaves from 25 Hz to 12.5 kHz, shape (...), sone.

    It is not a number where a third octave below 300 Hz exceeds 120 dB.

    Parameters
    ----------
    mean_square : shape (..., 28), Pa²
    """
    level_db = thirds_db(mean_square)
    is_too_loud = (level_db[..., _LOW] > LOUDEST_DB).any(axis=-1)
    if not is_too_loud.any() or is_too_loud.all():
        return total_loudness(core_loudness(level_db))
    loudness = np.full(level_db.shape[:-1], np.nan)
    loudness[~is_too_loud] = total_loudness(core_loudness(level_db[~is_too_loud]))
    return loudness


def decisive_audibility_db(frequency_hz: Array, square: Array, noise: Array) -> Array:
    """Compute the decisive audibility of lines in noise, shape (design, pair, receiver), dB.

    Parameters
    ----------
    frequency_hz, square, noise : see `hearing_of`
    """
    shape = square.shape[:2] if noise.shape[:2] != (1, 1) else (1, 1)
    thirds = np.broadcast_to(noise, (*shape, *noise.shape[2:]))
    each = [
        predicted_audibility(frequency_hz, square[:, :, row], thirds[:, :, row], MIDDLE_HZ)
        for row in range(square.shape[2])
    ]
    return np.stack([rated.decisive_db for rated in each], axis=2)


@lru_cache(maxsize=64)
def _filters(frequency_hz: tuple[float, ...]) -> tuple[Array, Array]:
    """Gain of the third-octave filters on lines and on noise, shapes (line or band, filter)."""
    return filter_gain(np.array(frequency_hz)), noise_gain(tuple(MIDDLE_HZ.tolist()))
