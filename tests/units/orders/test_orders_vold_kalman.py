"""Vold-Kalman tracking: crossing and close orders, bandwidth, textbook solution, refusals."""

import re
from math import comb

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import BSpline

from vibroacoustics.base.errors import ParameterError, SolverError
from vibroacoustics.orders.crank_motion import constant_speed, from_speed
from vibroacoustics.orders.vold_kalman import LARGEST_NOISE_GAIN, vold_kalman
from vibroacoustics.orders.vold_kalman_equations import Track, weight_squared

SAMPLE_RATE = 2048.0
DURATION = 20.0
TIME = np.arange(int(DURATION * SAMPLE_RATE)) / SAMPLE_RATE
RUN_UP = from_speed(np.array([0.0, DURATION]), np.array([20.0, 60.0]))
RUN_DOWN = from_speed(np.array([0.0, DURATION]), np.array([55.0, 25.0]))
EVEN = constant_speed(50.0, 0.0, DURATION)


def signal_of(tracks, envelopes, time=TIME):
    """Sum of the orders with these envelopes, complex peak."""
    return sum(
        np.real(envelope * np.exp(1j * track.order * track.motion.angle_rad(time)))
        for track, envelope in zip(tracks, envelopes, strict=True)
    )


CROSSING = {
    "run-up over an even shaft": [Track(RUN_UP, 1), Track(RUN_UP, 2), Track(EVEN, 1)],
    "run-up over run-down": [Track(RUN_UP, 1), Track(RUN_DOWN, 1), Track(RUN_DOWN, 2)],
}
AMPLITUDES = np.array([1.0 * np.exp(0.3j), 0.5 * np.exp(-1.0j), 0.8])


@pytest.mark.parametrize("poles", [1, 2, 3])
@pytest.mark.parametrize("tracks", CROSSING.values(), ids=CROSSING)
def test_constant_crossing_orders_are_exact_to_the_ends(tracks, poles):
    """A polynomial below degree p solves the equations: what is left is rounding.

    Rounding grows with the condition number, r² 4^p < 1e6, times the noise gain squared.
    """
    tracked = vold_kalman(signal_of(tracks, AMPLITUDES), SAMPLE_RATE, tracks, 1.0, poles)
    np.testing.assert_allclose(
        tracked.envelope, np.broadcast_to(AMPLITUDES[:, None], tracked.envelope.shape), atol=1e-9
    )


@pytest.mark.parametrize("tracks", CROSSING.values(), ids=CROSSING)
def test_crossing_orders_to_one_percent_in_noise(tracks):
    """Amplitudes and noise of which 1 Hz of bandwidth lets 1e-3 of an order through."""
    noise = 0.02 * np.random.default_rng(4).standard_normal(TIME.size)
    tracked = vold_kalman(signal_of(tracks, AMPLITUDES) + noise, SAMPLE_RATE, tracks, 1.0)
    inside = (tracked.time_s > 1.0) & (tracked.time_s < DURATION - 1.0)  # 1 / bandwidth
    error = np.abs(np.abs(tracked.envelope) / np.abs(AMPLITUDES)[:, None] - 1.0)
    assert np.max(error[:, inside]) < 0.01


@pytest.mark.parametrize("tracks", CROSSING.values(), ids=CROSSING)
def test_crossing_orders_of_varying_amplitude(tracks):
    """Amplitudes that rise, fall and swing at 1/20 of the bandwidth, to 1 % of each."""
    bandwidth = 2.0
    shapes = [
        0.5 + TIME / DURATION,
        1.0 - 0.5 * TIME / DURATION,
        1.0 + 0.3 * np.sin(2.0 * np.pi * 0.1 * TIME),
    ]
    envelopes = [shape * amplitude for shape, amplitude in zip(shapes, AMPLITUDES, strict=True)]
    tracked = vold_kalman(signal_of(tracks, envelopes), SAMPLE_RATE, tracks, bandwidth)
    inside = (tracked.time_s > 1.0 / bandwidth) & (tracked.time_s < DURATION - 1.0 / bandwidth)
    exact = np.array([np.interp(tracked.time_s, TIME, np.abs(shape)) for shape in envelopes])
    assert np.max(np.abs(np.abs(tracked.envelope) / exact - 1.0)[:, inside]) < 0.01


