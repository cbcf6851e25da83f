"""Audibility of tones: printed examples, synthetic sounds with known levels, and predictions."""

import numpy as np
import pytest
from documents import DIN_45681, ISO_PAS_20065
from evidence import claim
from scipy import signal

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.base.weighting import a_weighting
from vibroacoustics.levels.bands import bands_between
from vibroacoustics.sound.audibility import (
    audibility_db,
    critical_edges_hz,
    masking_index_db,
    mean_uncertainty_db,
    tonal_adjustment_db,
)
from vibroacoustics.sound.audible_tones import audible_tones, mean_noise_lines
from vibroacoustics.sound.critical_bands import critical_bandwidth, proximity_hz
from vibroacoustics.sound.mean_audibility import decisive_tone, mean_audibility
from vibroacoustics.sound.predicted_audibility import predicted_audibility

REFERENCE = 4e-10
RATE_HZ = 32000.0
CENTRE_HZ = np.array([band.middle_hz for band in bands_between(3, 20.0, 12500.0)])

# ISO/PAS 20065:2016, annex E (spectrum 1, table E.2): frequency, L_S, L_T, ΔL; lines 2.7 Hz apart.
ANNEX_E = (
    (118.4, 48.91, 64.56, 1.92),
    (137.3, 49.22, 67.96, 4.99),
    (158.8, 50.50, 68.63, 4.37),
    (314.9, 52.85, 68.50, 1.78),
    (433.4, 58.29, 73.17, 0.87),
    (592.2, 59.53, 78.31, 4.55),
    (629.8, 59.71, 75.00, 1.01),
    (643.3, 61.98, 79.75, 3.47),
    (1582.7, 54.16, 71.07, 0.73),
)
# Table E.1: the 38 lines of the critical band of 137.3 Hz.
E1_HZ = np.array([
    96.9, 99.6, 102.3, 105.0, 107.7, 110.4, 113.0, 115.7, 118.4, 121.1, 123.8, 126.5, 129.2,
    131.9, 134.6, 137.3, 140.0, 142.7, 145.3, 148.0, 150.7, 153.4, 156.1, 158.8, 161.5, 164.2,
    166.9, 169.6, 172.3, 175.0, 177.6, 180.3, 183.0, 185.7, 188.4, 191.1, 193.8, 196.5,
])  # fmt: skip
E1_DB = np.array([
    49.40, 50.68, 50.09, 53.37, 44.47, 50.91, 51.41, 59.40, 64.54, 57.57, 51.02, 50.76, 59.93,
    62.94, 58.49, 65.87, 62.66, 50.25, 51.32, 52.30, 52.58, 53.15, 67.04, 67.27, 57.40, 57.17,
    52.56, 51.39, 52.49, 47.68, 51.26, 49.03, 61.42, 59.52, 48.43, 50.84, 48.20, 55.95,
])  # fmt: skip
# DIN 45681:2005, annex I, tables I.9 and I.10: tone of 298.8 Hz, lines 2.6917 Hz apart.
I9_DB = np.array([
    37.83, 38.45, 38.23, 38.74, 40.37, 47.09, 45.59, 43.27, 46.73, 46.54, 51.81, 49.74, 50.95,
    52.50, 55.45, 55.32, 61.55, 66.68, 64.77, 57.80, 55.75, 43.29, 46.26, 47.47, 46.22, 40.64,
    38.10, 42.13, 46.34, 39.03, 37.42, 42.59, 41.93, 41.81, 50.24, 52.30, 48.38, 36.27, 40.63,
])  # fmt: skip


@pytest.mark.parametrize(("hertz", "noise_db", "tone_db", "printed_db"), ANNEX_E)
def test_audibility_of_the_printed_levels(hertz, noise_db, tone_db, printed_db):
    rated = audibility_db(np.array(tone_db), np.array(noise_db), np.array(hertz), 2.7)
    claim(
        f"Audibility of the tone of {hertz:g} Hz", kind="printed", computed=rated, unit="dB",
        source=ISO_PAS_20065("table E.2"), reference=printed_db, tolerance=0.05, topics=("rating",),
    )  # fmt: skip


