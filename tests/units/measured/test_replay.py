"""Replay of an option in synthetic recordings: orders, residual, what stays, and refusals."""

import json

import numpy as np
import pytest
import xarray as xr
from replay_study import ratio, replay_study

from vibroacoustics import NominalSpeed, SpeedChannel, TacholessSpeed, label_recording, replay
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.measured.option_ratios import changed_noise_bands, option_ratios

RATE = 8192.0
DURATION = 20.0
TIME = np.arange(int(DURATION * RATE)) / RATE
NOISE = 0.02 * np.random.default_rng(3).standard_normal(TIME.size)
PEAKS = {1.0: 0.5, 2.0: 0.3j, 3.0: -0.2, 4.0: 0.1, 5.0: 0.05, 7.0: 0.1}
RUN_UP = [float(round(1500.0 * 1.04**number)) for number in range(20)]
PAIR = {"mic": "front"}


def shaft(speed_rpm):
    """Crank angle by the trapezoidal rule."""
    steps = 0.5 * (speed_rpm[1:] + speed_rpm[:-1]) * 2.0 * np.pi / 60.0 / RATE
    return np.concatenate([[0.0], np.cumsum(steps)])


def sound(speed_rpm, changed=()):
    """Orders of the recording; those that are changed with the exact ratio of their speed."""
    angle = shaft(speed_rpm)
    return sum(
        np.real(
            peak
            * (ratio(order, speed_rpm) if order in changed else 1.0)
            * np.exp(1j * order * angle)
        )
        for order, peak in PEAKS.items()
    )


def recorded(speed_rpm, unit="Pa"):
    signals = [sound(speed_rpm) + NOISE, speed_rpm]
    return label_recording(signals, RATE, ["mic", "speed"], [unit, "rpm"])


EVEN = np.full(TIME.size, 2900.0)
RISING = 1550.0 + 1000.0 * TIME / DURATION


@pytest.mark.parametrize(
    "speed",
    [
        NominalSpeed(2900.0),
        SpeedChannel("speed"),
        TacholessSpeed("mic", 2500.0, 3300.0, (1.0, 2.0, 3.0, 4.0, 5.0, 7.0)),
    ],
    ids=["nominal", "rpm channel", "tacholess"],
)
def test_an_even_speed(speed):
    """The result is the sound with the exact ratios, to 1 % of the changed orders."""
    replayed = replay(recorded(EVEN), replay_study([2900.0]), "ring", PAIR, speed)
    first, end = (
        round(replayed.summary.attrs[f"replayed_{side}_s"] * RATE) for side in ("from", "to")
    )
    assert end - first > 0.95 * TIME.size
    wanted = (sound(EVEN, (1.0, 2.0, 3.0)) + NOISE)[first:end]
    np.testing.assert_array_equal(replayed.before[0], (sound(EVEN) + NOISE)[first:end])
    change = wanted - replayed.before[0]
    assert np.std(replayed.after[0] - wanted) < 0.01 * np.std(change)
    levels = replayed.summary.sel(channel="mic", line=["order 1", "order 2", "order 3"])
    expected = 20.0 * np.log10(np.abs([ratio(k, 2900.0) for k in (1, 2, 3)]))
    np.testing.assert_allclose(levels["replayed_line_change"], expected, atol=0.01)
    before = 20.0 * np.log10(np.abs([0.5, 0.3, 0.2]) / np.sqrt(2.0) / 2e-5)
    np.testing.assert_allclose(levels["recorded_line_level"], before, atol=0.05)


def test_a_run_up_between_close_speeds():
    """Ratios between speeds 4 % apart are those of the study's formula within 0.1 dB and 1 %."""
    speed = SpeedChannel("speed")
    replayed = replay(recorded(RISING), replay_study(RUN_UP), "ring", PAIR, speed)
    wanted = sound(RISING, (1.0, 2.0, 3.0)) + NOISE
    change = wanted - replayed.before[0]
    assert np.std(replayed.after[0] - wanted) < 0.02 * np.std(change)
    total = replayed.summary["replayed_total_level"].sel(channel="mic", weighting="Z").item()
    assert total == pytest.approx(20.0 * np.log10(np.std(wanted) / 2e-5), abs=0.02)


