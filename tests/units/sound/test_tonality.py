"""Tone-to-noise and prominence ratio on sounds whose ratios follow from the formulas."""

import numpy as np
import pytest
from documents import ECMA_418_1, MOSQITO
from evidence import claim
from tonal_spectra import tonal_spectrum

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.levels.hearing import hearing_threshold_db
from vibroacoustics.sound import critical_bands
from vibroacoustics.sound.critical_bands import band_above, band_below, critical_band
from vibroacoustics.sound.ingredients import Ingredients, SoundBands, SoundLines
from vibroacoustics.sound.recorded import narrow_bands, recorded_spectrum
from vibroacoustics.sound.tonality import TonalSpectrum, prominent, tones

REFERENCE = 4e-10
RATE = 48000.0


def white(frequencies, levels, density_db):
    """Tones in noise of a level per hertz."""
    square = REFERENCE * 10.0 ** (np.array(levels) / 10.0)
    density = REFERENCE * 10.0 ** (density_db / 10.0)
    names = tuple(f"{one:g}" for one in frequencies)
    steady = np.ones_like(square), np.zeros_like(square)
    hertz = np.array(frequencies, dtype=float)
    return TonalSpectrum(hertz, square, lambda low, high: density * (high - low), names, *steady)


def recorded(frequencies, levels, density_db, seconds=12.0):
    """The same as samples."""
    time = np.arange(round(seconds * RATE)) / RATE
    deviation = np.sqrt(REFERENCE * 10.0 ** (density_db / 10.0) * RATE / 2.0)
    pressure = deviation * np.random.default_rng(4).standard_normal(time.size)
    for hertz, level in zip(frequencies, levels, strict=True):
        peak = np.sqrt(2.0 * REFERENCE) * 10.0 ** (level / 20.0)
        pressure += peak * np.sin(2.0 * np.pi * hertz * time)
    return pressure


def power_db(*levels):
    return 10.0 * np.log10(np.sum(10.0 ** (np.array(levels) / 10.0)))


def test_critical_bands_have_the_widths_and_edges_of_the_standard():
    assert critical_bands.critical_bandwidth(1000.0) == pytest.approx(162.2, abs=0.05)
    assert critical_bands.critical_bandwidth(100.0) == pytest.approx(100.7, abs=0.05)
    low, high = critical_band(300.0), critical_band(1000.0)
    assert low.lower + low.upper == pytest.approx(600.0)
    assert high.lower * high.upper == pytest.approx(1000.0**2)
    assert high == pytest.approx((922.2, 1084.4), abs=0.05)
    assert band_below(120.0).lower == 20.0


@pytest.mark.parametrize("hertz", [200.0, 700.0, 1599.0, 1601.0, 4000.0, 9000.0])
def test_neighbouring_bands_are_critical_bands_too(hertz):
    for band in (band_below(hertz), band_above(hertz)):
        middle = 0.5 * (band.lower + band.upper)
        if middle > 500.0:
            middle = np.sqrt(band.lower * band.upper)
        assert band.width == pytest.approx(critical_bands.critical_bandwidth(middle), rel=0.06)


@pytest.mark.parametrize(
    ("hertz", "noise", "bands"), [(100.0, 16.33, 19.0), (500.0, 10.51, 12.01), (2000.0, 8.0, 9.0)]
)
def test_criteria_rise_below_one_kilohertz(hertz, noise, bands):
    for name, ours, printed in (
        ("tone-to-noise", critical_bands.noise_criterion_db(hertz), noise),
        ("prominence", critical_bands.prominence_criterion_db(hertz), bands),
    ):
        claim(
            f"Criterion of the {name} ratio at {hertz:g} Hz", kind="printed", unit="dB",
            source=ECMA_418_1("criteria of prominence"), computed=ours, reference=printed,
            tolerance=0.005, topics=("receivers",),
        )  # fmt: skip


def test_the_threshold_of_hearing_goes_on_from_range_to_range():
    for edge in (305.0, 2230.0):
        below, above = (hearing_threshold_db(edge + side) for side in (-1e-3, 0.0))
        assert above == pytest.approx(below, abs=0.02)


@pytest.mark.parametrize("hertz", [100.0, 150.0, 250.0, 1000.0, 5000.0])
def test_a_tone_in_white_noise(hertz):
    (tone,) = tones(white([hertz], [52.0], 20.0))
    middle, below, above = (
        20.0 + 10.0 * np.log10(band.width)
        for band in (critical_band(hertz), band_below(hertz), band_above(hertz))
    )
    below = 40.0 if hertz <= 171.4 else below  # a band cut at 20 Hz counts as one of 100 Hz
    assert tone.noise_ratio_db == pytest.approx(52.0 - middle)
    expected = power_db(52.0, middle) - power_db(below, above) + 10.0 * np.log10(2.0)
    assert tone.prominence_db == pytest.approx(expected)
    assert tone.prominent == (hertz == 1000.0)


