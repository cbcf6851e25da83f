"""Closed forms against independent evaluations."""

import numpy as np
import pytest
from radiation_parts import floor
from scipy import special
from sphere_sound import outgoing_hankel, sphere_pressure

from vibroacoustics.base.constants import AIR_DENSITY_KG_PER_M3, SPEED_OF_SOUND_M_PER_S
from vibroacoustics.radiation.exact import (
    Mirror,
    free_green,
    green,
    wavenumber,
)

FREQUENCY_HZ = np.array([50.0, 400.0, 1500.0])


def test_green_function_solves_the_helmholtz_equation():
    point, source, step = np.array([0.5, -0.3, 0.4]), np.array([0.1, 0.2, -0.3]), 1e-3
    moves = np.concatenate([np.eye(3), -np.eye(3)]) * step
    around = free_green(point + moves, source, FREQUENCY_HZ).sum(axis=1)
    here = free_green(point[None], source, FREQUENCY_HZ)[:, 0]
    laplacian = (around - 6 * here) / step**2
    expected = -(wavenumber(FREQUENCY_HZ) ** 2) * here
    np.testing.assert_allclose(laplacian, expected, atol=2e-4 * np.abs(expected).max())


def test_green_function_is_reciprocal_and_outgoing():
    a, b = np.array([0.5, -0.3, 0.4]), np.array([0.1, 0.2, 0.9])
    corner = (floor(-0.25), Mirror(0, -1, -0.4, 0.7), Mirror(1, 1, 0.8))
    for walls in ((), corner[:1], corner):
        np.testing.assert_allclose(
            green(a[None], b, FREQUENCY_HZ, walls), green(b[None], a, FREQUENCY_HZ, walls)
        )
    phase = np.angle(free_green(np.array([[0.01, 0.0, 0.0]]), np.zeros(3), FREQUENCY_HZ)[:, 0])
    np.testing.assert_allclose(phase, -wavenumber(FREQUENCY_HZ) * 0.01)


@pytest.mark.parametrize("wall", range(3))
def test_hard_walls_stop_motion_across_them(wall):
    """In a corner of three hard walls at right angles the images are exact on each."""
    corner = (floor(-0.25), Mirror(0, -1, -0.4), Mirror(1, 1, 0.8))
    source, step = np.array([0.1, 0.2, 0.3]), 1e-5
    here = np.array([0.7, -0.1, 0.4])
    here[corner[wall].axis] = corner[wall].position_m
    move = step * np.eye(3)[corner[wall].axis]
    points = np.array([here + move, here - move])
    before, behind = green(points, source, FREQUENCY_HZ, corner).T
    np.testing.assert_allclose(before, behind, rtol=1e-12)


def test_microphone_on_the_floor_doubles_the_pressure():
    source, point = np.array([0.3, 0.0, -0.25]), np.array([[0.0, 0.9, 0.1]])
    np.testing.assert_allclose(
        green(point, source, FREQUENCY_HZ, (floor(-0.25),)),
        2 * free_green(point, source, FREQUENCY_HZ),
    )


def test_absorbing_wall_weakens_its_image():
    source, point = np.array([0.3, 0.0, 0.1]), np.array([[0.0, 0.9, 0.1]])
    direct = free_green(point, source, FREQUENCY_HZ)
    image = free_green(point, source * [-1, 1, 1] + [1.0, 0, 0], FREQUENCY_HZ)
    for reflection in (0.0, 0.6, 1.0):
        wall = Mirror(0, 1, 0.5, reflection)
        np.testing.assert_allclose(
            green(point, source, FREQUENCY_HZ, (wall,)), direct + reflection * image
        )


def test_hankel_functions_are_those_of_scipy():
    x = np.linspace(0.1, 8.0, 30)
    for order in range(4):
        reference = np.sqrt(np.pi / (2 * x)) * special.hankel2(order + 0.5, x)
        np.testing.assert_allclose(outgoing_hankel(order, x), reference, rtol=1e-12)


def test_sphere_has_the_prescribed_normal_velocity():
    """Euler's equation at the surface: dp/dr = -j omega rho P_n."""
    radius, step = 0.12, 1e-6
    cosine = np.array([1.0, 0.4, -0.7])
    for order in range(4):
        outer, inner = (
            sphere_pressure(order, radius, radius + offset, cosine, FREQUENCY_HZ)
            for offset in (step, -step)
        )
        expected = (
            -2j
            * np.pi
            * AIR_DENSITY_KG_PER_M3
            * np.multiply.outer(FREQUENCY_HZ, special.eval_legendre(order, cosine))
        )
        np.testing.assert_allclose((outer - inner) / (2 * step), expected, rtol=1e-6)


def test_small_pulsating_sphere_is_a_monopole():
    radius, frequency = 0.001, np.array([100.0])
    expected = (
        2j
        * np.pi
        * 100
        * AIR_DENSITY_KG_PER_M3
        * 4
        * np.pi
        * radius**2
        * np.exp(-2j * np.pi * 100 / SPEED_OF_SOUND_M_PER_S)
        / (4 * np.pi)
    )
    pressure = sphere_pressure(0, radius, 1.0, np.ones(1), frequency)[:, 0]
    np.testing.assert_allclose(pressure, expected, rtol=3e-3)
