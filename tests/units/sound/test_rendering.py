"""Rendered sound has the levels that it is made of."""

import numpy as np
import pytest
from scipy import fft, signal
from sound_studies import a_level

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.levels import a_weighting
from vibroacoustics.sound.ingredients import Ingredients, SoundBands, SoundLines, ingredients
from vibroacoustics.sound.rendering import (
    SAMPLE_RATE_HZ,
    rendered,
    rendered_noise,
    whole_revolutions,
)


def measured_a_level(pressure):
    """From the lines of one transform of all of it."""
    hertz = fft.rfftfreq(pressure.size, 1.0 / SAMPLE_RATE_HZ)[1:]
    square = 2.0 * np.abs(fft.rfft(pressure)[1:] / pressure.size) ** 2
    return 10.0 * np.log10(square @ 10.0 ** (a_weighting(hertz) / 10.0) / 4e-10)


def tone_peak(pressure, frequency_hz):
    """Complex peak of a tone, through a Hann window over all of it."""
    sample = np.arange(pressure.size)
    window = 1.0 - np.cos(2.0 * np.pi * sample / pressure.size)
    turn = np.exp(-2j * np.pi * frequency_hz * sample / SAMPLE_RATE_HZ)
    return 2.0 * np.mean(pressure * window * turn)


def band_level(pressure, centre_hz):
    hertz = fft.rfftfreq(pressure.size, 1.0 / SAMPLE_RATE_HZ)
    within = (hertz >= centre_hz * 10.0**-0.05) & (hertz < centre_hz * 10.0**0.05)
    square = 2.0 * np.abs(fft.rfft(pressure) / pressure.size) ** 2
    return 10.0 * np.log10(square[within].sum() / 4e-10)


@pytest.mark.parametrize("duration", [2.0, pytest.param(30.0, marks=pytest.mark.long)])
def test_every_order_has_its_level_and_phase(compressor, duration):
    pressure = rendered(compressor, whole_revolutions(duration, 2900.0, SAMPLE_RATE_HZ))
    lines = compressor.lines
    for hertz, peak in zip(lines.frequency_hz, lines.pressure_pa, strict=True):
        ratio = tone_peak(pressure, hertz) / peak
        assert 20.0 * np.log10(abs(ratio)) == pytest.approx(0.0, abs=0.05)
        assert np.angle(ratio) == pytest.approx(0.0, abs=0.01)


def test_every_band_of_noise_has_its_level(compressor):
    bands = compressor.bands
    noise = rendered_noise(bands, 3 * SAMPLE_RATE_HZ, SAMPLE_RATE_HZ)
    for centre, effective in zip(bands.centre_hz, bands.pressure_pa, strict=True):
        expected = 20.0 * np.log10(effective / 2e-5)
        assert band_level(noise, centre) == pytest.approx(expected, abs=1e-6)


@pytest.mark.parametrize(("speed", "microphone"), [(900.0, "front_1m"), (950.0, "above_1m")])
def test_the_a_weighted_level_is_that_of_the_results(results, speed, microphone):
    parts = ingredients(results, "lanchester", microphone, speed)
    pressure = rendered(parts, whole_revolutions(3.0, speed, SAMPLE_RATE_HZ))
    at = {"speed": speed, "receiver": microphone, "option": "lanchester"}
    total = results["level_total"].sel(at).item()
    assert measured_a_level(pressure) == pytest.approx(total, abs=0.05)


def test_tones_and_noise_do_not_change_each_other(compressor):
    pressure = rendered(compressor, whole_revolutions(5.0, 2900.0, SAMPLE_RATE_HZ))
    assert measured_a_level(pressure) == pytest.approx(a_level(compressor), abs=0.02)


def test_twice_the_shaft_and_twice_the_line_beat(compressor):
    pressure = rendered(compressor, whole_revolutions(6.0, 2900.0, SAMPLE_RATE_HZ))
    hertz = fft.rfftfreq(pressure.size, 1.0 / SAMPLE_RATE_HZ)
    near = (hertz > 96.0) & (hertz < 101.0)
    envelope = np.abs(signal.hilbert(fft.irfft(fft.rfft(pressure) * near, pressure.size)))
    spectrum = np.abs(fft.rfft(envelope - envelope.mean())) / (0.5 * pressure.size)
    beat_hz = 100.0 - 2.0 * 2900.0 / 60.0
    assert beat_hz == pytest.approx(3.33, abs=0.01)
    assert hertz[np.argmax(spectrum)] == pytest.approx(beat_hz, abs=0.1)
    turn = 2.0 * np.pi * np.arange(256) / 256
    alone = np.abs(0.015 + 0.01 * np.exp(1j * turn))  # Pa, order 2 and twice the line
    expected = abs(fft.rfft(alone)[1]) / 128
    assert spectrum.max() == pytest.approx(expected, rel=0.1)


def test_the_noise_is_the_same_for_all_options_and_repeats_without_a_seam():
    bands = SoundBands(np.array([1000.0]), np.array([0.01]))
    louder = SoundBands(bands.centre_hz, 2.0 * bands.pressure_pa)
    one, other = (rendered_noise(b, SAMPLE_RATE_HZ, SAMPLE_RATE_HZ) for b in (bands, louder))
    np.testing.assert_allclose(other, 2.0 * one)
    assert not np.allclose(rendered_noise(bands, SAMPLE_RATE_HZ, SAMPLE_RATE_HZ, seed=2), one)
    steps = np.abs(np.diff(np.tile(one, 2)))
    assert steps[one.size - 1] <= steps.max(initial=0.0, where=np.arange(steps.size) < one.size - 1)


def test_whole_revolutions_end_on_a_sample():
    samples = whole_revolutions(10.0, 950.0, SAMPLE_RATE_HZ)
    revolutions = samples / SAMPLE_RATE_HZ * 950.0 / 60.0
    assert revolutions == pytest.approx(round(revolutions), abs=1e-3)
    assert samples / SAMPLE_RATE_HZ == pytest.approx(10.0, rel=0.06)
    assert whole_revolutions(2.0, 0.0, SAMPLE_RATE_HZ) == 2 * SAMPLE_RATE_HZ
    with pytest.raises(ParameterError, match="must be 1 to 600 s"):
        whole_revolutions(601.0, 950.0, SAMPLE_RATE_HZ)


def test_what_the_sample_rate_cannot_hold_is_left_out():
    lines = SoundLines(np.array([100.0, 30000.0]), np.array([1.0 + 0j, 1.0]), ("low", "high"))
    bands = SoundBands(np.array([25119.0]), np.array([1.0]))
    pressure = rendered(Ingredients(lines, bands), SAMPLE_RATE_HZ)
    assert np.mean(pressure**2) == pytest.approx(0.5)