def test_levels_of_the_printed_lines():
    mean_db, _, _ = mean_noise_lines(E1_DB, E1_HZ, np.array([15]))
    tones = audible_tones(E1_DB, E1_HZ)
    second = tones[1]
    assert second.frequency_hz == 137.3
    assert tones[-1].count == 3
    for name, ours, printed in (
        ("mean noise line", mean_db[0], 49.22),
        ("level", second.level_db, 67.96),
        ("audibility", second.audibility_db, 4.99),
        ("uncertainty", second.uncertainty_db, 2.79),
        ("level with its two neighbours", tones[-1].level_db, 72.15),
    ):
        claim(
            f"Tone of 137.3 Hz of printed lines: {name}", kind="printed", computed=ours, unit="dB",
            source=ISO_PAS_20065("table E.1"), reference=printed, tolerance=0.05,
            topics=("rating",),
        )  # fmt: skip


def test_second_printed_spectrum():
    # Frequencies are printed to 0.1 Hz; equally spaced ones are within that.
    hertz = 253.0 + 2.6917 * np.arange(I9_DB.size)
    (tone,) = audible_tones(I9_DB, hertz)
    assert tone.frequency_hz == pytest.approx(298.8, abs=0.1)
    for name, ours, printed in (
        ("mean noise line", tone.noise_line_db, 41.71),
        ("level", tone.level_db, 68.10),
        ("audibility", tone.audibility_db, 12.52),
        ("uncertainty", tone.uncertainty_db, 3.18),
    ):
        claim(
            f"Tone of 298.8 Hz of printed lines: {name}", kind="printed", computed=ours, unit="dB",
            source=DIN_45681("tables I.9, I.10"), reference=printed, tolerance=0.05,
            topics=("rating",),
        )  # fmt: skip


def test_mean_of_the_printed_spectra():
    decisive = np.array([9.18, 6.04, 7.46, 2.67, 7.17])
    uncertainty = np.array([3.21, 2.95, 2.44, 2.52, 2.14])
    mean = 10.0 * np.log10(np.mean(10.0 ** (decisive / 10.0)))
    assert mean == pytest.approx(6.96, abs=0.05)
    claim(
        "Uncertainty of the mean audibility", kind="printed", source=ISO_PAS_20065("annex E"),
        computed=mean_uncertainty_db(decisive, uncertainty), reference=1.38, tolerance=0.01,
        unit="dB", topics=("rating",),
    )  # fmt: skip


def test_bands_index_and_distance():
    assert masking_index_db(np.array([137.3, 592.2])) == pytest.approx([-2.02, -2.40], abs=0.005)
    printed = {100.0: 101.0, 570.0: 122.0, 1000.0: 162.0, 4000.0: 685.0, 10500.0: 2463.0}
    for hertz, width_hz in printed.items():
        claim(
            f"Width of the critical band about {hertz:g} Hz", kind="printed", unit="Hz",
            source=ISO_PAS_20065("critical bands"), reference=width_hz, tolerance=0.5,
            computed=critical_bandwidth(np.array([hertz]))[0], topics=("rating",),
        )  # fmt: skip
    lower, upper = critical_edges_hz(np.array([90.0, 1000.0]))
    assert np.sqrt(lower * upper) == pytest.approx([90.0, 1000.0])
    assert proximity_hz(np.array([212.0, 137.3])) == pytest.approx([21.0, 24.09], abs=0.01)


def test_adjustment_is_that_of_the_table():
    heard = np.array([-10.0, 0.0, 0.01, 2.0, 2.01, 4.0, 6.38, 9.0, 9.1, 12.0, 12.01])
    expected = [0, 0, 1, 1, 2, 2, 4, 4, 5, 5, 6]
    assert tonal_adjustment_db(heard).tolist() == expected


def white(tones, density_db, seconds=60.0, seed=3):
    """Tones (frequency, level) in white noise of a level per hertz, as samples."""
    time = np.arange(round(seconds * RATE_HZ)) / RATE_HZ
    deviation = np.sqrt(REFERENCE * 10.0 ** (density_db / 10.0) * RATE_HZ / 2.0)
    pressure = deviation * np.random.default_rng(seed).standard_normal(time.size)
    for hertz, level_db in tones:
        peak = np.sqrt(2.0 * REFERENCE) * 10.0 ** (level_db / 20.0)
        pressure += peak * np.sin(2.0 * np.pi * hertz * time)
    return pressure


def predicted(tones, density_db):
    hertz, level_db = np.array(tones, dtype=float).T
    width = CENTRE_HZ * (10.0**0.05 - 10.0**-0.05)
    noise = REFERENCE * 10.0 ** (density_db / 10.0) * width
    square = REFERENCE * 10.0 ** (level_db / 10.0)
    return predicted_audibility(hertz, square[None], noise[None], CENTRE_HZ)


