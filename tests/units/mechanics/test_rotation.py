"""Rotation of a shaft: time over crank angle, orders at a varying speed."""

import numpy as np
import pytest
from scipy.integrate import quad

from vibroacoustics.mechanics.moving_parts import MovingPart, path, wrench
from vibroacoustics.mechanics.rotation import (
    Rotation,
    constant_rotation,
    crank_time_s,
    uniform_crank_angle,
)
from vibroacoustics.orders import order_spectrum, order_spectrum_at_speed

OMEGA = 2.0 * np.pi * 25.0


def swinging(samples: int, swing: float = 0.2) -> Rotation:
    """Speed Ω (1 + a cos(θ - 0.4)); its acceleration is θ̇ dθ̇/dθ."""
    angle = uniform_crank_angle(samples) - 0.4
    speed = OMEGA * (1.0 + swing * np.cos(angle))
    return Rotation(speed, -OMEGA * swing * np.sin(angle) * speed)


def test_time_is_the_integral_of_the_slowness():
    rotation = swinging(128)
    for index in (1, 17, 64, 127):
        exact, _ = quad(
            lambda a: 1.0 / (OMEGA * (1.0 + 0.2 * np.cos(a - 0.4))), 0.0,
            rotation.crank_angle[index], epsabs=1e-15,
        )  # fmt: skip
        # The Fourier series of 1/(1 + a cos) falls as 0.1^k: rounding is left.
        assert rotation.time_s[index] == pytest.approx(exact, abs=1e-15)
    assert rotation.duration_s == pytest.approx(2.0 * np.pi / OMEGA / np.sqrt(1.0 - 0.04))


@pytest.mark.parametrize("samples", [64, 65])
def test_constant_speed_passes_uniformly(samples):
    rotation = constant_rotation(1500.0, samples)
    np.testing.assert_allclose(rotation.time_s, np.arange(samples) / samples / 25.0, rtol=1e-14)
    assert rotation.fluctuation_ratio == 0.0
    assert not rotation.acceleration_rad_per_s2.any()


def test_orders_at_constant_speed_are_those_of_the_fft():
    signal = np.random.default_rng(5).standard_normal((3, 128))
    speed = constant_rotation(1500.0, 128).speed_rad_per_s
    nearly = speed * (1.0 + 1e-15 * np.arange(128))  # takes the other path
    exact = order_spectrum(signal, 40)
    np.testing.assert_array_equal(order_spectrum_at_speed(signal, speed, 40), exact)
    np.testing.assert_allclose(order_spectrum_at_speed(signal, nearly, 40), exact, atol=1e-12)


def test_orders_are_multiples_of_the_mean_frequency_in_time():
    """A signal that is a sum of tones in time comes out as these tones, whatever the speed does."""
    rotation = swinging(256)
    phase = 2.0 * np.pi * crank_time_s(rotation.speed_rad_per_s) / rotation.duration_s
    signal = 2.0 + 3.0 * np.cos(phase + 0.3) + 0.5 * np.sin(7.0 * phase)
    spectrum = order_spectrum_at_speed(signal, rotation.speed_rad_per_s, 10)
    expected = np.zeros(11, dtype=complex)
    expected[[0, 1, 7]] = 2.0, 3.0 * np.exp(0.3j), -0.5j
    np.testing.assert_allclose(spectrum, expected, atol=1e-13)


def test_force_at_varying_speed_against_differences_in_time():
    """-m d²x/dt² of a slider, by central differences of its place over time."""
    samples = 8192
    rotation = swinging(samples)
    place = 0.01 * np.cos(rotation.crank_angle) + 0.002 * np.sin(3.0 * rotation.crank_angle)
    force = wrench([MovingPart("slider", 2.0, path(place, 0.0, 0.0))], rotation).force_n[0]
    step, speed = 2.0 * np.pi / samples, rotation.speed_rad_per_s
    velocity = (np.roll(place, -1) - np.roll(place, 1)) / (2.0 * step) * speed
    change = (np.roll(velocity, -1) - np.roll(velocity, 1)) / (2.0 * step) * speed
    # Twice (3 step)²/6 for the third order and its speed.
    allowed = (3.0 * step) ** 2 * np.max(np.abs(force))
    np.testing.assert_allclose(force, -2.0 * change, atol=allowed)


def test_momentum_of_a_closed_path_does_not_drift():
    rotation = swinging(256)
    part = MovingPart("rotor", 1.0, path(np.cos(rotation.crank_angle), 0.2, 0.0))
    force = wrench([part], rotation).force_n[0]
    mean = order_spectrum_at_speed(force, rotation.speed_rad_per_s, 1)[0]
    assert abs(mean) < 1e-10 * np.max(np.abs(force))
