"""Order maps, rpm-frequency maps, order cuts: amplitudes, phases, noise, resolution."""

import warnings
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support import CRANK_ANGLE

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.orders import (
    OrderResolutionWarning,
    angular_resample,
    block_phasors,
    frequency_map,
    mean_order_spectrum,
    order_cut,
    order_lines,
    order_map,
    order_spectrum,
    whole_revolutions,
)
from vibroacoustics.orders.crank_motion import constant_speed, from_speed
from vibroacoustics.orders.windows import WINDOWS

RATE_HZ = 600.0
PEAKS = {1.0: 1.0, 0.5: 0.5, 4.0: np.sqrt(2.0), 6.0: 2.0}
RIPPLE = 1e-5
"""Of the anti-aliasing kernel, 100 dB, relative to each tone."""


@pytest.fixture(scope="module")
def run_up():
    """10 to 40 rev/s in 5 s at 600 Hz: orders 1, 0.5, 4 and 6, phases of their own number."""
    motion = from_speed(np.linspace(0.0, 5.0, 6), np.linspace(10.0, 40.0, 6))
    angle = motion.angle_rad(np.arange(3001) / RATE_HZ)
    signal = sum(peak * np.cos(order * angle + order) for order, peak in PEAKS.items())
    return angular_resample(signal, RATE_HZ, motion, 6.74)


# --- published run-up ----------------------------------------------------------------------------


@pytest.mark.parametrize("window", ["hann", "flat_top"])
@pytest.mark.parametrize("resolution", [0.125, 0.1, 0.0625])
def test_rms_of_the_run_up(run_up, window, resolution):
    """0.7071, 0.3536, 1.0000, 1.4142 to their last digit, in every block, without a warning."""
    spectra = order_map(run_up, resolution, window)
    assert spectra.resolution_order <= resolution
    cut = order_cut(spectra, list(PEAKS))
    expected = [0.7071, 0.3536, 1.0000, 1.4142]
    # Their rounding and the ripple. Where blocks of an odd number of revolutions have order 0.5
    # between two lines, the lobe's share of 5e-4 beyond its zeros is lost besides.
    slack = 5e-5 + RIPPLE * 3.9 + (5e-4 if spectra.revolutions % 2 else 0.0)
    np.testing.assert_allclose(cut.rms, np.broadcast_to(expected, cut.rms.shape), atol=slack)


@pytest.mark.parametrize("window", ["hann", "flat_top"])
def test_orders_that_leak_into_each_other_are_told(run_up, window):
    spectra = order_map(run_up, 0.25, window)
    with pytest.warns(OrderResolutionWarning, match=r"orders 0.5 and 1 leak") as caught:
        order_cut(spectra, [4.0, 1.0, 6.0, 0.5])
    assert len(caught) == 1
    assert caught[0].filename == __file__


def test_warning_begins_where_the_main_lobes_meet(run_up):
    """Hann: four lines from zero to zero, half an order in blocks of eight revolutions."""
    for revolutions, warned in ((7, True), (8, False), (9, False)):
        spectra = order_map(run_up, 1.5 / revolutions)
        assert spectra.revolutions == revolutions
        assert spectra.main_lobe_order == pytest.approx(4.0 / revolutions)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            order_cut(spectra, [0.5, 1.0])
        assert bool(caught) is warned


def test_leak_that_is_warned_of_is_there(run_up):
    spectra = order_map(run_up, 0.25)
    with pytest.warns(OrderResolutionWarning):
        cut = order_cut(spectra, [0.5, 1.0])
    assert np.all(cut.rms[:, 0] > 1.2 * 0.3536)


@pytest.mark.parametrize("window", list(WINDOWS))
def test_phase_against_the_crank_angle(run_up, window):
    """In every block of the run-up to 0.01°, whatever block, speed and window."""
    amplitude = order_lines(
        order_map(run_up, WINDOWS[window].noise_bandwidth_lines / 12, window), list(PEAKS)
    )
    for number, (order, peak) in enumerate(PEAKS.items()):
        error = np.degrees(np.angle(amplitude[:, number] * np.exp(-1j * order)))
        assert np.max(np.abs(error)) < 0.01
        # Side lobes of a rectangular window vanish on the lines, as do those of the others.
        np.testing.assert_allclose(np.abs(amplitude[:, number]), peak, rtol=RIPPLE)


