"""A pocket that opens with inertia: volumes, steady course, work, what it needs of the machine."""

from dataclasses import fields

import numpy as np
import pytest
from scroll_closed_forms import compression_work_j
from scroll_openings import GAS, OPENING, POINTS, SPEED_RPM, WRAPS, gas_at
from test_scroll_gas import OTHER_WRAPS

from vibroacoustics.base.errors import ParameterError, SolverError
from vibroacoustics.mechanics.rotation import uniform_crank_angle
from vibroacoustics.sources.scroll_gas.cycle import scroll_gas_cycle
from vibroacoustics.sources.scroll_gas.opening import (
    REPEATED,
    STEPS,
    STEPS_PER_S,
    opening_constants,
    steady_opening,
)
from vibroacoustics.sources.scroll_gas.opening_equations import density
from vibroacoustics.sources.scroll_gas.parameters import (
    chamber_volume_m3,
    contacts_at_opening,
    least_chamber_volume_m3,
    pair_volume_m3,
    pocket_volume,
    swept_volume_m3,
)
from vibroacoustics.sources.scroll_gas.suction import built_in_pressure_pa, pocket_pressure

ANGLE = uniform_crank_angle(8192)
HALF, TURN = np.pi, 2.0 * np.pi


# --- volumes -------------------------------------------------------------------------------------


@pytest.mark.parametrize("wraps", [WRAPS, OTHER_WRAPS])
def test_volumes_close_over_a_turn(wraps):
    """Pair and chamber lose twice the volume of a pocket that opens, and no volume jumps."""
    at_opening = 5e-6
    opened = 2.0 * float(pocket_volume(wraps, np.asarray(wraps.opening_angle_rad)))
    before, after = np.nextafter(HALF, 0.0), HALF
    pair = pair_volume_m3(wraps, np.array([0.0, before]))
    chamber = chamber_volume_m3(wraps, at_opening, np.array([0.0, before, after, TURN]))
    lost = pair[0] - pair[1] + chamber[0] - chamber[1] + chamber[2] - chamber[3]
    assert pair[0] == pytest.approx(opened, rel=1e-12)
    assert chamber[3] == pytest.approx(chamber[0], rel=1e-12)
    assert chamber[2] == pytest.approx(chamber[1] + pair[1], rel=1e-12)
    assert lost == pytest.approx(opened, rel=1e-9)


def test_volumes_are_those_of_the_wraps():
    """16.16 cm³ a pair; the chamber needs more than 1.53 cm³ (q t_i²/2, t_i = 150°)."""
    assert 1e6 * pair_volume_m3(WRAPS, np.zeros(())) == pytest.approx(16.16, abs=0.005)
    assert np.degrees(contacts_at_opening(WRAPS)) == pytest.approx([510.0, 150.0])
    assert 1e6 * least_chamber_volume_m3(WRAPS) == pytest.approx(1.53, abs=0.005)


@pytest.mark.parametrize("start_deg", [45.0, 60.0, 100.0, 180.0])
def test_least_chamber_is_the_most_that_is_swept_of_it(start_deg):
    """Whether or not its contacts reach t = 0 before it is one with the pair."""
    wraps = WRAPS.model_copy(update={"start_angle_rad": np.radians(start_deg)})
    least = least_chamber_volume_m3(wraps)
    angle = np.linspace(0.0, TURN, 200001)
    volume = chamber_volume_m3(wraps, least, angle)
    assert abs(volume.min()) < 1e-9 * swept_volume_m3(wraps)


# --- steady course -------------------------------------------------------------------------------


def sampled(steps):
    """Pressures over the discharge pressure, port flow over its mean, at 1001 angles."""
    opened, angle = (
        steady_opening(WRAPS, GAS, OPENING, SPEED_RPM, steps),
        np.linspace(0, TURN, 1001),
    )
    mean = opening_constants(WRAPS, GAS, OPENING, SPEED_RPM).mean_flow
    scale = {"port_flow_kg_per_s": mean, "gap_flow_kg_per_s": mean}
    return np.array(
        [
            np.interp(angle, opened.since_opening, getattr(opened, field.name))
            / scale.get(field.name, GAS.discharge_pressure_pa)
            for field in fields(opened)[1:6]
        ]
    )


def test_course_converges_with_the_step():
    """60 000 steps as 200 000; those that are taken lose nothing that anyone hears."""
    finest, fine, taken = (sampled(steps) for steps in (200_000, 60_000, STEPS))
    off_fine, off_taken = (np.abs(one - finest).max(axis=1) for one in (fine, taken))
    print("60 000 against 200 000 steps:", off_fine, f"{STEPS}:", off_taken)
    assert off_fine.max() < 1e-9
    assert off_taken[:3].max() < 1e-5
    assert off_taken[3:].max() < 5e-4


@pytest.mark.parametrize("speed_rpm", [60.0, 20000.0])
def test_slow_and_fast_shafts_have_a_course(speed_rpm):
    """A slow one lets the gas come to rest, so that the pressure is even before the turn ends."""
    opened = steady_opening(WRAPS, GAS, OPENING, speed_rpm)
    over = np.abs(opened.chamber_pa[-1] / GAS.discharge_pressure_pa - 1.0)
    assert np.all(np.isfinite(opened.pair_pa))
    assert over < (1e-3 if speed_rpm < 100.0 else 0.2)
    assert opened.since_opening.size - 1 >= max(STEPS, STEPS_PER_S * 60.0 / speed_rpm)