def test_lines_near_each_other_are_one_tone():
    """At 100 Hz lines within 34 Hz belong together: 2x of 2900 rpm and twice the supply's 50 Hz."""
    (tone,) = tones(white([96.667, 100.0], [50.0, 56.0], 10.0))
    assert tone.name == "100"
    assert tone.level_db == pytest.approx(power_db(50.0, 56.0))
    noise = 10.0 + 10.0 * np.log10(critical_band(100.0).width)
    assert tone.noise_ratio_db == pytest.approx(tone.level_db - noise)


def test_lines_apart_in_a_critical_band_are_two_tones_and_no_noise_to_each_other():
    """At 212 Hz lines within 21 Hz belong together."""
    first, second = tones(white([212.0, 234.0], [60.0, 55.0], 10.0))
    assert (first.name, second.name) == ("212", "234")
    for tone, level in ((first, 60.0), (second, 55.0)):
        noise = 10.0 + 10.0 * np.log10(critical_band(tone.frequency_hz).width)
        assert tone.noise_ratio_db == pytest.approx(level - noise)
    (together,) = tones(white([212.0, 232.0], [60.0, 55.0], 10.0))
    assert together.level_db == pytest.approx(power_db(60.0, 55.0))


def test_from_one_kilohertz_on_a_critical_band_holds_one_tone():
    (tone,) = tones(white([3000.0, 3048.0, 2952.0, 3150.0], [50.0, 49.0, 48.0, 47.0], 5.0))
    assert tone.level_db == pytest.approx(power_db(50.0, 49.0, 48.0, 47.0))


def test_what_is_not_audible_or_not_judged_is_not_prominent():
    quiet, low = white([1000.0], [-8.0], -60.0), white([80.0], [90.0], 0.0)
    assert not prominent(tones(quiet))
    assert not tones(low)
    (alone,) = tones(white([1000.0], [40.0], -np.inf))
    assert alone.noise_ratio_db == np.inf
    assert alone.prominent


def test_noise_of_third_octaves_is_even_over_the_logarithm():
    bands = SoundBands(np.array([1000.0]), np.array([0.02]))
    none = SoundLines(np.array([]), np.array([], dtype=complex), ())
    noise = tonal_spectrum(Ingredients(none, bands)).noise
    assert noise(0.0, 1e5) == pytest.approx(4e-4)
    assert noise(1000.0, 1e5) == pytest.approx(2e-4)
    assert noise(10.0**2.97, 10.0**2.99) == pytest.approx(0.2 * 4e-4)


@pytest.mark.parametrize("density", [20.0, pytest.param(0.0, marks=pytest.mark.long)])
def test_recorded_tones_agree_with_the_formulas(density):
    hertz, levels = [100.0, 212.0, 250.0, 1000.3, 4000.1], [70.0, 60.0, 55.0, 60.0, 55.0]
    computed = {tone.name: tone for tone in tones(white(hertz, levels, density))}
    bands = narrow_bands(recorded(hertz, levels, density), RATE)
    judged = [tone for tone in tones(recorded_spectrum(bands)) if tone.noise_ratio_db > 0.0]
    assert len(judged) == len(computed)
    for tone in judged:
        other = min(computed.values(), key=lambda one: abs(one.frequency_hz - tone.frequency_hz))
        assert tone.frequency_hz == pytest.approx(other.frequency_hz, abs=0.2)
        assert tone.level_db == pytest.approx(other.level_db, abs=0.1)
        assert tone.noise_ratio_db == pytest.approx(other.noise_ratio_db, abs=0.5)
        assert tone.prominence_db == pytest.approx(other.prominence_db, abs=0.5)


def part_of_time(hertz, level, first, last, seconds=3.0, density=20.0):
    """A tone that sounds from one share of the recording to another, in noise."""
    noise = recorded([], [], density, seconds)
    tone = recorded([hertz], [level], -200.0, seconds)
    tone[: round(first * tone.size)] = 0.0
    tone[round(last * tone.size) :] = 0.0
    (found, *_) = tones(recorded_spectrum(narrow_bands(noise + tone, RATE)))
    return found