def test_what_stays_is_listed():
    replayed = replay(recorded(EVEN), replay_study([2900.0]), "ring", PAIR, NominalSpeed(2900.0))
    assert json.loads(replayed.summary.attrs["unchanged"]) == {
        "mic": {
            "order 4": "the study has it with the option only",
            "order 5": "the ratio reaches 26 dB, above 20 dB",
            "order 20": "below the recording's noise",
            "motor: 2 x line": "no shaft order",
        }
    }
    assert np.isnan(replayed.summary["replayed_line_change"].sel(channel="mic", line="order 20"))


def test_an_option_that_changes_nothing_in_lines_returns_the_recording():
    results = replay_study([2900.0])
    replayed = replay(recorded(EVEN), results, "hood", PAIR, NominalSpeed(2900.0), orders_only=True)
    np.testing.assert_array_equal(replayed.after, replayed.before)
    assert replayed.summary.attrs["noise_changes"] == 1


def test_ratios_are_those_of_all_sources_together():
    results = replay_study([2900.0])
    results["pressure_line"][0, 1, 1, 0, 1] = 0.0  # of the gas, with the ring, order 1
    (first, *_) = option_ratios(results, "ring", "front", 2900.0, 2900.0).orders
    assert first.line == "order 1"
    np.testing.assert_allclose(first.ratio, 3.0 * ratio(1.0, np.array([2900.0])))


def test_the_interval_of_the_first_order_is_that_of_the_study():
    results = replay_study([2900.0])
    change = 20.0 * np.log10(0.6)
    for suffix, value in (("_10_percent", -2.0), ("", 0.0), ("_90_percent", 3.0)):
        results[f"change_1x{suffix}"] = xr.full_like(
            results["noise_band_level"].isel(noise_band=0, drop=True), change + value
        )
    replayed = replay(recorded(EVEN), results, "ring", PAIR, NominalSpeed(2900.0))
    line = replayed.summary.sel(channel="mic", line="order 1")
    assert line["replayed_line_change"].item() == pytest.approx(change, abs=0.01)
    assert line["replayed_line_change_low"].item() == pytest.approx(change - 2.0, abs=0.01)
    assert line["replayed_line_change_high"].item() == pytest.approx(change + 3.0, abs=0.01)
    totals = replayed.summary.sel(channel="mic", weighting="Z")
    others = np.mean(replayed.after[0] ** 2) - 0.5 * (0.5 * 0.6) ** 2
    louder = others + 0.5 * (0.5 * 0.6) ** 2 * 10.0**0.3
    expected = 10.0 * np.log10(louder / 4e-10)
    assert totals["replayed_total_level_high"].item() == pytest.approx(expected, abs=0.02)
    second = replayed.summary.sel(channel="mic", line="order 2")
    assert np.isnan(second["replayed_line_change_low"])


def test_noise_bands_that_change():
    results = replay_study([2900.0])
    assert changed_noise_bands(results, "hood", "front") == [1000.0]
    assert changed_noise_bands(results, "ring", "front") == []
    silent = results.drop_vars(["noise_band_level", "unmodelled_band_level"])
    assert changed_noise_bands(silent, "hood", "front") == []


REFUSED = {
    "speeds": (
        {"recording": recorded(RISING), "speed": SpeedChannel("speed")},
        r"recording: speed: the recording has 1550 to 2550 rpm, .* add to its speed_rpm: 1550, ",
    ),
    "noise": ({"option": "hood"}, "hood: changes the noise too, in 1 third .* --orders-only"),
    "unit": ({"recording": recorded(EVEN, "m/s²")}, "mic is in m/s², the response in Pa"),
    "channel": ({"pairs": {"front": "front"}}, "no channel 'front'; there are mic, speed"),
    "response": ({"pairs": {"mic": "rear"}}, "response = rear: must be one of front"),
    "option": ({"option": "none"}, "option = none: must be one of ring, hood"),
    "no pair": ({"pairs": {}}, "pair: none given"),
    "bandwidth": ({"bandwidth_hz": 20.0}, "bandwidth = 20 Hz: must be above 0 and up to 6.04 Hz"),
}


@pytest.mark.parametrize(("changed", "message"), REFUSED.values(), ids=REFUSED)
def test_refused(changed, message):
    asked = {
        "recording": recorded(EVEN),
        "results": replay_study([2900.0]),
        "option": "ring",
        "pairs": PAIR,
        "speed": NominalSpeed(2900.0),
    }
    with pytest.raises(ParameterError, match=message):
        replay(**{**asked, **changed})