@pytest.mark.parametrize("point", POINTS)
def test_mass_and_state_are_the_same_after_a_turn(point):
    """What flows through the port is what two pockets hold when they open."""
    gas = gas_at(point)
    opened = steady_opening(WRAPS, gas, OPENING, SPEED_RPM)
    constants = opening_constants(WRAPS, gas, OPENING, SPEED_RPM)
    built_in = built_in_pressure_pa(WRAPS, gas)
    assert opened.pair_pa[0] == pytest.approx(built_in, rel=1e-12)
    for pressure in (opened.chamber_pa, opened.plenum_pa):
        assert abs(pressure[-1] - pressure[0]) < REPEATED * GAS.discharge_pressure_pa
    mass = density(built_in, constants) * float(pair_volume_m3(WRAPS, np.zeros(())))
    flow = opened.port_flow_kg_per_s
    mean = float(np.trapezoid(flow, opened.since_opening)) / TURN
    assert mean == pytest.approx(mass * SPEED_RPM / 60.0, rel=REPEATED)
    cycle = scroll_gas_cycle(WRAPS, gas, ANGLE, opened)
    assert cycle.port_flow_kg_per_s.mean() == pytest.approx(mean, rel=1e-5)


@pytest.mark.parametrize("point", POINTS)
def test_work_on_the_shaft_is_that_on_the_gas(point):
    """Until a pocket opens, of a polytrope; from then on -∮ p dV of pair and chamber."""
    gas = gas_at(point)
    opened = steady_opening(WRAPS, gas, OPENING, SPEED_RPM)
    cycle = scroll_gas_cycle(WRAPS, gas, ANGLE, opened)
    angle, half = opened.since_opening, STEPS // 2
    pair = pair_volume_m3(WRAPS, angle[: half + 1])
    inner = chamber_volume_m3(WRAPS, OPENING.chamber_volume_m3, angle)
    inner[half] -= pair[-1]  # where the two become one
    work = -np.trapezoid(opened.pair_pa[: half + 1], pair)
    work -= np.trapezoid(opened.chamber_pa[: half + 1], inner[: half + 1])
    inner[half] += pair[-1]
    work -= np.trapezoid(opened.chamber_pa[half:], inner[half:])
    at_once = compression_work_j(WRAPS, gas)
    trapped = float(pair_volume_m3(WRAPS, np.zeros(())))
    expected = at_once + work - gas.discharge_pressure_pa * trapped
    obtained = TURN * cycle.torque_n_m.mean()
    print(f"{point}: at once {at_once:.2f} J, expected {expected:.3f}, obtained {obtained:.3f}")
    assert obtained == pytest.approx(expected, rel=1e-4)
    assert obtained == pytest.approx(at_once, rel=0.05)


def test_forces_start_from_the_built_in_pressure_and_stay_finite():
    opened = steady_opening(WRAPS, GAS, OPENING, SPEED_RPM)
    opening = WRAPS.opening_angle_rad
    at = opening + np.array([-1e-6, 0.0, 1e-6, TURN - 1e-6, TURN, TURN + 1e-6])
    pressure = pocket_pressure(WRAPS, GAS, at, opened)
    assert pressure[:3] == pytest.approx(built_in_pressure_pa(WRAPS, GAS), rel=1e-5)
    assert pressure[3:] == pytest.approx(opened.chamber_pa[-1], rel=1e-5)
    cycle = scroll_gas_cycle(WRAPS, GAS, ANGLE, opened)
    for force in (cycle.tangential_force_n, cycle.radial_force_n, cycle.axial_force_n):
        assert np.all(np.isfinite(force))
        assert np.all(force > 0.0)
        # No sample stands out: nothing jumps by more than a hundredth of the force.
        assert np.abs(np.diff(force, append=force[0])).max() < 0.01 * force.max()
    # Across the flanks acts the pressure of the chamber over that of the suction.
    inner = cycle.radial_force_n / (2.0 * WRAPS.base_radius_m * WRAPS.height_m)
    over = opened.chamber_pa - GAS.suction_pressure_pa
    assert [inner.min(), inner.max()] == pytest.approx([over.min(), over.max()], rel=1e-4)


# --- what is refused -----------------------------------------------------------------------------


def test_a_chamber_that_would_vanish_is_refused():
    small = OPENING.model_copy(update={"chamber_volume_m3": 1.5e-6})
    with pytest.raises(ParameterError, match=r"chamber_volume_cm3 = 1.5 cm³: must exceed 1.53"):
        steady_opening(WRAPS, GAS, small, SPEED_RPM)


@pytest.mark.parametrize("name", ["discharge_density_kg_per_m3", "discharge_sound_speed_m_per_s"])
def test_a_gas_without_its_state_is_refused(name):
    with pytest.raises(ParameterError, match=f"gas.{name}: is missing"):
        steady_opening(WRAPS, GAS.model_copy(update={name: None}), OPENING, SPEED_RPM)


def test_a_course_that_breaks_down_is_refused():
    with pytest.raises(SolverError, match="do not come to a periodic solution"):
        steady_opening(WRAPS, GAS, OPENING, SPEED_RPM, steps=16)
