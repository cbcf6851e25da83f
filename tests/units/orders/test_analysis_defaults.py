"""Defaults of commands refuse no recording that holds an order."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import vibroacoustics as va

AMPLITUDE_PA = 2.0


def recording(rate_hz, rpm, samples, channels=1):
    angle = 2.0 * np.pi * rpm / 60.0 * np.arange(samples) / rate_hz
    signal = [AMPLITUDE_PA * np.cos(angle)] * channels
    names = [f"microphone {number}" for number in range(channels)]
    return va.label_recording(signal, rate_hz, names, ["Pa"] * channels)


def analysed(rate_hz, rpm, samples, channels=1, **stated):
    analysis = va.OrderAnalysis(va.NominalSpeed(rpm), **stated)
    return va.analyse_orders(recording(rate_hz, rpm, samples, channels), analysis)


@settings(max_examples=25, deadline=None, derandomize=True)
@given(
    rate_hz=st.floats(400.0, 200e3),
    rpm=st.floats(60.0, 60e3),
    samples=st.integers(1000, 20_000),
    channels=st.integers(1, 8),
)
@pytest.mark.filterwarnings("ignore")
def test_no_default_refuses_a_recording(rate_hz, rpm, samples, channels):
    check_orders(rate_hz, rpm, samples, channels)


@settings(max_examples=60, deadline=None, derandomize=True)
@given(
    rate_hz=st.floats(400.0, 200e3),
    rpm=st.floats(60.0, 60e3),
    duration_s=st.floats(0.5, 60.0),
    channels=st.integers(1, 8),
)
@pytest.mark.long
@pytest.mark.filterwarnings("ignore")
def test_no_default_refuses_a_long_recording(rate_hz, rpm, duration_s, channels):
    samples = int(rate_hz * duration_s)
    check_orders(rate_hz, rpm, samples, 1 if samples > 100_000 else channels)


def check_orders(rate_hz, rpm, samples, channels):
    """Order 1 is right wherever the recording holds it; else the refusal names the recording."""
    turns, limit = rpm / 60.0 * (samples - 1) / rate_hz, 0.9 * rate_hz / (2.0 * rpm / 60.0)
    if turns < 1.0 or limit < 4.0 / 3.0:
        with pytest.raises(va.ParameterError, match=r"record longer|order 1 needs"):
            analysed(rate_hz, rpm, samples, channels)
        return
    orders = analysed(rate_hz, rpm, samples, channels)
    first = np.abs(orders["channel_order"].sel(order=1.0).values)
    # The low-pass before the angle passes 1 ± 1e-5; other lines of the window are exact zeros.
    np.testing.assert_allclose(first, AMPLITUDE_PA, rtol=1e-4)


@pytest.mark.parametrize(
    ("rate_hz", "rpm", "samples", "wanted"),
    [
        (1024.0, 1500.0, 10_240, [1.0, 2.0, 3.0, 4.0]),
        (400.0, 3000.0, 4000, [1.0, 2.0, 3.0]),  # 3.6 orders below 180 Hz
        (1024.0, 12_000.0, 4096, [1.0]),  # 2.3 orders; the band of 2 ends at 2.33
    ],
)
def test_default_orders_are_those_that_the_rate_holds(rate_hz, rpm, samples, wanted):
    orders = analysed(rate_hz, rpm, samples)
    assert orders["order"].values.tolist() == wanted
    assert orders["map_order"].values[-1] <= 0.9 * rate_hz / (2.0 * rpm / 60.0)


def test_what_the_user_states_is_refused_by_its_value():
    with pytest.raises(va.ParameterError, match=r"maximum_order = 20: .* at most 18\.43"):
        analysed(1024.0, 1500.0, 10_240, maximum_order=20.0)
    with pytest.raises(va.ParameterError, match=r"orders = 4: must be at most 3\.267 at"):
        analysed(400.0, 3000.0, 4000, orders=(1.0, 2.0, 3.0, 4.0))
    with pytest.raises(va.ParameterError, match=r"resolution_order = 0\.25: needs blocks of 6"):
        analysed(1024.0, 600.0, 512, resolution_order=0.25)


@pytest.mark.parametrize(("seconds", "is_fit"), [(0.5, False), (0.2, True)])
def test_a_few_revolutions_take_coarser_blocks_or_a_fit(seconds, is_fit):
    orders = analysed(8192.0, 600.0, int(8192 * seconds))
    assert ("least squares" in orders.attrs["window"]) is is_fit
    assert abs(orders["channel_order"].sel(order=1.0).item()) == pytest.approx(2.0, rel=1e-4)


def test_default_orders_that_are_tracked():
    source = va.NominalSpeed(6000.0)
    tracked = va.track_orders(recording(400.0, 6000.0, 1200), source, None, bandwidth_hz=3.0)
    assert tracked["order"].values.tolist() == [1.0]  # 200 Hz is half the sample rate
