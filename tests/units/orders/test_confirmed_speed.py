"""A speed beside the sound: what is late, held, frozen or in another unit is mended or named."""

import warnings

import numpy as np
import pytest
from clean_recordings import clean_recordings, clean_tacholess

import vibroacoustics as va
from vibroacoustics.orders.lag_evidence import scale_lag
from vibroacoustics.orders.recorded_speed import recorded_speed
from vibroacoustics.orders.speed_lag import SpeedLag
from vibroacoustics.recordings import LabelledBlocks

RATE_HZ = 8192.0
TIME_S = np.arange(int(20.0 * RATE_HZ)) / RATE_HZ
RPM = 900.0 + 2100.0 * TIME_S / 20.0
ANGLE = 2.0 * np.pi * np.cumsum(RPM / 60.0) / RATE_HZ
SOUND = np.cos(8.0 * ANGLE) + 0.05 * np.random.default_rng(0).standard_normal(TIME_S.size)


def late_rpm(lag_s):
    return np.interp(TIME_S - lag_s, TIME_S, RPM)


def held_rpm(hold_s):
    samples = int(hold_s * RATE_HZ)
    return RPM[np.arange(RPM.size) // samples * samples]


def frozen_rpm(start_s, end_s):
    first, last = int(start_s * RATE_HZ), int(end_s * RATE_HZ)
    rpm = RPM.copy()
    rpm[first:last] = rpm[first]
    return rpm


def faulty_rpm(value, samples):
    """The speed with ten faults of a value."""
    starts = np.random.default_rng(1).integers(2000, TIME_S.size - 2000, 10)
    rpm = RPM.copy()
    for start in starts:
        rpm[start : start + samples] = value
    return rpm


def analysed(channel, unit="rpm", speed=None, sound=SOUND):
    """Median of order 8 over the speeds, and the sentences on the speed."""
    recording = va.label_recording([sound, channel], RATE_HZ, ["front", "n"], ["Pa", unit])
    settings = va.OrderAnalysis(speed or va.SpeedChannel("n"), (8.0,))
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        results = va.analyse_orders(recording, settings)
    peak = np.abs(results["channel_order"].sel(channel="front", order=8.0).values)
    return float(np.median(peak)), [str(each.message) for each in caught]


@pytest.mark.parametrize("lag_s", [0.05, 0.1, 0.2, 0.5, -0.1])
def test_a_lag_is_corrected_and_named(lag_s):
    peak, sentences = analysed(late_rpm(lag_s))
    assert peak == pytest.approx(1.0, abs=0.01)
    (sentence,) = sentences
    word = "late" if lag_s > 0 else "early"
    assert f"{word} beside lines of the sound (near orders " in sentence
    assert sentence.endswith(": corrected")
    assert float(sentence.split()[1]) == pytest.approx(abs(lag_s), abs=0.001)


@pytest.mark.parametrize(
    ("rpm", "words"),
    [
        (held_rpm(0.1), "its values are held for 0.1 s: corrected"),
        (frozen_rpm(8.0, 9.0), "frozen of 1740 rpm from 8.02 to 9.022 s"),
        (faulty_rpm(0.0, 160), "drop-out of 0 rpm"),
        (faulty_rpm(0.0, 2000), "drop-out of 0 rpm from"),
        (faulty_rpm(20000.0, 5), "spike of 20000 rpm"),
    ],
)
def test_faults_of_a_speed_channel_are_mended_and_named(rpm, words):
    peak, sentences = analysed(rpm)
    assert peak == pytest.approx(1.0, abs=0.02)
    (sentence,) = sentences
    assert words in sentence


@pytest.mark.parametrize(
    ("channel", "unit"),
    [
        (RPM * np.pi / 30.0, "rad/s"),
        (ANGLE % (2.0 * np.pi), "rad"),
        (np.degrees(ANGLE) % 360.0, "°"),
        (-ANGLE % (2.0 * np.pi), "rad"),
        (ANGLE, "rad"),
    ],
)
def test_units_of_speed_and_angle_are_recognised(channel, unit):
    peak, sentences = analysed(channel, unit)
    assert peak == pytest.approx(1.0, abs=0.01)
    assert not sentences


def test_an_angle_gives_the_phase():
    """Order 8 has the phase 0 against the zero of the angle, not against the return to it."""
    recording = va.label_recording(
        [SOUND, ANGLE % (2.0 * np.pi)], RATE_HZ, ["front", "n"], ["Pa", "rad"]
    )
    results = va.analyse_orders(recording, va.OrderAnalysis(va.SpeedChannel("n"), (8.0,)))
    phase = np.angle(results["channel_order"].sel(channel="front", order=8.0))
    assert np.all(np.abs(phase) < 0.02)
    assert results.attrs["angle_zero"] == "zero of n"


def test_a_nominal_speed_beside_the_lines_is_named():
    angle = 2.0 * np.pi * 2950.0 / 60.0 * TIME_S
    sound = np.cos(8.0 * angle) + 0.5 * np.cos(angle) + 0.05 * SOUND
    _, sentences = analysed(SOUND, "V", va.NominalSpeed(3000.0), sound)
    (sentence,) = sentences
    assert "no line of the sound is an order of 3000 rpm, 2 are of 2950 rpm" in sentence
    peak, sentences = analysed(SOUND, "V", va.NominalSpeed(2950.0), sound)
    assert peak == pytest.approx(1.0, abs=0.01)
    assert not sentences


@pytest.mark.parametrize(("factor", "unit"), [(np.pi / 30.0, "rad/s"), (1.0 / 60.0, "Hz")])
def test_a_wrong_unit_is_named(factor, unit):
    _, sentences = analysed(factor * RPM)
    (sentence,) = sentences
    assert f"as a speed in {unit} it has lines at orders 8: orders are wrong" in sentence


def test_an_angle_without_its_unit_is_refused():
    with pytest.raises(va.ParameterError, match="as an angle in rad, ° or turns, not as pulses"):
        analysed(ANGLE % (2.0 * np.pi), "V")


def decay(start_hz=60.0, constant_s=14.0):
    """Speed, Hz, and sound of orders 1, 2, 4 and 8 of a coast-down."""
    hertz = start_hz * np.exp(-TIME_S / constant_s)
    angle = 2.0 * np.pi * np.cumsum(hertz) / RATE_HZ
    return hertz, sum(np.cos(order * angle + order) for order in (1, 2, 4, 8)) + 0.05 * SOUND


@pytest.mark.parametrize(
    ("factor", "words"),
    [
        (np.pi / 30.0, "as a speed in rad/s it has lines at orders "),
        (1.0 / 60.0, "as a speed in Hz it has lines at orders "),
        (0.97, "no line of the sound is an order of it, all 4 are of 1.031 times the speed"),
    ],
)
def test_a_wrong_factor_of_a_decay_is_named(factor, words):
    """The lines of a decay fix no lag: their orders alone show the factor."""
    hertz, sound = decay()
    _, (sentence,) = analysed(60.0 * factor * hertz, sound=sound)
    assert words in sentence


def test_a_dwell_before_a_ramp_is_not_frozen():
    rpm = np.interp(TIME_S, [0.0, 5.0, 7.0, 12.0, 14.0, 20.0], [900, 900, 2080, 2080, 3260, 3260])
    sound = np.cos(8.0 * 2.0 * np.pi * np.cumsum(rpm / 60.0) / RATE_HZ) + 0.05 * SOUND
    peak, sentences = analysed(rpm, sound=sound)
    assert peak == pytest.approx(1.0, abs=0.02)
    assert not sentences


@pytest.mark.parametrize("lag_s", [0.05, 0.2])
def test_the_lag_of_a_decay_follows_from_two_lines(lag_s):
    """Where f'/f is constant a lag shifts all orders alike, off whole ones."""
    hertz = 60.0 * np.exp(-TIME_S / 14.0)
    angle = 2.0 * np.pi * np.cumsum(hertz) / RATE_HZ
    sound = np.cos(8.0 * angle) + np.cos(2.0 * angle) + 0.05 * SOUND
    rpm = 60.0 * np.interp(TIME_S - lag_s, TIME_S, hertz)
    peak, sentences = analysed(rpm, sound=sound)
    assert peak == pytest.approx(1.0, abs=0.02)
    assert float(sentences[0].split()[1]) == pytest.approx(lag_s, abs=0.01)


def test_one_line_of_a_decay_is_named():
    hertz = 60.0 * np.exp(-TIME_S / 14.0)
    sound = np.cos(16.0 * np.pi * np.cumsum(hertz) / RATE_HZ) + 0.05 * SOUND
    rpm = 60.0 * np.interp(TIME_S - 0.2, TIME_S, hertz)
    _, (sentence,) = analysed(rpm, sound=sound)
    assert "0.2 s late" in sentence
    assert "not corrected, orders read too low" in sentence


def test_a_lag_without_lines_before_has_no_scale():
    lag = SpeedLag(
        0.3, 0.001, 5.0, np.array([2.0]), np.empty(0), -0.07, 0.0, TIME_S[:1], RPM[:1], 1.0
    )
    assert scale_lag(lag) == 0.0


def sentences_of(clean):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            recorded_speed(LabelledBlocks(clean.recording), clean.speed)
        except va.ParameterError as error:
            return [str(error)]
    return [str(each.message) for each in caught]


def test_clean_recordings_have_no_sentence():
    named = {each.name: sentences_of(each) for each in clean_recordings(20)}
    assert not {name: words for name, words in named.items() if words}


@pytest.mark.long
def test_a_hundred_clean_recordings_have_no_sentence():
    recordings = [*clean_recordings(120, seed=1), *clean_tacholess(4, seed=1)]
    named = {each.name: sentences_of(each) for each in recordings}
    assert not {name: words for name, words in named.items() if words}