def test_phasors_of_whole_orders_are_the_lines(run_up):
    """The same sum, with its phase factors in another order: rounding of 1e3 terms."""
    signal = replace(run_up, values=np.stack([run_up.values, 2.0 * run_up.values]))
    spectra = order_map(signal, 0.125)
    expected = order_lines(spectra, list(PEAKS))
    np.testing.assert_allclose(
        block_phasors(signal, spectra, list(PEAKS)), expected, rtol=0.0, atol=1e-11
    )


def test_phasor_of_an_order_between_lines():
    """A bearing's order 3.57: on no line, yet whole in amplitude and phase in every block.

    Its mirror image at -3.57 lies 86 lines away, where the window's side lobes are below 1e-6.
    """
    motion = from_speed(np.linspace(0.0, 5.0, 6), np.linspace(10.0, 40.0, 6))
    angle = motion.angle_rad(np.arange(3001) / RATE_HZ)
    signal = angular_resample(0.8 * np.cos(3.57 * angle + 0.4), RATE_HZ, motion, 6.0)
    phasor = block_phasors(signal, order_map(signal, 0.125), [3.57])
    np.testing.assert_allclose(phasor, 0.8 * np.exp(0.4j), rtol=2.0 * RIPPLE)


@pytest.mark.parametrize("order", [0.0, -1.0, 6.75, np.nan])
def test_phasor_of_an_order_that_the_signal_does_not_hold(run_up, order):
    with pytest.raises(ParameterError, match=r"must be above 0 and at most 6\.74"):
        block_phasors(run_up, order_map(run_up, 0.25), [1.0, order])


def test_blocks_are_labelled_with_time_and_mean_speed(run_up):
    """Linear in time, so the mean over a block is the speed at its middle."""
    spectra = order_map(run_up, 0.125, overlap_ratio=0.75)
    assert spectra.time_s.size > 30
    # Times between the samples at 600 Hz are read off straight lines: x'' dt²/8 = 1e-7 s.
    np.testing.assert_allclose(
        spectra.shaft_frequency_hz, 10.0 + 6.0 * spectra.time_s, rtol=0.0, atol=1e-5
    )


def test_mean_spectrum_of_the_run_up(run_up):
    spectra = order_map(run_up, 0.125)
    rms = mean_order_spectrum(spectra)
    lines = [round(order * spectra.revolutions) for order in PEAKS]
    np.testing.assert_allclose(rms[lines], [0.70711, 0.35355, 1.0, 1.41421], atol=3e-5)


# --- simulated signals at constant speed ---------------------------------------------------------


def test_one_simulated_revolution_gives_the_order_spectrum():
    signal = np.random.default_rng(3).standard_normal((2, 3, CRANK_ANGLE.size))
    spectra = order_map(whole_revolutions(signal, 1, 50.0), 1.0, "rectangular")
    maximum = spectra.order.size - 1
    np.testing.assert_array_equal(spectra.order, np.arange(maximum + 1))
    np.testing.assert_allclose(
        spectra.amplitude[..., 0, :], order_spectrum(signal, maximum), rtol=0.0, atol=1e-15
    )
    assert spectra.shaft_frequency_hz == pytest.approx(50.0)


@pytest.mark.parametrize("window", list(WINDOWS))
def test_simulated_revolutions_under_any_window(window):
    revolution = np.arange(40 * 64) / 64
    signal = 0.3 + np.cos(2.0 * np.pi * revolution) - 0.7 * np.sin(20.0 * np.pi * revolution)
    spectra = order_map(whole_revolutions(signal, 40, 25.0), 0.4, window)
    lines = order_lines(spectra, range(5, 11))
    expected = order_spectrum(signal, 10, 40)[5:]
    # The cosines' arguments, up to 2π 400 rad, are rounded: that is in every mean of some samples.
    slack = np.spacing(2.0 * np.pi * 400.0)
    np.testing.assert_allclose(lines, np.broadcast_to(expected, lines.shape), rtol=0, atol=slack)


# --- noise and power -----------------------------------------------------------------------------


@pytest.mark.parametrize("window", list(WINDOWS))
def test_parseval(window):
    """Power of the lines over NENBW is the mean square, weighted with the squared window."""
    signal = np.random.default_rng(4).standard_normal(63)
    spectra = order_map(whole_revolutions(signal, 1, 50.0), 4.0, window)
    assert spectra.revolutions == 1
    power = np.sum(mean_order_spectrum(spectra) ** 2) / spectra.window.noise_bandwidth_lines
    weight = spectra.window.samples(63) ** 2
    assert power == pytest.approx(np.mean(weight * signal**2) / np.mean(weight), rel=1e-13)


