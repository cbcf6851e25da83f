"""Overall level and loudest orders of a run-up, against levels of the tones it is made of."""

import numpy as np
import pytest

from vibroacoustics import OrderAnalysis, SpeedChannel, analyse_orders, label_recording
from vibroacoustics.levels import a_weighting
from vibroacoustics.levels.recorded import windowed_mean_square
from vibroacoustics.orders import block_orders
from vibroacoustics.orders.loud_lines import a_weighted_power, band_power, standing_out
from vibroacoustics.report.recordings import analysis_of_orders
from vibroacoustics.report.run_up_tables import every_loudest, loudest_table
from vibroacoustics.results.over_speed.loudest_orders import (
    loudest_orders,
)

RATE_HZ = 4096.0
TIME_S = np.arange(int(20.0 * RATE_HZ)) / RATE_HZ
PEAKS_PA = {1.0: 0.5, 3.0: 0.2, 7.5: 0.1}


def recording_of(first_hz: float, last_hz: float):
    """Three tones as sound pressure and ten times as large as acceleration, with the speed."""
    rise = (last_hz - first_hz) / TIME_S[-1]
    angle = 2.0 * np.pi * (first_hz * TIME_S + 0.5 * rise * TIME_S**2)
    noise = 1e-3 * np.random.default_rng(1).standard_normal(TIME_S.size)
    signal = noise + sum(peak * np.cos(order * angle) for order, peak in PEAKS_PA.items())
    speed_rpm = 60.0 * (first_hz + rise * TIME_S)
    units = ["Pa", "m/s²", "rpm"]
    return label_recording([signal, 10 * signal, speed_rpm], RATE_HZ, ["mic", "foot", "n"], units)


SETTINGS = OrderAnalysis(SpeedChannel("n"), orders=(1.0, 2.0), with_map=None)


@pytest.fixture(scope="module")
def orders():
    return analyse_orders(recording_of(20.0, 60.0), SETTINGS)


def tone_db(order, speed_rpm, weighted=True):
    weight = a_weighting(order * speed_rpm / 60.0) if weighted else 0.0
    return 20.0 * np.log10(PEAKS_PA[order] / np.sqrt(2.0) / 20e-6) + weight


def test_levels_are_those_of_the_tones(orders):
    found = loudest_orders(orders, "mic")
    assert (found.unit, found.reference) == ("Pa", "dB(A)")
    assert found.order.tolist() == [1.0, 3.0, 7.5]
    assert np.all(np.diff(found.speed_rpm) >= 0.0)
    for order, level_db in zip(found.order, found.level_db, strict=True):
        np.testing.assert_allclose(level_db, tone_db(order, found.speed_rpm), atol=0.15)
    total = 10.0 * np.log10(sum(10.0 ** (tone_db(k, found.speed_rpm) / 10.0) for k in PEAKS_PA))
    known = np.isfinite(found.overall_db)
    assert known.mean() > 0.97
    np.testing.assert_allclose(found.overall_db[known], total[known], atol=0.2)


def test_other_units_are_levels_of_the_effective_value_without_overall(orders):
    found = loudest_orders(orders, "foot")
    assert found.reference == "dB re 1 m/s²"
    assert found.overall_db is None
    at = int(np.flatnonzero(found.order == 3.0)[0])
    np.testing.assert_allclose(found.level_db[at], 20.0 * np.log10(2.0 / np.sqrt(2.0)), atol=0.1)


def test_bands_of_the_map_are_those_of_the_analysis(orders):
    peak = orders["order_map"].sel(channel="foot").transpose("block", "map_order").values
    lines = 1.5  # noise bandwidth of a Hann window
    power = 0.5 * np.abs(peak) ** 2 / lines
    band = band_power(power, orders["map_order"].values, np.array([1.0, 2.0]), 2.0 / 3.0)
    rms = orders["block_order_rms"].sel(channel="foot").transpose("block", "order").values
    np.testing.assert_allclose(np.sqrt(band), rms, rtol=1e-6)


def test_overall_level_is_that_of_the_windowed_block():
    """Parseval: against the lines of the block's spectrum, of noise whose power changes."""
    rng = np.random.default_rng(2)
    rate_hz, tick = 1000.0, 10
    signal = rng.standard_normal(5000) * np.linspace(0.1, 2.0, 5000)
    energy = (signal**2).reshape(-1, tick).sum(axis=1) / rate_hz
    found = windowed_mean_square(
        energy, tick / rate_hz, (0.0, 5.0), np.array([2.0, 3.3]), np.array([0.8, 2.0])
    )
    for mean_square, (first, length) in zip(found, ((1600, 800), (2300, 2000)), strict=True):
        window = np.sin(np.pi * (np.arange(length) + 0.5) / length) ** 2
        spectrum = np.fft.fft(signal[first : first + length] * window)
        wanted = np.sum(np.abs(spectrum) ** 2) / length / np.sum(window**2)
        assert 10.0 * np.log10(mean_square / wanted) == pytest.approx(0.0, abs=0.02)


def test_what_is_not_measured_is_omitted():
    """Ticks without samples at the ends do not lower the level; too few samples are no level."""
    energy = np.full(100, 4.0 * 0.01)
    energy[:10] = 0.0
    energy[10] /= 2.0
    middle_s = np.array([0.2, 0.02, 0.9, 0.05])
    found = windowed_mean_square(energy, 0.01, (0.105, 1.0), middle_s, np.full(4, 0.3))
    np.testing.assert_allclose(found, [4.0, np.nan, 4.0, np.nan], rtol=1e-12)


def test_lines_stand_out_of_noise():
    power = np.ones(121)
    power[[18, 19, 60, 100]] = [50.0, 40.0, 9.0, 3.0]
    map_order = np.arange(121) / 6.0
    assert standing_out(power, map_order, 2.0 / 3.0).tolist() == [3.0, 10.0]


def test_weighting_of_order_0_is_silence():
    gain = a_weighted_power(np.array([0.0, 20.0]), np.array([3000.0]))
    assert gain[0, 0] < 1e-10
    assert gain[0, 1] == pytest.approx(1.0, abs=1e-9)  # 1 kHz


def test_the_map_of_a_run_up_is_kept_and_of_a_steady_speed_is_not(monkeypatch):
    steady = analyse_orders(recording_of(40.0, 40.1), SETTINGS)
    assert "order_map" not in steady
    assert "block_level" in steady
    assert every_loudest(steady) == []
    monkeypatch.setattr(block_orders, "MOST_UNASKED_MAP_BYTES", 1000)
    assert "order_map" not in analyse_orders(recording_of(20.0, 60.0), SETTINGS)


def test_table_and_charts_of_the_page(orders):
    analysis = analysis_of_orders(orders)
    charts = [chart["name"] for chart in analysis.json()["charts"]]
    assert charts == ["run_up_1_mic", "map_1_mic", "spectrum_1_mic",
                      "run_up_2_foot", "map_2_foot", "spectrum_2_foot",
                      "velocity_over_speed"]  # fmt: skip
    rows = {row[:2]: row[2:] for row in loudest_table(every_loudest(orders)).rows}
    level, reference, rpm, hertz = rows["mic", "7.5×"]
    assert reference == "dB(A)"
    assert float(level) == pytest.approx(tone_db(7.5, float(rpm)), abs=0.2)
    assert float(hertz) == pytest.approx(7.5 * float(rpm) / 60.0, abs=0.2)
    assert ("mic", "overall") in rows
    assert ("foot", "overall") not in rows
