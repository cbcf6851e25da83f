"""Gas forces with a discharge port that opens over a crank angle: limits, continuity, spectrum."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scroll_closed_forms import built_in_pressure_pa, compression_work_j
from test_scroll_gas import CASES, GAS, OTHER_WRAPS, WRAPS, gas_of

from vibroacoustics.mechanics.rotation import uniform_crank_angle
from vibroacoustics.orders import order_spectrum
from vibroacoustics.sources.scroll_gas.cycle import scroll_gas_cycle
from vibroacoustics.sources.scroll_gas.suction import (
    pocket_pressure,
)

SAMPLES = 36000
ANGLE = uniform_crank_angle(SAMPLES)


def opening_over(gas, degrees):
    return gas.model_copy(update={"equalisation_angle_rad": np.radians(degrees)})


def mean_force_change(wraps, gas, width):
    """Mean tangential force over that of an instant opening, in closed form, N.

    At the angle a after the opening the pocket is still off by ½ (1 + cos(π a/w)) Δp, at the
    contact of its outer end less that of its inner end: 2π apart, so 2 r_b h Δp 2π times the mean
    of the half cosine over the turn, ½ w/2π.
    """
    step = built_in_pressure_pa(wraps, gas) - gas.discharge_pressure_pa
    return wraps.base_radius_m * wraps.height_m * step * width


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("wraps", [WRAPS, OTHER_WRAPS])
@pytest.mark.parametrize("degrees", [1.0, 8.0, 20.0, 45.0, 300.0])
def test_mean_force_is_that_of_an_instant_opening_and_half_the_step_over_the_angle(
    case, wraps, degrees
):
    """Over- and under-compression; the pocket is left constant while it opens.

    The mean of samples is uncertain by half a sample's share of the instant step, the outer
    contact times the pressure at the opening; that of the smooth one is better.
    """
    gas = gas_of(case)
    width = np.radians(degrees)
    slow = scroll_gas_cycle(wraps, opening_over(gas, degrees), ANGLE).tangential_force_n.mean()
    work = compression_work_j(wraps, gas)
    expected = work / (2.0 * np.pi * wraps.orbit_radius_m) + mean_force_change(wraps, gas, width)
    assert slow == pytest.approx(expected, rel=1e-6)


def test_mean_force_tends_to_that_of_an_instant_opening():
    instant = scroll_gas_cycle(WRAPS, GAS, ANGLE).tangential_force_n
    wide, narrow = (
        scroll_gas_cycle(WRAPS, opening_over(GAS, degrees), ANGLE).tangential_force_n
        for degrees in (4.0, 0.5)
    )
    away = [abs(float(force.mean() - instant.mean())) for force in (wide, narrow)]
    assert away[1] < 0.25 * away[0]
    # Away from the opening, whose first contact is at 210°, nothing changes at all.
    later = np.abs(np.degrees(ANGLE) - 210.0) > 4.1
    assert wide[later] == pytest.approx(instant[later], rel=1e-12)


@settings(max_examples=25, deadline=None)
@given(st.floats(2.0, 359.0), st.sampled_from(CASES), st.sampled_from([WRAPS, OTHER_WRAPS]))
def test_force_is_continuous(degrees, case, wraps):
    """Its largest change from sample to sample is that of the slopes times the sample's angle."""
    gas = opening_over(gas_of(case), degrees)
    angle = uniform_crank_angle(7200)
    cycle = scroll_gas_cycle(wraps, gas, angle)
    step = abs(built_in_pressure_pa(wraps, gas) - gas.discharge_pressure_pa)
    rise = np.pi / (2.0 * np.radians(degrees)) * step
    # Of compression, p n/t a radian; and t falls by one a radian.
    highest = max(built_in_pressure_pa(wraps, gas), gas.discharge_pressure_pa)
    least = wraps.start_angle_rad + 0.5 * np.pi
    compression = highest * gas.polytropic_index / least
    slope = (rise + compression) * 2.0 * wraps.end_angle_rad + highest
    width = 2.0 * wraps.base_radius_m * wraps.height_m
    jump = np.abs(np.diff(cycle.tangential_force_n, append=cycle.tangential_force_n[0])).max()
    assert jump < width * slope * 2.0 * np.pi / angle.size
    if degrees > 30.0:  # an instant opening jumps by more than that
        instant = scroll_gas_cycle(wraps, opening_over(gas, 0.0), angle).tangential_force_n
        assert np.abs(np.diff(instant)).max() > 2.0 * jump


def test_pressure_passes_half_of_the_step_in_the_middle():
    gas, opening = opening_over(GAS, 20.0), WRAPS.opening_angle_rad
    start, middle, end = pocket_pressure(WRAPS, gas, opening + np.radians([0.0, 10.0, 20.0]))
    assert start == pytest.approx(built_in_pressure_pa(WRAPS, gas), rel=1e-9)
    assert end == GAS.discharge_pressure_pa
    # A pocket opens 1e-9 rad early, and there the pressure changes by π/2 of the step a width.
    early = 0.5 * np.pi * abs(end - start) / np.radians(20.0) * 1.1e-9
    assert middle == pytest.approx(0.5 * (start + end), abs=early)


def test_high_orders_fall_as_those_of_a_half_cosine_and_of_two_kinks():
    """A pocket pushes with 2 r_b h 2π p, as its contacts lie 2π apart.

    A step over half a cosine has the orders 1/(π k) of a step times 1/(1 - (kw/π)²) at most. The
    kinks where compression p n/t per radian begins and ends have 1/(π k²) of the slope; jumps of
    the curvature are smaller by (n + 1)/(t k), 3 % at order 40.
    """
    width, order = np.radians(20.0), np.arange(40, 121)
    instant, slow = (
        np.abs(order_spectrum(scroll_gas_cycle(WRAPS, gas, ANGLE).tangential_force_n, 120))
        for gas in (GAS, opening_over(GAS, 20.0))
    )
    built_in, n = built_in_pressure_pa(WRAPS, GAS), GAS.polytropic_index
    closed, opened = (
        WRAPS.end_angle_rad - 1.5 * np.pi - angle for angle in (0.0, WRAPS.opening_angle_rad)
    )
    slopes = n * (built_in / opened + GAS.suction_pressure_pa / closed)
    step = abs(built_in - GAS.discharge_pressure_pa) / ((order * width / np.pi) ** 2 - 1.0)
    per_pressure = 4.0 * np.pi * WRAPS.base_radius_m * WRAPS.height_m
    allowed = per_pressure * (step + slopes / order) / (np.pi * order)
    assert np.all(slow[order] < 1.04 * allowed)
    assert np.all(instant[order] > 5.0 * slow[order])
    assert np.all(slow[1:4] > 0.9 * instant[1:4])