@pytest.mark.parametrize("window", list(WINDOWS))
def test_power_density_of_white_noise(window):
    """One-sided density 2 σ²/f_s per Hz is 2 σ² f/f_s per order, under every window."""
    rate, speed, deviation = 5120.0, 20.0, 3.0
    signal = deviation * np.random.default_rng(5).standard_normal(round(50 * rate))
    angular = angular_resample(signal, rate, constant_speed(speed, 0.0, 50.0), 60.0)
    spectra = order_map(angular, 0.5, window)
    density = mean_order_spectrum(spectra)[5:] ** 2 / spectra.resolution_order
    # Of 1000 revolutions in 60 orders, 120 000 independent numbers: five standard errors of χ².
    slack = 5.0 * np.sqrt(2.0 / 120e3)
    assert np.mean(density) == pytest.approx(2.0 * deviation**2 * speed / rate, rel=slack)


def test_band_of_white_noise_in_a_run_up():
    """A band of b orders is b times the shaft frequency wide: its power follows the speed."""
    rate = 5000.0
    motion = from_speed(np.array([0.0, 20.0, 40.0]), np.array([10.0, 20.0, 30.0]))
    signal = np.random.default_rng(6).standard_normal((4, round(40 * rate)))
    spectra = order_map(angular_resample(signal, rate, motion, 60.0), 0.5)
    cut = order_cut(spectra, [10.0, 30.0, 50.0], 10.0)
    expected = 2.0 / rate * cut.shaft_frequency_hz[:, None] * cut.bandwidth_order
    ratio = cut.rms**2 / expected
    # 800 revolutions of 3 bands of 10 orders in 4 channels: 2 · 96 000 / 2 numbers.
    assert np.mean(ratio) == pytest.approx(1.0, abs=5.0 * np.sqrt(2.0 / 96e3))
    quarter = ratio.shape[1] // 4
    for part in (ratio[:, :quarter], ratio[:, -quarter:]):
        assert np.mean(part) == pytest.approx(1.0, abs=10.0 * np.sqrt(2.0 / 96e3))


@pytest.mark.parametrize(
    ("name", "noise_bandwidth", "side_lobe_db"),
    [("rectangular", 1.0, -13.3), ("hann", 1.5, -31.5), ("flat_top", 3.77, -84.0)],
)
def test_windows(name, noise_bandwidth, side_lobe_db):
    """Noise bandwidths of Harris and of Heinzel; the lobe ends where the windows say."""
    window = WINDOWS[name]
    samples = window.samples(4096)
    assert np.mean(samples) == pytest.approx(1.0, abs=1e-14)
    measured = 4096 * np.sum(samples**2) / np.sum(samples) ** 2
    assert measured == pytest.approx(window.noise_bandwidth_lines, rel=1e-13)
    assert measured == pytest.approx(noise_bandwidth, abs=5e-3)
    gain = np.abs(np.fft.rfft(samples, 32 * 4096)) / 4096  # 32 points a line
    end = round(16 * window.main_lobe_lines)
    assert gain[end] < 1e-13
    assert np.all(gain[1:end] > 1e-6)
    assert 20.0 * np.log10(np.max(gain[end:])) == pytest.approx(side_lobe_db, abs=1.0)


def test_flat_top_reads_tones_between_lines():
    """Within 0.01 dB where a Hann window reads 1.4 dB too little."""
    revolution = np.arange(200 * 64) / 64
    signal = np.cos(2.0 * np.pi * 5.05 * revolution)
    for window, loss_db in (("flat_top", 0.0), ("hann", -1.42)):
        spectra = order_map(
            whole_revolutions(signal, 200, 25.0),
            WINDOWS[window].noise_bandwidth_lines / 10,
            window,
        )
        highest = 20.0 * np.log10(np.max(np.abs(spectra.amplitude), axis=-1))
        np.testing.assert_allclose(highest, loss_db, atol=0.01)


# --- rpm-frequency map ---------------------------------------------------------------------------