def test_close_orders_of_one_shaft():
    """Orders 1 and 1.1, 3.5 Hz apart on average, with a bandwidth of 1 Hz, in noise."""
    tracks = [Track(RUN_UP, 1.0), Track(RUN_UP, 1.1)]
    noise = 0.02 * np.random.default_rng(5).standard_normal(TIME.size)
    tracked = vold_kalman(signal_of(tracks, AMPLITUDES[[0, 2]]) + noise, SAMPLE_RATE, tracks, 1.0)
    inside = (tracked.time_s > 1.0) & (tracked.time_s < DURATION - 1.0)
    error = np.abs(np.abs(tracked.envelope) / np.abs(AMPLITUDES[[0, 2]])[:, None] - 1.0)
    assert np.max(error[:, inside]) < 0.01


@pytest.mark.parametrize("poles", [1, 2, 3])
@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_half_power_at_half_the_bandwidth(poles, side):
    """A tone B/2 off the order comes through 3 dB down, one on it unchanged.

    What the splines let alias, (1/15)^4 = 2e-5 from either side, is left; the image at twice the
    carrier, 400 bandwidths off, adds (1/800)²/0.41 = 4e-6 with one pole.
    """
    bandwidth, carrier = 1.0, 200.0
    motion = constant_speed(carrier, 0.0, DURATION)
    signal = np.cos(2.0 * np.pi * (carrier + side * bandwidth / 2.0) * TIME)
    tracked = vold_kalman(signal, SAMPLE_RATE, [Track(motion, 1)], bandwidth, poles)
    middle = np.abs(tracked.envelope[0, np.abs(tracked.time_s - DURATION / 2.0) < 2.0])
    np.testing.assert_allclose(middle, np.sqrt(0.5), rtol=1e-4)


def test_weight_is_that_of_the_published_formulas():
    """Tůma's formulas for one, two and three poles."""
    angle = np.pi * 3.0 / 100.0
    gain = np.sqrt(2.0) - 1.0
    published = [
        gain / (2.0 - 2.0 * np.cos(angle)),
        gain / (6.0 - 8.0 * np.cos(angle) + 2.0 * np.cos(2.0 * angle)),
        gain
        / (20.0 - 30.0 * np.cos(angle) + 12.0 * np.cos(2.0 * angle) - 2.0 * np.cos(3.0 * angle)),
    ]
    # The published differences cancel: 20 - 30 + 12 - 2 leaves 7e-7, to 1e-9 of it.
    assert [weight_squared(3.0, 100.0, p) for p in (1, 2, 3)] == pytest.approx(published, rel=1e-8)


def differences(samples, poles):
    """Matrix of the p-th differences."""
    stencil = [(-1) ** i * comb(poles, i) for i in range(poles + 1)]
    return sum(c * np.eye(samples - poles, samples, i) for i, c in enumerate(stencil))


def small_problem(noise):
    """1.2 s at 256 Hz of two orders that cross, the first one swinging."""
    time = np.arange(307) / 256.0
    up = from_speed(np.array([0.0, 1.2]), np.array([40.0, 70.0]))
    tracks = [Track(up, 1), Track(constant_speed(52.0, 0.0, 1.2), 1)]
    envelopes = [(1.0 + 0.2 * np.sin(3.0 * time)) * np.exp(0.3j), 0.5 * np.exp(-1.0j)]
    white = np.random.default_rng(1).standard_normal(time.size)
    return time, tracks, signal_of(tracks, envelopes, time) + noise * white


@pytest.mark.parametrize("poles", [1, 2, 3])
def test_second_method_dense_least_squares(poles):
    """The same envelopes from scipy's B-splines and a dense solver; rounding is left."""
    time, tracks, signal = small_problem(noise=0.5)
    bandwidth, step = 4.0, 8  # 256 Hz / 8 / 4 Hz
    knots = np.arange(-3, 39 + 4) * step / 256.0
    splines = BSpline.design_matrix(time, knots, 3).toarray()
    assert splines.shape == (307, 42)
    carriers = [np.exp(1j * track.order * track.motion.angle_rad(time)) for track in tracks]
    parts = [part for c in carriers for part in (c.real, -c.imag)]
    data = np.hstack([splines * part[:, None] for part in parts])
    weight = weight_squared(bandwidth, 32.0, poles) * np.sinc(1.0 / 16.0) ** 8 * step / 2.0
    structure = np.sqrt(weight) * np.kron(np.eye(4), differences(42, poles))
    system = np.vstack([data, structure])
    right = np.concatenate([signal, np.zeros(len(structure))])
    coefficients = np.linalg.lstsq(system, right, rcond=None)[0].reshape(4, 42)
    at_knots = (coefficients @ splines[::step].T)[::2] + 1j * (coefficients @ splines[::step].T)[
        1::2
    ]
    tracked = vold_kalman(signal, 256.0, tracks, bandwidth, poles)
    np.testing.assert_allclose(tracked.envelope, at_knots, atol=1e-9)


