"""Lines and noise of an option at a microphone: their sum is the level of the results."""

import itertools

import numpy as np
import pytest
from sound_studies import a_level
from sources_study import sources_run

from vibroacoustics.base.errors import ParameterError, SchemaError
from vibroacoustics.levels.axes import LevelAxes
from vibroacoustics.levels.bands import bands_between
from vibroacoustics.levels.lines import noise_levels
from vibroacoustics.mechanics.loads import Lines
from vibroacoustics.mechanics.received_sound import NoisePower, ReceivedSound
from vibroacoustics.sound.ingredients import ingredients
from vibroacoustics.sound.predicted_audibility import predicted_audibility


@pytest.mark.parametrize("speed", [900.0, 950.0, 1200.0])  # measured, between, not measured
@pytest.mark.parametrize("microphone", ["front_1m", "above_1m"])  # measured, not measured
def test_the_sum_is_the_total_level(results, speed, microphone):
    for option in results["option"].values:
        total = results["level_total"].sel(speed=speed, receiver=microphone, option=option)
        parts = ingredients(results, str(option), microphone, speed)
        assert a_level(parts) == pytest.approx(total.item(), abs=1e-9)


def test_lines_are_the_sources_together_with_their_phase(results):
    parts = ingredients(results, "lanchester", "above_1m", 900.0)
    at = {"speed": 900.0, "option": "lanchester", "receiver": "above_1m"}
    pressure = results["pressure_line"].sel(at).sum("sound_source")
    assert parts.lines.name == tuple(f"order {order}" for order in (1, 2, 3, 4))
    np.testing.assert_allclose(parts.lines.frequency_hz, [15.0, 30.0, 45.0, 60.0])
    np.testing.assert_array_equal(parts.lines.pressure_pa, pressure.values[1:])


def test_measured_orders_and_bands_stand_for_the_model(results):
    parts = ingredients(results, "none", "front_1m", 900.0)
    effective = np.abs(parts.lines.pressure_pa[:2]) / np.sqrt(2.0)
    np.testing.assert_allclose(20.0 * np.log10(effective / 20e-6), [90.0, 60.0])
    band = dict(zip(np.rint(parts.bands.centre_hz), parts.bands.pressure_pa, strict=True))
    assert 20.0 * np.log10(band[1000.0] / 20e-6) == pytest.approx(75.0)
    # 61 dB measured at 31.5 Hz hold order 2 of 60 dB at 30 Hz
    assert 10.0 * np.log10(band[32.0] ** 2 / 4e-10) == pytest.approx(
        10.0 * np.log10(10.0**6.1 - 10.0**6.0), abs=1e-6
    )


def test_noise_of_sources_and_remainder_go_to_their_bands():
    bands = bands_between(3, 20.0, 4000.0)
    axes = LevelAxes([3000.0], ["none"], ["keys"], ["front_1m"], bands)
    lines = Lines(("order 1",), np.array([50.0]), {})
    frequency = np.array([90.0, 100.0, 3600.0])
    noise = NoisePower(0, frequency, 4e-10 * np.array([[1e4, 2e4, 1e3]]))
    sound = {(3000.0, "none"): ReceivedSound(lines, np.zeros((1, 1, 1), complex), (noise,))}
    remaining = np.zeros((1, 1, 1, 27))
    remaining[..., 16] = 4e-10 * 1e5  # 1 kHz
    levels = noise_levels(axes, sound, remaining).squeeze()
    by_band = levels["noise_band_level"]
    np.testing.assert_allclose(
        by_band.sel(noise_band=[80.0, 100.0, 4000.0]), [-300.0, 10.0 * np.log10(3e4), 30.0]
    )
    assert levels["unmodelled_band_level"].sel(noise_band=1000.0) == pytest.approx(50.0)


@pytest.mark.parametrize(
    ("case", "words"),
    [
        (("pendulum", "front_1m", 900.0), "option = pendulum: the results hold no such one"),
        (("none", "behind", 900.0), "there are front_1m, side_1m, above_1m"),
        (("none", "front_1m", 901.0), "speed = 901.0 rpm: the results hold no such one"),
    ],
)
def test_what_the_results_do_not_hold_is_named(results, case, words):
    with pytest.raises(ParameterError, match=words):
        ingredients(results, *case)