def test_frequency_map_of_a_run_up():
    """A resonance's tone stays at its frequency; blocks are labelled with their mean speed."""
    motion = from_speed(np.linspace(0.5, 8.0, 6), np.linspace(10.0, 40.0, 6))
    time_s = np.arange(10000) / 1000.0
    signal = np.stack([2.0 * np.cos(2.0 * np.pi * 125.0 * time_s + 0.4), np.ones(10000)])
    spectra = frequency_map(signal, 1000.0, motion, 3.0)
    assert spectra.resolution_hz == pytest.approx(3.0)  # blocks of 500 samples
    assert spectra.time_s[0] == pytest.approx(0.5 + 0.2495)
    assert spectra.time_s[-1] <= 8.0 - 0.2495
    np.testing.assert_allclose(
        spectra.shaft_frequency_hz, 10.0 + 4.0 * (spectra.time_s - 0.5), atol=1e-12
    )
    line = np.flatnonzero(np.isclose(spectra.frequency_hz, 124.0))[0]
    between = spectra.amplitude[0, :, line : line + 2]  # 125 Hz is midway between 124 and 126
    power = np.sum(np.abs(spectra.amplitude[0]) ** 2, axis=-1) / 1.5
    np.testing.assert_allclose(power, 4.0, rtol=1e-6)
    np.testing.assert_allclose(np.abs(between), 2.0 * 0.849, rtol=1e-3)
    np.testing.assert_allclose(spectra.amplitude[1, :, 0], 1.0, atol=1e-14)


def test_frequency_map_has_the_phase_of_the_recording():
    motion = constant_speed(25.0, 0.0, 3.0)
    time_s = np.arange(3001) / 1000.0
    spectra = frequency_map(
        np.cos(2.0 * np.pi * 120.0 * time_s + 0.4), 1000.0, motion, 3.0, overlap_ratio=0.9
    )
    line = np.argmin(np.abs(spectra.frequency_hz - 120.0))
    np.testing.assert_allclose(spectra.amplitude[:, line], np.exp(0.4j), atol=1e-12)


# --- what they refuse ----------------------------------------------------------------------------

not_positive = st.one_of(st.floats(max_value=0.0), st.just(np.nan), st.just(np.inf))
not_a_share = st.one_of(st.floats(max_value=-1e-9), st.floats(min_value=1.0), st.just(np.nan))
SIMULATED = whole_revolutions(np.zeros(640), 10, 50.0)
STEADY = constant_speed(50.0, 0.0, 1.0)


@given(value=not_positive)
def test_resolution(value):
    with pytest.raises(ParameterError, match="resolution_order = "):
        order_map(SIMULATED, value)
    with pytest.raises(ParameterError, match="resolution_hz = "):
        frequency_map(np.zeros(1000), 1000.0, STEADY, value)


@given(value=not_a_share)
def test_overlap(value):
    with pytest.raises(ParameterError, match="overlap_ratio = "):
        order_map(SIMULATED, 1.0, overlap_ratio=value)
    with pytest.raises(ParameterError, match="overlap_ratio = "):
        frequency_map(np.zeros(1000), 1000.0, STEADY, 10.0, overlap_ratio=value)


@given(name=st.text("aehnprt_", max_size=9))
def test_window_names(name):
    if name not in WINDOWS:
        with pytest.raises(ParameterError, match="one of rectangular, hann, flat_top"):
            order_map(SIMULATED, 1.0, name)


@pytest.mark.parametrize("resolution", [0.149, 1e-12])
def test_resolution_finer_than_the_signal(resolution):
    assert order_map(SIMULATED, 0.15).revolutions == 10
    with pytest.raises(ParameterError, match=r"revolutions, the signal has 10"):
        order_map(SIMULATED, resolution)
    with pytest.raises(ParameterError, match=r"resolution_hz = .* Hz: must be 1\.5 to 187\.5 Hz"):
        frequency_map(np.zeros(1000), 1000.0, STEADY, resolution)


def test_order_between_lines():
    with pytest.raises(ParameterError, match=r"order 0.33: .* steps of 1/6"):
        order_lines(order_map(SIMULATED, 0.25), [0.5, 0.33])


@pytest.mark.parametrize("order", [0.0, 0.3, 30.8, 1e9, -1.0, np.nan])
def test_bands_beyond_the_map(order):
    with pytest.raises(ParameterError, match=r"band of 0.6667 must lie between order 0 and 31"):
        order_cut(order_map(SIMULATED, 0.25), [order])


@pytest.mark.parametrize("bandwidth", [0.0, -1.0, 0.6])
def test_band_narrower_than_the_main_lobe(bandwidth):
    with pytest.raises(ParameterError, match=r"narrower than the main lobe, 0.6667"):
        order_cut(order_map(SIMULATED, 0.25), [5.0], bandwidth)