@pytest.mark.parametrize("poles", [1, 2, 3])
def test_second_method_textbook_at_full_rate(poles):
    """The undecimated equations as printed give the same envelopes, crossing and all.

    They get the analytic signal: of a real one they take in the image at -2f as well.
    """
    time, tracks, _ = small_problem(noise=0.0)
    carriers = [np.exp(1j * track.order * track.motion.angle_rad(time)) for track in tracks]
    true = np.array([(1.0 + 0.2 * np.sin(3.0 * time)) * np.exp(0.3j), np.full(307, 0.5 + 0.1j)])
    analytic = np.sum(true * carriers, axis=0)
    data = np.hstack([np.diag(carrier) for carrier in carriers])
    squares = differences(307, poles).T @ differences(307, poles)
    normal = np.kron(np.eye(2), weight_squared(4.0, 256.0, poles) * squares)
    normal = normal + data.conj().T @ data
    textbook = np.linalg.solve(normal, data.conj().T @ analytic).reshape(2, 307)
    tracked = vold_kalman(analytic.real, 256.0, tracks, 4.0, poles)
    difference = np.max(np.abs(tracked.envelope - textbook[:, ::8]))
    # Both smooth the swinging envelope alike: the splines bend no more than the filter does.
    assert difference < 0.1 * np.max(np.abs(textbook - true))


def test_channels_are_tracked_one_by_one():
    tracks = CROSSING["run-up over an even shaft"]
    signal = np.random.default_rng(2).standard_normal((2, 3, 4096))
    together = vold_kalman(signal, SAMPLE_RATE, tracks, 2.0)
    assert together.envelope.shape == (2, 3, 3, together.time_s.size)
    alone = vold_kalman(signal[1, 2], SAMPLE_RATE, tracks, 2.0)
    np.testing.assert_allclose(together.envelope[1, 2], alone.envelope, atol=1e-12)


def test_pieces_join_without_a_trace(monkeypatch):
    tracks = CROSSING["run-up over an even shaft"]
    signal = np.random.default_rng(3).standard_normal(10_001)
    whole = vold_kalman(signal, SAMPLE_RATE, tracks, 1.0)
    monkeypatch.setattr("vibroacoustics.orders.vold_kalman_equations._CHUNK", 1000)
    pieces = vold_kalman(signal, SAMPLE_RATE, tracks, 1.0)
    np.testing.assert_allclose(pieces.envelope, whole.envelope, atol=1e-12)


def test_span_is_where_all_shafts_are_known():
    late = constant_speed(30.0, 3.3, 12.0)
    tracked = vold_kalman(
        signal_of([Track(EVEN, 1)], [1.0]), SAMPLE_RATE, [Track(EVEN, 1), Track(late, 1)], 1.0
    )
    step = 1.0 / tracked.sample_rate_hz
    assert tracked.time_s[0] == pytest.approx(3.3, abs=1.0 / SAMPLE_RATE)
    assert 12.0 - step < tracked.time_s[-1] <= 12.0
    np.testing.assert_allclose(np.diff(tracked.time_s), step)
    np.testing.assert_allclose(np.abs(tracked.envelope[0]), 1.0, atol=1e-9)


def test_strong_stranger_stays_out():
    """A tone 40 dB above the order, 20 bandwidths off it."""
    stranger = 100.0 * np.cos(2.0 * np.pi * 70.0 * TIME)
    signal = signal_of([Track(EVEN, 1)], [1.0]) + stranger
    tracked = vold_kalman(signal, SAMPLE_RATE, [Track(EVEN, 1)], 1.0)
    # Two poles: 100 / (0.41 · 40⁴) = 1e-4. The ends' transients: 100 exp(-2.8 · 5) = 1e-4.
    inside = (tracked.time_s > 5.0) & (tracked.time_s < DURATION - 5.0)
    np.testing.assert_allclose(np.abs(tracked.envelope[0, inside]), 1.0, atol=2e-4)


# --- refusals ------------------------------------------------------------------------------------


