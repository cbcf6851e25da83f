"""The table of orders has what is loud."""

import numpy as np
import pytest

import vibroacoustics as va
from vibroacoustics.measured import block_pass
from vibroacoustics.orders.loud_lines import loud_orders
from vibroacoustics.report.recordings import analysis_of_orders

RATE_HZ = 8192.0


def recording(peaks_of_channels, duration_s=10.0, first_rpm=1500.0, last_rpm=3000.0):
    """A run-up with orders of given peaks in each channel of sound pressure."""
    time_s = np.arange(int(duration_s * RATE_HZ)) / RATE_HZ
    speed_rpm = first_rpm + (last_rpm - first_rpm) * time_s / duration_s
    angle = 2.0 * np.pi * np.cumsum(speed_rpm / 60.0) / RATE_HZ
    noise = 1e-3 * np.random.default_rng(0).standard_normal((len(peaks_of_channels), time_s.size))
    signals = noise + [
        sum(peak * np.cos(order * angle) for order, peak in peaks.items())
        for peaks in peaks_of_channels
    ]
    names = [f"microphone {number}" for number in range(len(signals))]
    units = ["Pa"] * len(signals) + ["rpm"]
    return va.label_recording([*signals, speed_rpm], RATE_HZ, [*names, "speed"], units)


SETTINGS = va.OrderAnalysis(va.SpeedChannel("speed"), orders=(), with_map=None)
LOUD = {1.0: 0.1, 12.0: 1.0}


@pytest.fixture(scope="module")
def results():
    return va.analyse_orders(recording([LOUD]), SETTINGS)


def test_the_loudest_order_is_in_sentence_and_table(results):
    """Order 12 is 20 dB above the first and named by the sentence at the top."""
    assert results["order"].values.tolist() == [1.0, 2.0, 12.0]
    analysis = analysis_of_orders(results)
    assert "12×" in " ".join(analysis.summary)
    assert set(analysis.tables["orders.csv"]["order"]) == {1.0, 2.0, 12.0}
    peak = np.abs(results["channel_order"].sel(order=12.0)).max("speed")
    np.testing.assert_allclose(peak, 1.0, rtol=0.01)


def test_orders_on_lines_are_those_of_the_same_orders_by_name(results):
    named = va.analyse_orders(
        recording([LOUD]), va.OrderAnalysis(va.SpeedChannel("speed"), (1.0, 2.0, 12.0))
    )
    for name in ("channel_order", "channel_order_rms", "block_order"):
        np.testing.assert_allclose(results[name], named[name], atol=1e-12)


def test_each_channel_has_its_loudest_order_before_second_ones():
    peaks = [{3.0: 1.0, 5.0: 0.9, 7.0: 0.8, 9.0: 0.7}, {11.0: 0.01}]
    results = va.analyse_orders(recording(peaks), SETTINGS)
    order = results["order"].values.tolist()
    assert len(order) == 6
    assert {1.0, 2.0, 11.0} <= set(order)


def test_loud_orders_are_weighted_and_six():
    """Order 1 at 50 Hz is 30 dB lower by A than order 20 at 1 kHz of the same peak."""
    map_order = np.arange(0.0, 25.0, 1.0 / 6.0)
    amplitude = np.full((1, 4, map_order.size), 1e-4, dtype=complex)
    for order in range(3, 22, 2):
        amplitude[..., 6 * order] = 1.0 - 1e-3 * order
    speed_rpm = np.full(4, 3000.0)
    sound = loud_orders(amplitude, map_order, speed_rpm, 2.0 / 3.0, np.array([True]))
    assert len(sound) == 6
    assert min(set(sound) - {1.0, 2.0}) > 13.0
    other = loud_orders(amplitude, map_order, speed_rpm, 2.0 / 3.0, np.array([False]))
    assert other == (1.0, 2.0, 3.0, 5.0, 7.0, 9.0)


def test_a_long_recording_has_the_loudest_orders_of_its_parts(results, monkeypatch):
    monkeypatch.setattr(block_pass, "MOST_UNASKED_MAP_BYTES", 0)
    monkeypatch.setattr(block_pass, "_PART_SHARE", 0.9)
    monkeypatch.setattr(block_pass, "_PARTS", 4)
    in_parts = va.analyse_orders(recording([LOUD]), SETTINGS)
    assert in_parts["order"].values.tolist() == results["order"].values.tolist()


def test_the_loudest_channel_of_sound_comes_first():
    """Six channels with an order each: of vibration, which is louder, two find no place."""
    map_order = np.arange(0.0, 25.0, 1.0 / 6.0)
    amplitude = np.full((6, 4, map_order.size), 1e-6, dtype=complex)
    for channel, order in enumerate((5, 7, 9, 11, 13, 15)):
        amplitude[channel, :, 6 * order] = 1.0 + channel
    is_sound = np.array([False] * 4 + [True] * 2)
    amplitude[is_sound] *= 1e-3
    orders = loud_orders(amplitude, map_order, np.full(4, 3000.0), 2.0 / 3.0, is_sound)
    assert orders == (1.0, 2.0, 9.0, 11.0, 13.0, 15.0)
