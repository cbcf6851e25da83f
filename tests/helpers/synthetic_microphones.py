"""Recordings of microphones around a monopole on a hard floor, of known sound power by band."""

import numpy as np
import xarray as xr

import vibroacoustics as va
from vibroacoustics.levels.bands import Band, bands_between

RATE_HZ, SECONDS = 25_600.0, 2.0
BANDS = bands_between(3, 100.0, 10_000.0)


def band_noise(
    levels_db: np.ndarray, start: int, random: np.random.Generator
) -> tuple[np.ndarray, np.ndarray]:
    """Lines (peaks) and their frequencies: every second one from a start, levels re 1 by band.

    Lines of two starts share no frequency, so that energies of two sounds add up exactly.
    """
    lines = np.arange(int(RATE_HZ * SECONDS) // 2)
    hertz = lines / SECONDS
    peaks = np.zeros(lines.size, dtype=complex)
    for band, level_db in zip(BANDS, levels_db, strict=True):
        of_band = np.flatnonzero(_within(hertz, band) & (lines % 2 == start))
        size = np.sqrt(2.0 * 10.0 ** (level_db / 10.0) / of_band.size)
        peaks[of_band] = size * np.exp(2j * np.pi * random.random(of_band.size))
    return peaks, hertz


def recording(
    positions_m: np.ndarray, power_db: np.ndarray, quiet_db: np.ndarray | None, with_source: bool
) -> xr.Dataset:
    """Microphones of a monopole at the origin, p² = rho c W/(2 pi r²), with rho c = 400 N s/m³.

    Parameters
    ----------
    positions_m : shape (microphone, 3)
    power_db : sound power by band, dB re 1 pW
    quiet_db : background by band at every microphone, of noise that shares no line, dB re 20 µPa
    with_source : whether the machine runs
    """
    random = np.random.default_rng(3)
    source, hertz = band_noise(power_db, 0, random)
    distance = np.linalg.norm(positions_m, axis=1)
    spread = 1.0 / np.sqrt(2.0 * np.pi) / distance
    delay = np.exp(-2j * np.pi * hertz * distance[:, None] / 343.0)
    peaks = with_source * 20e-6 * source * spread[:, None] * delay
    if quiet_db is not None:
        peaks += 20e-6 * np.array([band_noise(quiet_db, 1, random)[0] for _ in distance])
    spectrum = np.pad(peaks * RATE_HZ * SECONDS / 2.0, ((0, 0), (0, 1)))
    signal = np.fft.irfft(spectrum)
    names = [f"p{number}" for number in range(1, len(distance) + 1)]
    return va.label_recording(signal, RATE_HZ, names, ["Pa"] * len(names))


def _within(hertz: np.ndarray, band: Band) -> np.ndarray:
    """A little inside the band, so that no line is cut by its edges."""
    return (hertz > band.lower_hz * 1.003) & (hertz < band.upper_hz / 1.003)
