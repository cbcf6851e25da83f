"""Coherence and phase of noise alone and of few blocks: not known, never certain."""

import numpy as np
import pytest

import vibroacoustics as va
from vibroacoustics.orders.recorded import mean_orders
from vibroacoustics.report.recordings import analysis_of_orders
from vibroacoustics.study.order_analysis import LEAST_BLOCKS

RATE_HZ = 4096.0


def run_up_in_noise(seed=0, duration_s=4.0, channels=1):
    """600 to 4200 rpm in 4 s: order 1 of 1 Pa in white noise."""
    rng = np.random.default_rng(seed)
    time_s = np.arange(int(duration_s * RATE_HZ)) / RATE_HZ
    speed_rpm = 600.0 + 3600.0 * time_s / duration_s
    angle = 2.0 * np.pi * np.cumsum(speed_rpm / 60.0) / RATE_HZ
    signals = [np.cos(angle) + rng.standard_normal(time_s.size) for _ in range(channels)]
    names = [f"microphone {number}" for number in range(channels)]
    return va.label_recording(
        [*signals, speed_rpm], RATE_HZ, [*names, "speed"], ["Pa"] * channels + ["rpm"]
    )


def orders_of(recording, orders=(1.0, 7.0)):
    return va.analyse_orders(recording, va.OrderAnalysis(va.SpeedChannel("speed"), orders))


def test_coherence_needs_eight_blocks():
    """Of n blocks of which half have the phase 0 and half 90°, |mean|² / mean of squares is 1/2."""
    lines = np.tile([1.0, 1.0j], 8).reshape(1, 16, 1)
    rms = np.full((1, 16, 1), 2.0)
    enough = mean_orders(lines, rms, np.repeat([0, 1], 8), 2)
    np.testing.assert_allclose(enough["channel_order_coherence"], 0.5)
    short = mean_orders(lines, rms, np.repeat([0, 1], [9, 7]), 2)
    assert np.isfinite(short["channel_order_coherence"]).ravel().tolist() == [True, False]
    np.testing.assert_allclose(short["channel_order_rms"], 2.0)
    np.testing.assert_allclose(short["channel_order"][0, 1, 0], (4 * 1.0j + 3) / 7)


def test_a_quick_run_up_has_no_coherence_of_noise():
    results = orders_of(run_up_in_noise())
    coherence = results["channel_order_coherence"]
    is_short = results["block_count"] < LEAST_BLOCKS
    assert is_short.sum() > 10
    assert coherence.where(is_short, drop=True).isnull().all()
    assert not (coherence.sel(order=7.0) > 0.9).any()


def test_cells_without_coherence_are_empty():
    results = orders_of(run_up_in_noise())
    analysis = analysis_of_orders(results)
    table = analysis.tables["orders.csv"]
    short = [number for number, blocks in enumerate(table["blocks"]) if blocks < LEAST_BLOCKS]
    for column in ("phase_deg", "coherence"):
        assert {table[column][number] for number in short} == {""}
    assert all(table["amplitude_peak"][number] > 0.0 for number in short)
    words = " ".join(analysis.shown[0].items)
    speeds = results.sizes["speed"]
    count = int((results["block_count"] < LEAST_BLOCKS).sum())
    assert f"no coherence and phase at {count} of {speeds} speeds" in words


def test_a_comparison_has_no_phase_of_few_blocks():
    results = orders_of(run_up_in_noise())
    results.attrs["angle_zero"] = "pulse of tacho"
    compared = va.compare(results, results)
    has_phase = np.isfinite(compared["order_phase_difference"].values)
    is_enough = results["block_count"].values >= LEAST_BLOCKS
    np.testing.assert_array_equal(has_phase, np.broadcast_to(is_enough[:, None], has_phase.shape))
    assert np.isfinite(compared["order_difference"]).all()


@pytest.mark.long
def test_noise_alone_never_looks_coherent():
    """A steady speed and run-ups of 4 to 40 s: 20,000 cells of noise."""
    for seed in range(20):
        results = orders_of(run_up_in_noise(seed, 4.0 + 2.0 * seed, 4), tuple(np.arange(2.0, 18.0)))
        assert not (results["channel_order_coherence"] > 0.9).any(), seed
