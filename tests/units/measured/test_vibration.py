"""Velocity and displacement of recordings and of predicted feet, against exact integrals."""

import numpy as np
import pytest
from support import tiny_run

import vibroacoustics as va
from vibroacoustics.mechanics.severity import displacement_range, velocity_rms
from vibroacoustics.report import analysis_of_orders

PEAK = 1e-3
"""Peak of the velocity, m/s."""


def severity(signal, rate_hz, unit="m/s²", speed=None, step_rpm=100.0):
    names, units, signals = ["foot"], [unit], [signal]
    source = va.NominalSpeed(600.0)  # blocks hold seven periods of 10 Hz
    if speed is not None:
        names, units, signals = [*names, "speed"], [*units, "rpm"], [*signals, speed]
        source = va.SpeedChannel("speed")
    recording = va.label_recording(signals, rate_hz, names, units)
    settings = va.OrderAnalysis(source, (1.0,), 4.0, speed_step_rpm=step_rpm)
    return va.analyse_orders(recording, settings)


@pytest.mark.parametrize(
    ("hertz", "rate_hz"), [(10.0, 4096.0), (10.3, 25600.0), (160.0, 4096.0), (1000.0, 4096.0)]
)
def test_tones_are_integrated_within_half_a_percent(hertz, rate_hz):
    time = np.arange(int(16.0 * rate_hz)) / rate_hz
    turning = 2.0 * np.pi * hertz
    # An offset of 1 g and a drift are no vibration.
    signal = 9.81 + 0.01 * time + PEAK * turning * np.cos(turning * time + 0.4)
    found = severity(signal, rate_hz)
    assert found["velocity_rms"].item() == pytest.approx(PEAK / 2.0**0.5, rel=0.005)
    blocks = found["block_velocity_rms"].values[0]
    assert np.isfinite(blocks).sum() > 0.8 * blocks.size
    inner = blocks[np.isfinite(blocks)][3:-3]
    assert np.abs(inner / (PEAK / 2.0**0.5) - 1.0).max() < 0.005
    if hertz < 500.0:
        ranges = found["block_displacement"].values[0][np.isfinite(blocks)][3:-3]
        assert np.abs(ranges * turning / (2.0 * PEAK) - 1.0).max() < 0.02


@pytest.mark.parametrize("hertz", [5.0, 9.4, 1010.0])
def test_tones_outside_the_band_do_not_count(hertz):
    time = np.arange(16 * 4096) / 4096.0
    found = severity(np.cos(2.0 * np.pi * hertz * time) + 1e-6 * time, 4096.0)
    assert found["velocity_rms"].item() < 0.003 / (2.0 * np.pi * hertz)


@pytest.mark.parametrize(("unit", "power"), [("m/s²", 1), ("m/s", 0), ("m", -1)])
def test_all_quantities_of_vibration_have_one_velocity(unit, power):
    time = np.arange(16 * 4096) / 4096.0
    turning = 2.0 * np.pi * 40.0
    found = severity(PEAK * turning**power * np.cos(turning * time), 4096.0, unit)
    assert found["velocity_rms"].item() == pytest.approx(PEAK / 2.0**0.5, rel=0.001)


@pytest.mark.parametrize("of_velocity", [False, True])
def test_noise_is_integrated_within_half_a_percent(of_velocity):
    rate_hz, samples = 4096.0, 64 * 4096
    rng, hz = np.random.default_rng(2), np.fft.rfftfreq(samples, 1.0 / rate_hz)
    lines = rng.normal(size=hz.size) + 1j * rng.normal(size=hz.size)
    lines *= hz if of_velocity else 1.0
    lines[0] = 0.0
    in_band = (hz >= 10.0) & (hz <= 1000.0)
    velocity = np.fft.irfft(np.where(in_band, lines / (2j * np.pi * np.maximum(hz, 1.0)), 0.0))
    found = severity(np.fft.irfft(lines), rate_hz)
    omitted = round(found.attrs["velocity_omitted_s"] * rate_hz)
    exact = np.sqrt(np.mean(velocity[omitted:-omitted] ** 2))
    # The edges of 0.2 Hz take in half of them: 1 % of the power of white acceleration.
    assert found["velocity_rms"].item() == pytest.approx(exact, rel=0.007)