def test_older_results_are_refused(results):
    with pytest.raises(SchemaError, match="run the study again"):
        ingredients(results.drop_vars("noise_band_level"), "none", "front_1m", 900.0)


# --- with samples --------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def sampled():
    return sources_run()


def cases(sampled):
    names = (sampled[name].values.tolist() for name in ("option", "receiver", "speed"))
    return itertools.product(*names)


def third_octaves(parts, results):
    """Level of lines and noise by band of the results."""
    centres = 10.0 ** (np.rint(10.0 * np.log10(results["noise_band"].values)) / 10.0)
    square = np.zeros(centres.size)
    for hertz, own in (
        (parts.lines.frequency_hz, 0.5 * np.abs(parts.lines.pressure_pa) ** 2),
        (parts.bands.centre_hz, parts.bands.pressure_pa**2),
    ):
        for at, energy in zip(hertz, own, strict=True):
            square[np.argmin(abs(np.log(at / centres)))] += energy
    return 10.0 * np.log10(np.maximum(square, 1e-30) / 4e-10)


def test_sound_of_samples_has_the_median_total(sampled):
    for option, microphone, speed in cases(sampled):
        at = {"option": option, "receiver": microphone, "speed": speed}
        parts = ingredients(sampled, option, microphone, speed)
        total = sampled["level_total"].sel(at).item()
        assert a_level(parts) == pytest.approx(total, abs=1e-6)
        assert parts.a_weighted_db == pytest.approx(total, abs=1e-6)


def test_every_third_octave_is_within_its_interval_but_for_the_step_to_the_total(sampled):
    """Median levels by band, all raised or lowered by one step of less than a decibel or two."""
    for option, microphone, speed in cases(sampled):
        at = {"option": option, "receiver": microphone, "speed": speed}
        parts = ingredients(sampled, option, microphone, speed)
        found = third_octaves(parts, sampled)
        median, low, high = (
            sampled[f"total_band_level{end}"].sel(at).values
            for end in ("", "_10_percent", "_90_percent")
        )
        sounds = found > -100.0
        assert np.all(sounds | (median < -100.0))
        step = found[sounds] - median[sounds]
        assert np.ptp(step) < 1e-6
        assert abs(step[0]) < 3.0
        for level in (found[sounds], found[sounds] - step[0]):
            assert np.all(level >= low[sounds] - 1e-6)
            assert np.all(level <= high[sounds] + 1e-6)


def test_an_option_sounds_louder_by_the_difference_of_the_medians(sampled):
    parts = [ingredients(sampled, name, "front_1m", 2900.0) for name in ("none", "damping")]
    at = {"receiver": "front_1m", "speed": 2900.0}
    total = sampled["level_total"].sel(at)
    change = total.sel(option="damping") - total.sel(option="none")
    assert parts[1].a_weighted_db - parts[0].a_weighted_db == pytest.approx(change.item(), abs=1e-6)


def test_lines_of_samples_keep_the_phases_of_the_representative_one(sampled):
    at = {"option": "none", "receiver": "front_1m", "speed": 2900.0}
    parts = ingredients(sampled, "none", "front_1m", 2900.0)
    pressure = sampled["pressure_line"].sel(at).sum("sound_source")
    for name, value in zip(parts.lines.name, parts.lines.pressure_pa, strict=True):
        ratio = value / pressure.sel(line=name).item()
        assert abs(ratio.imag) < 1e-9 * abs(ratio)
        assert ratio.real > 0.0


def test_tones_are_as_audible_as_the_report_says(sampled):
    """The three most audible of each option, in the noise with which they are heard."""
    at = {"receiver": "front_1m", "speed": 2900.0}
    for option in sampled["option"].values:
        sound = ingredients(sampled, str(option), "front_1m", 2900.0)
        lines, bands = sound.lines, sound.bands
        square = 0.5 * np.abs(lines.pressure_pa) ** 2
        rated = predicted_audibility(
            lines.frequency_hz, square, bands.pressure_pa**2, bands.centre_hz
        ).tone_db
        median = sampled["tone_audibility"].sel(at).sel(option=option, judged_tone=list(lines.name))
        loudest = np.argsort(-median.values)[:3]
        loudest = loudest[median.values[loudest] > -3.0]  # weaker ones are hardly heard
        assert loudest.size
        np.testing.assert_allclose(rated[loudest], median.values[loudest], atol=0.2)
