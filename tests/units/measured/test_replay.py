"""Replay of an option in synthetic recordings: orders, residual, what stays, and refusals."""

import json

import numpy as np
import pytest
from replay_study import ratio, replay_study

from vibroacoustics import NominalSpeed, SpeedChannel, TacholessSpeed, label_recording, replay
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.measured.option_ratios import changed_noise_bands, option_ratios
from vibroacoustics.report.replay import analysis_of_replay

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


def test_a_run_up_between_speeds_that_are_far_apart():
    """Five speeds from 1550 to 2550 rpm, 13 % apart; each order errs by less than is said."""
    results = replay_study([1550.0, 1755.0, 1988.0, 2251.0, 2550.0])
    replayed = replay(recorded(RISING), results, "ring", PAIR, SpeedChannel("speed"))
    wanted = sound(RISING, (1.0, 2.0, 3.0)) + NOISE
    assert replayed.summary.attrs["speed_gap"] == pytest.approx(0.133, abs=1e-3)
    # The formula's amplitude is constant; its phase, linear in the speed, is kept as a chord.
    assert replayed.summary.attrs["interpolation_error_db"] < 0.01
    assert np.std(replayed.after[0] - wanted) < 0.02 * np.std(wanted - replayed.before[0])


def test_what_cannot_be_interpolated_stays():
    """A ratio that changes its sign between speeds; with two of them nothing is known of it."""
    results = replay_study([1550.0, 1755.0, 1988.0, 2251.0, 2550.0])
    results["pressure_line"][2, 1, :, 0, 1] *= -1.0
    replayed = replay(recorded(RISING), results, "ring", PAIR, SpeedChannel("speed"))
    reasons = json.loads(replayed.summary.attrs["unchanged"])["mic"]
    assert reasons["order 1"] == "the study's speeds are too far apart to interpolate its ratio"
    two = replay(recorded(RISING), results.isel(speed=[0, 4]), "ring", PAIR, SpeedChannel("speed"))
    assert np.isnan(two.summary.attrs["interpolation_error_db"])
    assert two.summary["replayed_line_change_low"].isnull().all()


def test_an_order_above_the_frequencies_of_the_study_keeps_its_last_ratio():
    """At the two fastest speeds the study has no order 3, with the option or without."""
    results = replay_study(RUN_UP)
    wanted = option_ratios(results, "ring", "front", 1550.0, RUN_UP[-1]).orders[2].ratio
    results["pressure_line"][-2:, :, :, 0, 3] = 0.0
    found = option_ratios(results, "ring", "front", 1550.0, RUN_UP[-1]).orders[2]
    assert found.line == "order 3"
    np.testing.assert_allclose(found.ratio[:-2], wanted[:-2])
    np.testing.assert_allclose(found.ratio[-2:], wanted[-3])


def test_an_error_between_speeds_widens_the_interval():
    results = replay_study([1550.0, 1755.0, 1988.0, 2251.0, 2550.0])
    narrow = option_ratios(results, "ring", "front", 1550.0, 2550.0).orders[0]
    results["pressure_line"][2, 1, :, 0, 1] *= 1.2
    wide = option_ratios(results, "ring", "front", 1550.0, 2550.0).orders[0]
    assert wide.error == pytest.approx(1.0 / 6.0)  # 1 in place of 1.2; its neighbours have 0.1
    np.testing.assert_allclose(wide.high[[0, 4]], 7.0 / 6.0 * narrow.high[[0, 4]])
    np.testing.assert_allclose(wide.low[[0, 4]], narrow.low[[0, 4]] * 6.0 / 7.0)


def test_only_speeds_of_the_study_are_replayed():
    """From 5 % below 1800 to 5 % above 2200 rpm."""
    speeds = [1800.0, 1880.0, 1960.0, 2040.0, 2120.0, 2200.0]
    replayed = replay(recorded(RISING), replay_study(speeds), "ring", PAIR, SpeedChannel("speed"))
    first, end = (
        round(replayed.summary.attrs[f"replayed_{side}_s"] * RATE) for side in ("from", "to")
    )
    assert RISING[first] == pytest.approx(1710.0, abs=2.0)
    assert RISING[end] == pytest.approx(2310.0, abs=2.0)
    first_sentence = analysis_of_replay(replayed.summary, {}).summary[0]
    assert first_sentence.startswith("Replayed from 3.2")
    assert "the recording has 1550 to 2550 rpm, the study 1800 to 2200." in first_sentence
    within = np.clip(RISING, 1800.0, 2200.0)
    angle = shaft(RISING)
    change = sum(
        np.real(PEAKS[order] * (ratio(order, within) - 1.0) * np.exp(1j * order * angle))
        for order in (1.0, 2.0, 3.0)
    )[first:end]
    inner = slice(int(0.5 * RATE), -int(0.5 * RATE))
    error = (replayed.after - replayed.before)[0] - change
    assert np.std(error[inner]) < 0.02 * np.std(change[inner])


