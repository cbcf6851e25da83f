"""The formula of a change against closed forms, its errors and its bands."""

import numpy as np
import pytest
from measured_bench import AS_MEASURED, FREQUENCY, STIFFNESS, between, mounts, state

import vibroacoustics as va
from vibroacoustics.measured.band import (
    TRIED,
    amplitude_band,
    chosen_truncation,
    error_of_coherence,
    error_of_repeats,
    power_band,
    truncation_errors,
)
from vibroacoustics.measured.change import absorber_stiffness, mass_stiffness, mount_stiffness

OMEGA = 2.0 * np.pi * FREQUENCY


def test_a_mass_on_a_spring_whose_spring_changes():
    """Displacement of a mass on a spring under a force: F / (k - ω² m)."""
    old, new, mass, force = 4.0e5 * (1 + 0.1j), 1.0e5 * (1 + 0.3j), 3.0, 5.0
    y = (1.0 / (old - OMEGA**2 * mass))[:, None, None]
    u = force * y[:, 0]
    change = np.full(y.shape, new - old)
    changed = va.changed_response(u, y, y, u, change)[:, 0]
    np.testing.assert_allclose(changed, force / (new - OMEGA**2 * mass), rtol=1e-13)


@pytest.mark.parametrize("truncation", [0.0, 1e-9])
def test_no_truncation_and_one_that_cuts_nothing_are_the_same(truncation):
    before = state(FREQUENCY, AS_MEASURED)
    b = mounts()
    change = np.broadcast_to(-0.5 * STIFFNESS * np.eye(4), (FREQUENCY.size, 4, 4))
    changed = va.changed_response(
        before.running[:, 8:], before.frf[:, 8:] @ b.T, b @ before.frf[:, :8] @ b.T,
        before.running[:, :8] @ b.T, change, truncation,
    )  # fmt: skip
    truth = state(FREQUENCY, between(b, [0.5 * STIFFNESS] * 4, FREQUENCY)).running[:, 8:]
    np.testing.assert_allclose(changed, truth, rtol=1e-10)


@pytest.mark.parametrize("largest", [1e-3, 1.0, 1e3])
def test_truncation_leaves_out_small_singular_values(largest):
    """A share of the largest: of I + y here the second one is 0.5 % of the first."""
    y = largest * np.diag([1.0, 5e-3])[None] - np.eye(2)
    u = np.ones((1, 2), complex)
    kept = va.changed_response(np.zeros((1, 2), complex), np.eye(2)[None] + 0j, y + 0j, u,
                               np.eye(2)[None] + 0j, 0.01)  # fmt: skip
    np.testing.assert_allclose(kept, [[-1.0 / largest, 0.0]], rtol=1e-9, atol=1e-12 / largest)


def test_a_resonance_without_damping_is_one_line():
    one = np.ones((1, 1, 1), complex)
    with pytest.raises(va.SolverError, match="resonates without damping"):
        va.changed_response(one[0], one, one, one[0], -one)


def test_dynamic_stiffnesses():
    f = np.array([10.0, 50.0])
    np.testing.assert_allclose(mount_stiffness(f, 2e5, 0.1), 2e5 + 2e4j)
    np.testing.assert_allclose(mass_stiffness(f, 2.0), -2.0 * (2 * np.pi * f) ** 2)
    light = absorber_stiffness(f, 0.5, 1e12, 0.1)  # on a rigid spring it is its mass
    np.testing.assert_allclose(light, mass_stiffness(f, 0.5), rtol=1e-6)
    tuned = 0.5 * (2 * np.pi * 50.0) ** 2
    at_tune = absorber_stiffness(f, 0.5, tuned, 0.05)[1]
    np.testing.assert_allclose(at_tune, -tuned * (1 + 0.05j) / 0.05j, rtol=1e-12)


def test_error_of_a_coherence_is_that_of_simulated_averages():
    rng = np.random.default_rng(2)
    runs, averages, noise = 4000, 16, 0.5
    shape = (2, runs, averages)
    force, disturbance = (rng.normal(size=shape) + 1j * rng.normal(size=shape)).reshape(
        2, *shape[1:]
    )
    response = 3.0 * force + noise * 3.0 * disturbance
    cross = (response * force.conj()).mean(axis=1)
    h = cross / (abs(force) ** 2).mean(axis=1)
    coherence = 1.0 / (1.0 + noise**2)
    stated = error_of_coherence(np.array([3.0 + 0j]), np.array([coherence]), averages)[0]
    assert np.sqrt(np.mean(abs(h - 3.0) ** 2)) == pytest.approx(stated, rel=0.05)
    with pytest.raises(va.ParameterError, match=r"coherence 1\.2: must be above 0 up to 1"):
        error_of_coherence(np.array([3.0 + 0j]), np.array([1.2]), averages)


def test_error_of_repeats_is_the_scatter_of_their_mean():
    rng = np.random.default_rng(3)
    draws = 2.0 + rng.normal(size=(5, 20000)) + 1j * rng.normal(size=(5, 20000))
    stated = np.sqrt(np.mean(error_of_repeats(draws) ** 2))
    assert stated == pytest.approx(np.sqrt(2.0 / 5.0), rel=0.02)


@pytest.mark.parametrize("size", [0.0, 0.5, 2.0, 30.0, 3e3])
def test_a_band_of_amplitudes_holds_the_truth_in_nine_of_ten(size):
    """From far below the noise to far above."""
    rng = np.random.default_rng(4)
    noise = (rng.normal(size=(201, 2000)) + 1j * rng.normal(size=(201, 2000))) / np.sqrt(2.0)
    estimate = size + noise[0]
    low, high = amplitude_band(estimate, estimate + noise[1:])
    held = np.mean((low <= size) & (size <= high))
    assert 0.87 < held < (0.97 if size < 1.0 else 0.93)
    assert np.all((low <= abs(estimate)) & (abs(estimate) <= high))


def test_a_band_of_powers_takes_off_what_noise_adds():
    rng = np.random.default_rng(5)
    noise = (rng.normal(size=(101, 300, 30)) + 1j * rng.normal(size=(101, 300, 30))) / np.sqrt(2)
    power = (abs(2.0 + noise[0]) ** 2).sum(-1)
    drawn = (abs(2.0 + noise[0] + noise[1:]) ** 2).sum(-1)
    low, high = power_band(power, drawn)
    assert 0.82 < np.mean((low <= 120.0) & (high >= 120.0)) < 0.97
    assert np.median(low + high) / 2.0 == pytest.approx(120.0, rel=0.05)


def test_the_truncation_that_does_best_is_chosen():
    assert chosen_truncation(np.array([1.0, 1.0, 1.0, 1.0, 1.2, 1.4])) == 0.0
    assert chosen_truncation(np.array([3.0, 2.5, 2.0, 1.0, 1.2, 1.4])) == TRIED[3]
    assert chosen_truncation(np.array([1.005, 1.0, 1.0, 1.0, 1.2, 1.4])) == 0.0
    of_draw = [lambda share: np.array([2.0 * (1.0 + share)])]
    errors = truncation_errors(np.array([1.0 + 0j]), of_draw)
    np.testing.assert_allclose(errors, 20.0 * np.log10(2.0 * (1.0 + np.array(TRIED))), rtol=1e-12)