def expected_db(hertz, level_db, density_db):
    """Audibility of a tone in even noise by the definition, both weighted at the tone."""
    width = float(critical_bandwidth(np.array(hertz)))
    return level_db - density_db - 10.0 * np.log10(width) - float(masking_index_db(np.array(hertz)))


@pytest.mark.parametrize("hertz", [450.0, 1000.0, 3333.0])
def test_tone_in_white_noise(hertz):
    # The window's scalloping lowers a tone by at most 0.17 dB; 60 s of noise scatter by 0.1 dB;
    # the weighting varies over the critical band by at most 0.3 dB in the mean.
    level_db = 30.0 + 10.0 * np.log10(float(critical_bandwidth(np.array(hertz)))) + 4.0
    exact = expected_db(hertz, level_db, 30.0)
    assert mean_audibility(white([(hertz, level_db)], 30.0), RATE_HZ).audibility_db == (
        pytest.approx(exact, abs=0.7)
    )
    assert predicted([(hertz, level_db)], 30.0).decisive_db[0] == pytest.approx(exact, abs=0.4)


@pytest.mark.parametrize(
    "tones",
    [
        [(440.0, 55.0), (478.0, 54.0)],
        [(440.0, 55.0), (480.0, 54.0), (400.0, 52.0)],
        [(2000.0, 58.0), (2120.0, 57.0)],
        [(300.0, 52.0), (330.0, 38.0), (345.0, 35.0)],
        [(50.0 * order, 62.0 - 2.0 * order) for order in range(3, 30)],
        [(120.0, 56.0)],
    ],
)
def test_predicted_tones_are_rated_as_recorded_ones(tones):
    rated = mean_audibility(white(tones, 30.0), RATE_HZ)
    assert predicted(tones, 30.0).decisive_db[0] == pytest.approx(rated.audibility_db, abs=0.7)


def test_pair_heard_apart_does_not_join():
    # f_D is 30 Hz at 440 Hz: 38 Hz apart are two tones, 20 Hz apart are joined.
    apart = predicted([(440.0, 55.0), (478.0, 55.0)], 30.0)
    joined = predicted([(440.0, 55.0), (460.0, 55.0)], 30.0)
    assert apart.decisive_db[0] == pytest.approx(apart.tone_db.max(), abs=1e-9)
    # Weighting lowers the sum of two equal tones by 0.15 dB relative to the higher tone.
    assert joined.decisive_db[0] == pytest.approx(joined.tone_db.max() + 2.86, abs=0.02)


def test_silence_noise_alone_and_tones_alone():
    noise_alone = mean_audibility(white([], 30.0, seconds=12.0), RATE_HZ)
    assert noise_alone.audibility_db <= 0.0
    assert decisive_tone([]) is None
    silent = predicted_audibility(
        np.array([100.0, np.nan]), np.array([[1e-4, 0.0]]), np.zeros((1, CENTRE_HZ.size)), CENTRE_HZ
    )
    assert silent.decisive_db.tolist() == [-10.0]
    with pytest.raises(ParameterError, match="at least 3 s"):
        mean_audibility(np.zeros(100), RATE_HZ)


def test_gain_and_broad_hump_change_nothing():
    hump = signal.sosfilt(
        signal.butter(2, (900.0, 1100.0), "bandpass", fs=RATE_HZ, output="sos"),
        white([], 50.0, seconds=12.0),
    )
    sound = white([(1000.0, 62.0)], 30.0, seconds=12.0)
    rated = mean_audibility(sound, RATE_HZ)
    assert mean_audibility(10.0 * sound, RATE_HZ).audibility_db == pytest.approx(
        rated.audibility_db, abs=1e-6
    )
    assert mean_audibility(hump + white([], 20.0, 12.0), RATE_HZ).audibility_db < 3.0


def test_spectrum_is_weighted():
    level_db = 40.0 - float(a_weighting(100.0))
    tone = decisive_tone(audible_tones(E1_DB, E1_HZ))
    assert tone is not None
    (low,) = mean_audibility(white([(100.0, level_db)], 10.0, 3.0), RATE_HZ).decisive
    assert low is not None
    assert low.level_db == pytest.approx(40.0, abs=0.3)
