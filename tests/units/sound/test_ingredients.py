"""Lines and noise of an option at a microphone: their sum is the level of the results."""

import numpy as np
import pytest
from sound_studies import a_level

from vibroacoustics.base.errors import ParameterError, SchemaError
from vibroacoustics.levels.axes import LevelAxes
from vibroacoustics.levels.bands import bands_between
from vibroacoustics.levels.continuous import noise_levels
from vibroacoustics.mechanics.loads import Lines
from vibroacoustics.mechanics.received_sound import NoisePower, ReceivedSound
from vibroacoustics.sound.ingredients import ingredients


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
    remaining = np.zeros((1, 1, 27))
    remaining[0, 0, 16] = 4e-10 * 1e5  # 1 kHz
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