@pytest.mark.parametrize("poles", [1, 2, 3])
@pytest.mark.parametrize("apart_hz", [0.0, 1e-6, 0.005])
def test_orders_that_coincide_are_named(poles, apart_hz):
    twin = constant_speed(50.0 + apart_hz, 0.0, DURATION)
    tracks = [Track(RUN_UP, 2), Track(EVEN, 1), Track(twin.geared(0.5), 2)]
    words = (
        r"track 1 \(order 1, 50 Hz\) and track 2 \(order 2, 50.*Hz\) around .* bandwidth of 8 Hz"
    )
    with pytest.raises(SolverError, match=words):
        vold_kalman(signal_of(tracks, AMPLITUDES), SAMPLE_RATE, tracks, 8.0, poles)


def test_shafts_that_lock_for_a_while_are_named():
    """A fan that runs at its motor's speed from 8 to 12 s and apart from it otherwise."""
    fan = from_speed(
        np.array([0.0, 7.0, 8.0, 12.0, 13.0, 20.0]), np.array([40, 40, 50, 50, 60, 60.0])
    )
    with pytest.raises(
        SolverError, match=r"track 0 \(order 1, 50 Hz\) and .* around (9|10)(\.\d+)? s"
    ):
        vold_kalman(np.zeros(TIME.size), SAMPLE_RATE, [Track(EVEN, 1), Track(fan, 1)], 4.0)


def test_noise_gain_tells_how_close_orders_are():
    """Two even shafts d apart: at least 1/√(0.41 (d/B)^2p).

    That is of envelopes that beat at ±d/2 and leave no trace; a trace makes it a little more.
    """
    distance, bandwidth = 0.5, 2.0
    tracks = [Track(EVEN, 1), Track(constant_speed(50.0 + distance, 0.0, DURATION), 1)]
    gain = vold_kalman(np.zeros(TIME.size), SAMPLE_RATE, tracks, bandwidth).noise_gain
    expected = 1.0 / np.sqrt(0.4142 * (distance / bandwidth) ** 4)
    assert 1.0 <= gain / expected < 1.2
    assert gain < LARGEST_NOISE_GAIN


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"poles": 4}, "poles = 4: must be 1, 2 or 3"),
        ({"tracks": []}, "tracks: none given"),
        ({"bandwidth_hz": 0.0}, "bandwidth_hz = 0 Hz: must be above 0 and up to 64 Hz"),
        ({"bandwidth_hz": np.nan}, "bandwidth_hz = nan Hz"),
        ({"bandwidth_hz": 65.0}, "bandwidth_hz = 65 Hz: must be above 0 and up to 64 Hz"),
        ({"bandwidth_hz": 1e-3}, "bandwidth_hz = 0.001 Hz: needs 1e+03 s of signal"),
        (
            {"bandwidth_hz": 30.0},
            "track 0 (order 1): runs from 20 to 59.99 Hz, must stay within 30",
        ),
        ({"tracks": [Track(EVEN, 20.5)]}, "(order 20.5): runs from 1025 to 1025 Hz"),
        ({"tracks": [Track(constant_speed(9.0, 30.0, 40.0), 1)]}, "are known, there are 0 s"),
        ({"signal": np.where(TIME == 1.0, np.nan, 0.0)}, "signal: sample 2048 is not a finite"),
    ],
)
def test_bad_input_is_one_clear_line(arguments, words):
    good = {"signal": np.zeros(TIME.size), "tracks": [Track(RUN_UP, 1)], "bandwidth_hz": 1.0}
    with pytest.raises(ParameterError, match=re.escape(words)):
        vold_kalman(sample_rate_hz=SAMPLE_RATE, **(good | arguments))


@settings(max_examples=60, deadline=None)
@given(
    first=st.floats(1.0, 200.0),
    second=st.floats(1.0, 200.0),
    bandwidth=st.floats(1e-3, 50.0),
    poles=st.sampled_from([1, 2, 3]),
    samples=st.integers(0, 3000),
)
def test_an_answer_or_a_clear_error_never_nan(first, second, bandwidth, poles, samples):
    tracks = [Track(constant_speed(speed, 0.0, 4.0), 1) for speed in (first, second)]
    signal = np.random.default_rng(0).standard_normal(samples)
    try:
        tracked = vold_kalman(signal, 1000.0, tracks, bandwidth, poles)
    except (ParameterError, SolverError):
        return
    assert np.all(np.isfinite(tracked.envelope))
    # White noise of 1: least squares of a bounded noise gain cannot blow it up further.
    assert np.max(np.abs(tracked.envelope)) < 10.0 * tracked.noise_gain