def test_what_stays_is_listed():
    replayed = replay(recorded(EVEN), replay_study([2900.0]), "ring", PAIR, NominalSpeed(2900.0))
    assert json.loads(replayed.summary.attrs["unchanged"]) == {
        "mic": {
            "order 4": "the study has it with the option only",
            "order 5": "the ratio exceeds 20 dB",
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


def test_each_order_has_the_interval_of_the_study():
    """Ends of the total are those of all orders together."""
    results = replay_study([2900.0])
    replayed = replay(recorded(EVEN), results, "ring", PAIR, NominalSpeed(2900.0))
    gain = np.abs([ratio(order, 2900.0) for order in (1.0, 2.0, 3.0)])
    change = 20.0 * np.log10(gain)
    lines = replayed.summary.sel(channel="mic", line=["order 1", "order 2", "order 3"])
    np.testing.assert_allclose(lines["replayed_line_change"], change, atol=0.01)
    np.testing.assert_allclose(lines["replayed_line_change_low"], change - 2.0, atol=0.01)
    np.testing.assert_allclose(lines["replayed_line_change_high"], change + 3.0, atol=0.01)
    totals = replayed.summary.sel(channel="mic", weighting="Z")
    orders = 0.5 * np.sum((np.array([0.5, 0.3, 0.2]) * gain) ** 2)
    for end, more in (("low", -2.0), ("high", 3.0)):
        square = np.mean(replayed.after[0] ** 2) + orders * (10.0 ** (more / 10.0) - 1.0)
        expected = 10.0 * np.log10(square / 4e-10)
        assert totals[f"replayed_total_level_{end}"].item() == pytest.approx(expected, abs=0.02)


def test_results_without_samples_have_no_interval():
    results = replay_study([2900.0]).drop_vars(
        ["order_change", "order_change_10_percent", "order_change_90_percent"]
    )
    replayed = replay(recorded(EVEN), results, "ring", PAIR, NominalSpeed(2900.0))
    assert replayed.summary["replayed_line_change_low"].isnull().all()


def test_a_recorded_shaft_that_is_geared_to_the_study():
    """A tacho shaft at 1160 rpm drives the study's shaft by 2.5: its orders are those of 2900."""
    results = replay_study([2900.0])
    wanted = replay(recorded(EVEN), results, "ring", PAIR, NominalSpeed(2900.0))
    geared = replay(
        recorded(EVEN), results, "ring", PAIR, NominalSpeed(1160.0), shaft_ratio=2.5
    )  # fmt: skip
    np.testing.assert_allclose(geared.after, wanted.after, atol=1e-9)
    with pytest.raises(ParameterError, match="the recording has 1160 rpm, the study 2900: they"):
        replay(recorded(EVEN), results, "ring", PAIR, NominalSpeed(1160.0))


def test_lines_of_two_shafts_at_one_order_are_refused():
    results = replay_study([2900.0])
    results["line_order"][3] = 2.0
    results["line"] = [*results["line"].values[:3], "pump 1", *results["line"].values[4:]]
    with pytest.raises(ParameterError, match="'order 2' and 'pump 1' are both at order 2 of"):
        replay(recorded(EVEN), results, "ring", PAIR, NominalSpeed(2900.0))


def test_an_order_of_another_shaft_is_replayed_by_its_ratio():
    """Line `order 3` belongs to a shaft 1.37 times as fast, its second order."""
    results = replay_study([2900.0])
    results["line_order"][3] = 2.74
    angle = shaft(EVEN)
    second = 0.1 * np.cos(2.74 * angle)
    mic = sound(EVEN) + second + NOISE
    recording = label_recording([mic], RATE, ["mic"], ["Pa"])
    replayed = replay(recording, results, "ring", PAIR, NominalSpeed(2900.0))
    gain = ratio(3.0, 2900.0)
    wanted = sound(EVEN, (1.0, 2.0)) + np.real(0.1 * gain * np.exp(2.74j * angle)) + NOISE
    assert np.std(replayed.after[0] - wanted) < 0.01 * np.std(wanted - mic)


def test_noise_bands_that_change():
    results = replay_study([2900.0])
    assert changed_noise_bands(results, "hood", "front") == [1000.0]
    assert changed_noise_bands(results, "ring", "front") == []
    silent = results.drop_vars(["noise_band_level", "unmodelled_band_level"])
    assert changed_noise_bands(silent, "hood", "front") == []


REFUSED = {
    "speeds": (
        {"recording": recorded(RISING), "speed": SpeedChannel("speed")},
        r"recording: speed: the recording has 1550 to 2550 rpm, the study 2900: they must overlap",
    ),
    "noise": ({"option": "hood"}, "hood: changes the noise too, in 1 third .* --orders-only"),
    "unit": ({"recording": recorded(EVEN, "m/s²")}, "mic is in m/s², the response in Pa"),
    "channel": ({"pairs": {"front": "front"}}, "no channel 'front'; there are mic, speed"),
    "response": ({"pairs": {"mic": "rear"}}, "response = rear: must be one of front"),
    "option": ({"option": "none"}, "option = none: must be one of ring, hood"),
    "no pair": ({"pairs": {}}, "pair: none given"),
    "ratio": ({"shaft_ratio": 0.0}, "shaft_ratio = 0: must be 0.01 to 100"),
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
