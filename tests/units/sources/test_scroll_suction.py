"""Suction pockets that fill with inertia: volume, mass, an implicit method, slow running."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scroll_closed_forms import suction_volume_m3
from scroll_flanks import INNER, OUTER, area, fixed_flank, moved
from scroll_openings import SPEED_RPM, WRAPS
from test_scroll_gas import OTHER_WRAPS

from vibroacoustics.sources.scroll_gas.parameters import (
    contact_angle,
    pocket_volume,
    swept_volume_m3,
)
from vibroacoustics.sources.scroll_gas.suction import suction_flow

TURN = 2.0 * np.pi
OUTSIDE = (9.98e5, 33.0, 182.0)
GAP_M, COEFFICIENT = 4e-3, 0.8
KAPPA = 33.0 * 182.0**2 / 9.98e5


def filled(speed_rpm=SPEED_RPM):
    return suction_flow(WRAPS, GAP_M, COEFFICIENT, OUTSIDE, speed_rpm)


@pytest.mark.parametrize("wraps", [WRAPS, OTHER_WRAPS])
def test_volume_is_that_between_the_flanks(wraps):
    """Polygon from the contact to the end of the wrap, at several crank angles."""
    for since_closing in (1.0, 2.0, 3.5, 5.0, 6.0):
        contact = float(contact_angle(wraps, np.asarray(since_closing)))
        crank = wraps.closing_crank_angle_rad + since_closing
        inner = fixed_flank(wraps, INNER).between(contact + 0.5 * np.pi, wraps.end_angle_rad)
        other = moved(fixed_flank(wraps, OUTER), wraps, crank)
        outer = other.between(wraps.end_angle_rad - np.pi, contact - 0.5 * np.pi)
        expected = wraps.height_m * area(inner, outer)
        obtained = float(suction_volume_m3(wraps, np.asarray(since_closing)))
        assert obtained == pytest.approx(expected, rel=2e-3)


@pytest.mark.parametrize("wraps", [WRAPS, OTHER_WRAPS])
def test_volume_begins_at_nothing_and_ends_as_a_closed_pocket(wraps):
    volume = suction_volume_m3(wraps, np.array([0.0, 1e-3, TURN]))
    closed = float(pocket_volume(wraps, np.zeros(())))
    assert volume[0] == pytest.approx(0.0, abs=1e-12 * closed)
    assert volume[1] < 1e-8 * closed
    assert volume[2] == pytest.approx(closed, rel=1e-12)


def test_mass_that_flows_in_is_that_of_the_closed_pockets():
    filling = filled()
    time = filling.since_closing / (TURN * SPEED_RPM / 60.0)
    mass = np.trapezoid(filling.flow_kg_per_s, time)
    density = 33.0 * (filling.pocket_pa[-1] / OUTSIDE[0]) ** (1.0 / KAPPA)
    pockets = 2.0 * float(pocket_volume(WRAPS, np.zeros(()))) * density
    assert mass == pytest.approx(pockets, rel=1e-7)
    assert filling.flow_kg_per_s[0] == 0.0
    assert abs(filling.flow_kg_per_s[-1]) < 1e-4 * filling.flow_kg_per_s.max()


def test_an_implicit_method_agrees():
    """Mass and momentum over time, Radau's method, written anew."""
    omega = TURN * SPEED_RPM / 60.0
    swept, outer = swept_volume_m3(WRAPS), float(contact_angle(WRAPS, np.zeros(())))
    gap = WRAPS.height_m * WRAPS.orbit_radius_m

    def rates(angle, state):
        mass, flow = state
        density = mass / float(suction_volume_m3(WRAPS, np.asarray(angle)))
        pressure = OUTSIDE[0] * (density / 33.0) ** KAPPA
        opened = gap * (1.0 - np.cos(angle))
        behind = 33.0 if flow > 0.0 else density
        lost = flow * abs(flow) / (2.0 * behind * (COEFFICIENT * opened) ** 2)
        return [flow / omega, (OUTSIDE[0] - pressure - lost) * opened / GAP_M / omega]

    start, stop = 0.02, TURN - 0.02
    swelling = 0.5 * swept * (outer - start - outer * np.cos(start) + np.sin(start))
    state = [33.0 * float(suction_volume_m3(WRAPS, np.asarray(start))), 33.0 * omega * swelling]
    angles = np.linspace(0.1, stop, 400)
    solved = solve_ivp(rates, (start, stop), state, "Radau", angles, rtol=1e-8, atol=[1e-16, 1e-10])
    filling = filled()
    flow = 0.5 * np.interp(angles, filling.since_closing, filling.flow_kg_per_s)
    np.testing.assert_allclose(flow, solved.y[1], atol=1e-3 * solved.y[1].max())
    volume = suction_volume_m3(WRAPS, angles)
    pressure = OUTSIDE[0] * (solved.y[0] / volume / 33.0) ** KAPPA
    obtained = np.interp(angles, filling.since_closing, filling.pocket_pa)
    np.testing.assert_allclose(obtained, pressure, rtol=1e-3)


def test_a_slow_shaft_fills_pockets_as_they_grow():
    """ρ dV/dt of two pockets, at the suction pressure."""
    filling = filled(120.0)
    angle = np.linspace(0.5, TURN - 1.0, 50)
    step = 1e-4
    swelling = suction_volume_m3(WRAPS, angle + step) - suction_volume_m3(WRAPS, angle - step)
    expected = 2.0 * 33.0 * swelling / (2.0 * step) * TURN * 2.0
    flow = np.interp(angle, filling.since_closing, filling.flow_kg_per_s)
    np.testing.assert_allclose(flow, expected, atol=0.01 * expected.max())
    pressure = np.interp(angle, filling.since_closing, filling.pocket_pa)
    np.testing.assert_allclose(pressure, OUTSIDE[0], rtol=1e-3)


def test_closing_pockets_are_compressed_a_little():
    """The contact runs on while the gap closes: some 30 kPa of 998 at 2900 rpm."""
    rise = filled().pocket_pa[-1] - OUTSIDE[0]
    assert 2e4 < rise < 4e4
    crank = np.linspace(0.0, TURN, 2000)
    flow = filled().over_crank_angle(WRAPS, crank)
    opened = crank[np.argmax(flow)] - WRAPS.closing_crank_angle_rad
    assert 0.5 * np.pi < opened < 1.5 * np.pi