def test_velocity_over_a_run_up_is_exact():
    rate_hz, end_s = 4096.0, 30.0
    time = np.arange(int(end_s * rate_hz)) / rate_hz
    hertz = 12.0 * (950.0 / 12.0) ** (time / end_s)
    phase = 2.0 * np.pi * 12.0 * end_s / np.log(950.0 / 12.0) * (hertz / 12.0 - 1.0)
    signal = -PEAK * 2.0 * np.pi * hertz * np.sin(phase)  # derivative of PEAK cos(phase)
    found = severity(signal, rate_hz, speed=60.0 * hertz / 12.0)
    middle_s = found["block_time"].values
    blocks = found["block_velocity_rms"].values[0]
    usable = np.isfinite(blocks) & (middle_s > 2.0) & (middle_s < end_s - 2.0)
    assert usable.sum() > 20
    # Blocks hold many periods: the mean square of the cosine is 1/2.
    assert np.abs(blocks[usable] / (PEAK / 2.0**0.5) - 1.0).max() < 0.005
    analysis = analysis_of_orders(found)
    assert "vibration.csv" in analysis.tables
    assert "Vibration severity, 10 to 1000 Hz" in analysis.text()


def test_recordings_without_vibration_have_none():
    found = severity(np.sin(np.arange(4096.0)), 1024.0, "Pa")
    assert "velocity_rms" not in found


def test_a_fit_of_orders_has_the_velocity_too():
    time = np.arange(4 * 2048) / 2048.0
    signal = PEAK * 100.0 * np.pi * np.cos(100.0 * np.pi * time)
    recording = va.label_recording([signal], 2048.0, ["foot"], ["m/s²"])
    settings = va.OrderAnalysis(va.NominalSpeed(3000.0), (1.0, 2.0), 4.0, is_fit=True)
    found = va.analyse_orders(recording, settings)
    assert found["velocity_rms"].item() == pytest.approx(PEAK / 2.0**0.5, rel=0.005)
    assert "vibration.csv" in analysis_of_orders(found).tables


def test_foot_velocity_agrees_with_its_spectrum():
    results = tiny_run()
    motion = results["velocity_order"].sum("source")
    hz = results["order_frequency"]
    counted = motion.where((hz > 9.999) & (hz < 1000.001), 0.0)
    for foot in results["foot"].values:
        x, y, z = results["foot_position"].sel(foot=foot).values
        tx, ty, tz, rx, ry, rz = (
            counted.sel(dof=name) for name in ("tx", "ty", "tz", "rx", "ry", "rz")
        )
        by_axis = {"x": tx + ry * z - rz * y, "y": ty + rz * x - rx * z, "z": tz + rx * y - ry * x}
        for axis, lines in by_axis.items():
            exact = np.sqrt(0.5 * (np.abs(lines) ** 2).sum("order"))
            found = results["foot_velocity"].sel(foot=foot, axis=axis)
            np.testing.assert_allclose(
                found.values, exact.transpose("speed", "option").values, rtol=1e-9, atol=1e-15
            )


def test_edges_of_the_band_count_whole():
    ones = np.ones(4, dtype=complex)
    assert velocity_rms(ones, np.array([9.99, 10.0, 1000.0, 1000.1])) == pytest.approx(1.0)


def test_displacement_range_is_that_of_the_curve():
    hz = 40.0 * np.arange(5)
    velocity = np.array([9.0, 1.0, 0.5j, 0.0, 0.3 - 0.2j])
    time = np.linspace(0.0, 1.0 / 40.0, 20001)
    moved = np.real(
        np.exp(2j * np.pi * np.outer(time, hz[1:])) @ (velocity[1:] / (2j * np.pi * hz[1:]))
    )
    assert displacement_range(velocity, hz) == pytest.approx(np.ptp(moved), rel=0.001)