@pytest.mark.parametrize("density", [20.0, pytest.param(-20.0, marks=pytest.mark.long)])
@pytest.mark.parametrize("level", [60.0, 80.0, 94.0])
@pytest.mark.parametrize("hertz", [100.0, 315.0, 1000.3, 4000.0])
def test_a_tone_that_starts_within_the_recording(hertz, level, density):
    """Its share is counted in segments, an eighth of a third of the recording apart."""
    tone = part_of_time(hertz, level, 1.0 / 3.0, 1.0, density=density)
    assert tone.frequency_hz == pytest.approx(hertz, abs=1.0)
    assert tone.level_db == pytest.approx(level, abs=0.3)
    assert tone.share == pytest.approx(2.0 / 3.0, abs=1.0 / 24.0)
    assert tone.swing_db < 1.0


@pytest.mark.parametrize(("first", "last"), [(0.0, 0.25), (0.45, 0.6), (0.75, 1.0)])
def test_a_tone_that_sounds_for_a_short_time(first, last):
    """A third of the segment's window has 97 % of its power: half of a segment is 1.2 dB off."""
    tone = part_of_time(500.0, 80.0, first, last)
    assert tone.level_db == pytest.approx(80.0, abs=1.2)
    assert tone.share == pytest.approx(last - first, abs=1.0 / 24.0)


def test_a_steady_tone_sounds_all_the_time():
    tone = part_of_time(1000.3, 94.0, 0.0, 1.0, density=-20.0)
    assert tone.level_db == pytest.approx(94.0, abs=0.02)
    assert tone.share == 1.0
    assert tone.swing_db < 0.1


def test_a_level_that_swings():
    """By a sine of 4 dB to either side: 10 to 90 % of the time are 2 · 4 · sin 72° dB apart."""
    seconds, swing_db = 24.0, 4.0
    tone = recorded([1000.0], [80.0], 0.0, seconds)
    history_db = swing_db * np.sin(2.0 * np.pi * np.arange(tone.size) / tone.size)
    (found, *_) = tones(recorded_spectrum(narrow_bands(tone * 10.0 ** (history_db / 20.0), RATE)))
    assert found.swing_db == pytest.approx(2.0 * swing_db * np.sin(np.radians(72.0)), abs=0.8)


@pytest.mark.long
def test_a_slam_is_no_tone():
    """The steady tone is listed, not the second of noise that is 10 dB louder in its lines."""
    pressure = recorded([500.0], [60.0], 20.0)
    pressure[5 * 48000 : 6 * 48000] += recorded([], [], 66.0, 1.0)
    found = tones(recorded_spectrum(narrow_bands(pressure, RATE)))
    (tone,) = (one for one in found if one.name == "500.0 Hz")
    assert tone.level_db == pytest.approx(60.0, abs=3.0)


@pytest.mark.long
def test_mosqito_has_the_same_ratios():
    """A second implementation, of another screening, from the same spectrum.

    Of a weak tone: it counts lines of a tone within 10 dB of the peak, the rest of them as noise.
    """
    mosqito = pytest.importorskip("mosqito")
    bands = narrow_bands(recorded([1000.0], [47.0], 20.0), RATE)
    (tone,) = (t for t in tones(recorded_spectrum(bands)) if t.noise_ratio_db > 0.0)
    of_tone = np.argmin(np.abs(bands.frequency_hz - 1000.0))
    for ratio, own, apart in (
        (mosqito.tnr_ecma_freq, tone.noise_ratio_db, 0.8),
        (mosqito.pr_ecma_freq, tone.prominence_db, 0.3),
    ):
        _, values, _, hertz = ratio(np.sqrt(bands.mean_square), bands.frequency_hz, False)
        nearest = np.argmin(np.abs(np.asarray(hertz, dtype=float) - bands.frequency_hz[of_tone]))
        claim(
            f"Ratio of a weak tone by {ratio.__name__}", kind="second code", unit="dB",
            source=MOSQITO(ratio.__name__), computed=own, reference=float(values[nearest]),
            tolerance=apart, topics=("receivers",),
        )  # fmt: skip


def test_noise_alone_has_no_tone():
    for seconds in (3.0, 8.0):
        bands = narrow_bands(recorded([], [], 20.0, seconds), RATE)
        assert not [tone for tone in tones(recorded_spectrum(bands)) if tone.noise_ratio_db > 0.0]


def test_a_short_recording_is_refused():
    with pytest.raises(ParameterError, match=r"recording of 2 s: tones need at least 3 s"):
        narrow_bands(np.zeros(96000), RATE)
