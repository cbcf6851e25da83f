"""The slider-link compressor of Dagilis et al.: invariants, a second method with Lagrange
multipliers, the machine in the chain."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import ValidationError
from scipy.integrate import quad, solve_ivp
from slider_link_files import MACHINE_FILE, SPEED, STUDY, changed_machine
from slider_link_pairs import free_acceleration, internal_forces, short_bearing_load
from support import steady

from vibroacoustics.balancers.lanchester import Lanchester
from vibroacoustics.balancers.rotating_counterweight import RotatingCounterweight
from vibroacoustics.base.constants import STANDARD_GRAVITY_M_PER_S2
from vibroacoustics.base.errors import ParameterError, SolverError
from vibroacoustics.mechanics.moving_parts import (
    MovingPart,
    Revolution,
    Wrench,
    path,
    wrench,
    wrenches_of_parts,
)
from vibroacoustics.mechanics.rotation import constant_rotation
from vibroacoustics.mechanisms.slider_link.bearing_friction import (
    eccentricity_ratio,
    journal_friction_moment,
    petroff_coefficient,
    short_bearing_friction,
    thrust_friction_moment,
)
from vibroacoustics.mechanisms.slider_link.crankshaft import (
    bearing_forces,
    crank_coefficients,
    crank_forces,
    crank_pin_force,
)
from vibroacoustics.mechanisms.slider_link.machine import SliderLinkMachine
from vibroacoustics.mechanisms.slider_link.motion import GaussPanels, SliderLinkCycle, steady_motion
from vibroacoustics.mechanisms.slider_link.parameters import JournalBearing
from vibroacoustics.mechanisms.slider_link.piston import (
    SIDES,
    CrankState,
    check_not_jammed,
    cylinder_pressure,
    engaged_length,
    gas_force,
    piston_matrix,
    piston_velocity,
    slider_velocity,
    valve_angles,
)
from vibroacoustics.mechanisms.slider_link.revolution import unbalance
from vibroacoustics.orders import order_spectrum, order_spectrum_at_speed
from vibroacoustics.study.loading import load_machine, load_study
from vibroacoustics.transfer import MachineOnMounts

ROUNDING = 1e-11
"""Rounding of a 3 x 3 solve and the products that follow, relative to the largest force."""


EPSILON = np.finfo(float).eps


def _imbalance_ratio(cycle):
    """Work of the motor less that which all others take, over that of the gas."""
    taken = sum(work for name, work in cycle.work_j.items() if name != "motor")
    return abs(cycle.work_j["motor"] - taken) / cycle.work_j["gas"]


def total(wrenches) -> Wrench:
    """Resultant of all sources."""
    return Wrench(*(sum(parts) for parts in zip(*wrenches.values(), strict=True)))


@pytest.fixture(scope="module")
def machine() -> SliderLinkMachine:
    return load_machine(MACHINE_FILE)


@pytest.fixture(scope="module")
def skewed() -> SliderLinkMachine:
    """Boundary friction as the paper names it and a mass centre beside the cylinder's axis."""
    return changed_machine(
        mechanism__link_friction_ratio=0.1,
        mechanism__cylinder_friction_ratio=0.15,
        mechanism__piston_mass_offset_mm=0.8,
        mechanism__link_offset_mm=-1.5,
    )


@pytest.fixture(scope="module")
def cycle(machine) -> SliderLinkCycle:
    return steady_motion(machine, SPEED)


@pytest.fixture(scope="module")
def skewed_cycle(skewed) -> SliderLinkCycle:
    return steady_motion(skewed, SPEED, 360)


@pytest.fixture(scope="module", params=["machine", "skewed"])
def case(request) -> tuple[SliderLinkMachine, SliderLinkCycle]:
    names = {"machine": "cycle", "skewed": "skewed_cycle"}
    return request.getfixturevalue(request.param), request.getfixturevalue(names[request.param])


# --- the paper's expressions, verbatim -----------------------------------------------------------


@pytest.fixture(scope="module")
def anywhere(skewed) -> tuple[CrankState, np.ndarray, np.ndarray, np.ndarray]:
    """Random crank states with random signs."""
    rng = np.random.default_rng(3)
    state = CrankState(
        rng.uniform(0.0, 2.0 * np.pi, 64), rng.uniform(200.0, 400.0, 64), rng.normal(0.0, 1e3, 64)
    )
    return state, rng.choice(SIDES, 64), *rng.choice([1.0, -1.0], (2, 64))


def test_determinants_of_table_1(skewed, anywhere):
    """(12) to (15) as printed, with the friction's arm D_s/2 of (9)."""
    state, sides, d1, d2 = anywhere
    d3, d4, d5 = sides.T
    m = skewed.mechanism
    R, Lp, Lc, D, Ds = (
        m.crank_radius_m, m.piston_length_m, m.cylinder_length_m, m.bore_m, m.slider_diameter_m,
    )  # fmt: skip
    e, ecl, mc, ms = (
        m.link_offset_m, m.piston_mass_offset_m, m.cylinder_friction_ratio, m.link_friction_ratio,
    )  # fmt: skip
    s, c = np.sin(state.angle), np.cos(state.angle)
    inertia, load = np.full(64, -37.0), np.full(64, 210.0)  # m_p ẍ_p, F_g - F_FG
    whole = (
        (
            (((R * (1 - c) + Lp - Lc) * d5 - Ds / 2) * d3 + (Ds / 2 - Lp * d5) * d4) * d2 * ms
            + (d3 - d4) * (R * s + e)
        )
        * d1
        * mc
        + d2 * d5 * mc**2 * ms * (d3 - d4) * D / 2
        + R * (c - 1)
        + Lc
    )
    first = (
        (((D / 2 + ecl * d4) * d1 * mc + Lp - Lc + R * (1 - c)) * d5 - Ds / 2) * d2 * ms
        + e + R * s - ecl
    ) * inertia + (
        ((d1 * mc * D / 2 + Lp - Lc + R * (1 - c)) * d5 - Ds / 2) * d2 * ms + e + R * s
    ) * load  # fmt: skip
    second = (
        (Ds / 2 - ((d3 * ecl + D / 2) * d1 * mc + Lp) * d5) * d2 * ms + ecl - e - R * s
    ) * inertia + ((Ds / 2 - (d1 * mc * D / 2 + Lp) * d5) * d2 * ms - e - R * s) * load
    third = (d1 * mc * ecl * (d3 - d4) + Lc + R * (c - 1)) * inertia + (Lc + R * (c - 1)) * load
    matrix = piston_matrix(m, state.angle, sides, d1, d2, Ds / 2)
    right = np.stack([load + inertia, 0.0 * load, inertia * ecl], axis=-1)
    np.testing.assert_allclose(np.linalg.det(matrix), whole, rtol=ROUNDING)
    for column, expected in enumerate((first, second, third)):
        replaced = matrix.copy()
        replaced[:, :, column] = right
        # |A1| to |A3| are differences of products of 200 N with up to 0.1 m.
        np.testing.assert_allclose(np.linalg.det(replaced), expected, atol=ROUNDING * 100.0)


def _gammas(machine, state, contacts):
    """γ1 γ2, γ1 γ3 (31)."""
    m = machine.mechanism
    matrix = piston_matrix(
        m, state.angle, contacts.sides, contacts.piston_sense, contacts.slider_sense
    )
    third = engaged_length(m, state.angle)
    sides = contacts.sides[:, 0] - contacts.sides[:, 1]
    second = third + (
        contacts.piston_sense * m.cylinder_friction_ratio * m.piston_mass_offset_m * sides
    )
    return second / np.linalg.det(matrix), third / np.linalg.det(matrix)


def test_bearing_forces_of_table_2(skewed, anywhere):
    """Table 2 as printed, without the crank pin's friction on the piston."""
    state = anywhere[0]
    forces = crank_forces(skewed, state, np.zeros(64))
    masses, heights, R = skewed.masses, skewed.heights, skewed.mechanism.crank_radius_m
    g12, g13 = _gammas(skewed, state, forces.contacts)
    zp, zs, zb = heights.upper_bearing_m, heights.piston_axis_m, heights.bearing_distance_m
    mp, ms = masses.piston_mass_kg, masses.slider_mass_kg
    J = masses.crankshaft_product_kg_m2
    mr = masses.crankshaft_mass_kg * masses.crankshaft_mass_offset_m
    rub = (
        forces.contacts.slider_sense * forces.contacts.sides[:, 2]
        * skewed.mechanism.link_friction_ratio
    )  # fmt: skip
    load = forces.gas - forces.film
    a = state.acceleration * np.sin(state.angle) + state.velocity**2 * np.cos(state.angle)
    b = state.acceleration * np.cos(state.angle) - state.velocity**2 * np.sin(state.angle)
    upper_x = (
        a * (J + mr * (zp - zs + zb) - R * (zp + zb) * (g12 * mp + ms)) + g13 * load * (zp + zb)
    ) / zb
    lower_x = -(a * (J + mr * (zp - zs) - R * zp * (g12 * mp + ms)) + g13 * zp * load) / zb
    upper_y = -(
        b * (J + mr * (zp - zs + zb) - R * (zp + zb) * ms)
        + a * rub * g12 * R * (zp + zb) * mp - rub * g13 * (zp + zb) * load
    ) / zb  # fmt: skip
    lower_y = -(
        b * (-J - mr * (zp - zs) + R * zp * ms) - a * rub * g12 * R * zp * mp
        + rub * g13 * zp * load
    ) / zb  # fmt: skip
    scale = np.max(np.abs(forces.upper_bearing))
    np.testing.assert_allclose(forces.upper_bearing, [upper_x, upper_y], atol=ROUNDING * scale)
    np.testing.assert_allclose(forces.lower_bearing, [lower_x, lower_y], atol=ROUNDING * scale)


def test_torque_of_the_crank_pin(skewed, anywhere):
    """(33): F_kx R sin φ - F_ky R cos φ = -γ4 φ̈ - γ5 φ̇² - γ6 (F_g - F_FG)."""
    state = anywhere[0]
    forces = crank_forces(skewed, state, np.zeros(64))
    fourth, fifth, sixth, _ = crank_coefficients(skewed, state.angle, forces.contacts)
    arm = skewed.mechanism.crank_radius_m * np.stack([np.sin(state.angle), -np.cos(state.angle)])
    by_gammas = -(
        fourth * state.acceleration + fifth * state.velocity**2
        + sixth * (forces.gas - forces.film)
    )  # fmt: skip
    np.testing.assert_allclose(
        np.sum(forces.crank_pin * arm, axis=0), by_gammas, atol=ROUNDING * np.max(np.abs(by_gammas))
    )


# --- contacts ------------------------------------------------------------------------------------


def test_forces_have_the_signs_assumed(case):
    _, cycle = case
    contacts = cycle.forces.contacts
    forces = np.stack([contacts.front, contacts.rear, contacts.link], axis=-1)
    assert np.all(forces * contacts.sides >= -ROUNDING * np.max(np.abs(forces)))


def test_the_piston_changes_sides(cycle):
    """It tilts both ways, is pressed to one side, and the link is pushed and pulled."""
    sides = cycle.forces.contacts.sides
    kinds = {tuple(side) for side in sides}
    assert {(1.0, -1.0, 1.0), (-1.0, 1.0, 1.0)} <= kinds
    assert any(front == rear for front, rear, _ in kinds)
    assert {link for _, _, link in kinds} == {1.0, -1.0}


def test_friction_takes_power(case):
    machine, cycle = case
    assert all(work > 0.0 for work in cycle.work_j.values())
    contacts = cycle.forces.contacts
    assert np.all(contacts.piston_sense * piston_velocity(machine.mechanism, cycle.state) <= 0.0)


def test_jamming_is_refused():
    """A long tilt: 1 mm of engaged length at the lower dead centre."""
    jammed = changed_machine(
        mechanism__cylinder_length_mm=19.0,
        mechanism__cylinder_friction_ratio=0.5,
        mechanism__link_friction_ratio=0.5,
    )
    with pytest.raises(ParameterError, match=r"cylinder_friction_ratio = 0\.5.*jams"):
        check_not_jammed(jammed.mechanism)
    with pytest.raises(ParameterError, match="jams"):
        steady_motion(jammed, SPEED)


# --- balances ------------------------------------------------------------------------------------


def test_energy_balance(case):
    """Motor work less gas work and friction, to 1e-6 of the gas work."""
    _, cycle = case
    assert _imbalance_ratio(cycle) < 1e-6


def test_gas_work_is_that_of_the_polytropic_cycle(machine, cycle):
    """W = n/(n-1) p_s V_taken (ratio^((n-1)/n) - 1)."""
    gas, n = machine.gas, machine.gas.exponent_ratio
    ratio = gas.discharge_pressure_pa / gas.suction_pressure_pa
    swept = np.pi / 2.0 * machine.mechanism.bore_m**2 * machine.mechanism.crank_radius_m
    taken = swept * (1.0 + gas.clearance_ratio * (1.0 - ratio ** (1.0 / n)))
    work = n / (n - 1.0) * gas.suction_pressure_pa * taken * (ratio ** ((n - 1.0) / n) - 1.0)
    assert cycle.work_j["gas"] == pytest.approx(work, rel=1e-9)


def test_virtual_work_is_the_newton_euler_torque(case):
    """Torques from the powers of all forces meet I φ̈ + I' φ̇²/2 at every angle."""
    machine, cycle = case
    state, forces, contacts = cycle.state, cycle.forces, cycle.forces.contacts
    mechanism, masses, R = machine.mechanism, machine.masses, machine.mechanism.crank_radius_m
    piston, slider = piston_velocity(mechanism, state), slider_velocity(mechanism, state)
    rubbed = mechanism.cylinder_friction_ratio * (np.abs(contacts.front) + np.abs(contacts.rear))
    power = (
        cycle.motor_torque_n_m * state.velocity
        - (forces.gas - forces.film) * piston
        - rubbed * np.abs(piston)
        - mechanism.link_friction_ratio * np.abs(contacts.link * slider)
        - sum(forces.friction_moments.values()) * state.velocity
    )
    inertia = masses.crankshaft_inertia_kg_m2 + R**2 * (
        masses.slider_mass_kg + masses.piston_mass_kg * np.sin(state.angle) ** 2
    )
    slope = R**2 * masses.piston_mass_kg * np.sin(2.0 * state.angle)
    expected = inertia * state.acceleration + 0.5 * slope * state.velocity**2
    # The settled acceleration is good to 1e-12 of its largest value, torques reach 5 N m.
    np.testing.assert_allclose(power / state.velocity, expected, atol=1e-10)


def test_momentum_change_is_the_resultant_on_the_block(case):
    """Gas, contacts, bearings and motor on the block add up to (40), moments with R² included."""
    machine, cycle = case
    change = total(unbalance(machine, cycle.state))
    pairs = internal_forces(machine, cycle.state, cycle.forces, cycle.motor_torque_n_m)
    np.testing.assert_allclose(total(pairs).force_n, change.force_n, atol=1e-9)
    # The settled acceleration and friction are good to 1e-12.
    np.testing.assert_allclose(total(pairs).moment_n_m, change.moment_n_m, atol=1e-10)


def test_printed_moment_of_the_slider_misses_it(machine, cycle):
    """With R for R² in (40) the moment about the shaft is off by m_s (R - R²) φ̈."""
    pairs = internal_forces(machine, cycle.state, cycle.forces, cycle.motor_torque_n_m)
    moment = total(pairs).moment_n_m[2]
    R, mass = machine.mechanism.crank_radius_m, machine.masses.slider_mass_kg
    printed_z = (
        total(unbalance(machine, cycle.state)).moment_n_m[2]
        - mass * (R - R**2) * cycle.state.acceleration
    )
    off = np.max(np.abs(printed_z - moment)) / np.max(np.abs(moment))
    assert off > 0.1


def test_the_slider_moment_that_the_paper_leaves_out(skewed, skewed_cycle):
    """With the arm D_s/2 of (9) and without M_b, the contacts' moment about the shaft is off.

    By µ_s F_BN D_s/2 less the crank pin's friction: what the slider would be out of balance by.
    """
    state, forces = skewed_cycle.state, skewed_cycle.forces
    m, contacts = skewed.mechanism, forces.contacts
    mass = skewed.masses.piston_mass_kg
    inertia = -mass * m.crank_radius_m * state.along
    matrix = piston_matrix(
        m, state.angle[:, None], SIDES, contacts.piston_sense[:, None],
        contacts.slider_sense[:, None], m.slider_diameter_m / 2,
    )  # fmt: skip
    right = np.stack(
        [forces.gas - forces.film + inertia, 0 * inertia, inertia * m.piston_mass_offset_m], -1
    )
    found = np.linalg.solve(matrix, right[:, None, :, None])[..., 0]
    chosen = np.argmax(np.min(found * SIDES, axis=-1), axis=-1)
    front, rear, link = found[np.arange(len(chosen)), chosen].T
    printed_contacts = replace(contacts, front=front, rear=rear, link=link, sides=SIDES[chosen])
    with_arm = crank_forces(skewed, state, np.zeros_like(front))
    pin = crank_pin_force(skewed, state, printed_contacts)
    upper, lower = bearing_forces(skewed, state, pin)
    moments = dict(with_arm.friction_moments)
    printed_forces = replace(
        with_arm, contacts=printed_contacts, crank_pin=pin, upper_bearing=upper,
        lower_bearing=lower, friction_moments=moments,
    )  # fmt: skip
    R = m.crank_radius_m
    spin = skewed.masses.crankshaft_inertia_kg_m2 * state.acceleration
    torque = (
        spin + sum(moments.values())
        - R * (np.sin(state.angle) * pin[0] - np.cos(state.angle) * pin[1])
    )  # fmt: skip  # (29)
    pairs = internal_forces(skewed, state, printed_forces, torque)
    missing = total(unbalance(skewed, state)).moment_n_m[2] - total(pairs).moment_n_m[2]
    arm = 0.5 * m.slider_diameter_m * m.link_friction_ratio * contacts.slider_sense
    expected = arm * link - moments["crank_pin"]
    np.testing.assert_allclose(np.abs(missing), np.abs(expected), atol=1e-9)
    assert np.max(np.abs(missing)) > 0.5  # N m, beside a resultant of a few


# --- the crank's motion --------------------------------------------------------------------------


def test_mean_velocity_and_period(cycle):
    velocity, time = cycle.state.velocity, cycle.time_s
    assert 2.0 * np.pi * np.mean(1.0 / velocity) == pytest.approx(2.0 * np.pi / SPEED, rel=1e-9)
    assert time[0] == 0.0
    assert np.all(np.diff(time) > 0.0)


def test_motion_converges_with_the_panels(machine, cycle):
    """No error above 1e-7 with 1/15 of the panels; the kinks where sides change limit it."""
    coarse = steady_motion(machine, SPEED, 48)
    np.testing.assert_allclose(coarse.state.velocity, cycle.state.velocity[::15], rtol=1e-7)


@pytest.mark.parametrize("slope", [0.5, 10.0])
def test_motor_smooths_the_speed_like_a_low_pass(machine, slope):
    """Order n of the velocity falls as 1/√(1 + (s/n)²), s = slope / (J ω)."""
    base, steep = (
        steady_motion(
            machine.model_copy(
                update={"motor": machine.motor.model_copy(update={"slope_n_m_s_per_rad": value})}
            ),
            SPEED,
            96,
        )
        for value in (0.0, slope)
    )
    R = machine.mechanism.crank_radius_m
    swinging = R**2 * machine.masses.piston_mass_kg
    inertia = machine.masses.crankshaft_inertia_kg_m2 + 0.5 * swinging
    orders = np.arange(1, 4)
    expected = 1.0 / np.sqrt(1.0 + (slope / (inertia * SPEED * orders)) ** 2)
    ratio = np.abs(np.fft.rfft(steep.state.velocity) / np.fft.rfft(base.state.velocity))[1:4]
    # The inertia swings by this part and couples orders two apart, from either side.
    np.testing.assert_allclose(ratio, expected, rtol=2.0 * swinging / inertia)
    assert _imbalance_ratio(steep) < 1e-6


def test_a_crank_that_would_stop_is_refused(machine):
    with pytest.raises(SolverError, match="stop within the revolution"):
        steady_motion(machine, 20.0, 96)


@pytest.mark.parametrize("bad", [0.0, -1.0, np.nan, np.inf])
def test_bad_velocity_is_refused(machine, bad):
    with pytest.raises(ParameterError, match="mean_velocity"):
        steady_motion(machine, bad)


@pytest.mark.parametrize("bad", [0, 15, 102])
def test_bad_number_of_samples_is_refused(machine, bad):
    with pytest.raises(ParameterError, match="samples"):
        steady_motion(machine, SPEED, bad)


# --- a second method: Lagrange multipliers -------------------------------------------------------


def lagrange(machine, angle, velocity, torque):
    """Accelerations and constraint forces of three rigid bodies in the plane.

    Piston, slider (x, y, turn each) and crank (turn); constraints: front, rear, link, no turn
    between link and slider, pin along x and y. Friction from the multipliers, iterated.
    """
    m, masses, R = machine.mechanism, machine.masses, machine.mechanism.crank_radius_m
    s, c = np.sin(angle), np.cos(angle)
    state = CrankState(np.array([angle]), np.array([velocity]), np.zeros(1))
    axis = -m.link_offset_m
    centre = np.array([R * c + 0.012, axis + m.piston_mass_offset_m])  # its x does not matter
    pin = np.array([R * c, R * s])
    head, foot = R * c + m.piston_length_m, R + m.piston_length_m - m.cylinder_length_m
    v_piston, v_slider = -R * velocity * s, R * velocity * c
    gas = float(gas_force(m, machine.gas, state.angle)[0])
    wetted = m.cylinder_length_m - R * (1 - c)
    film = -machine.oil.viscosity_pa_s * np.pi * m.bore_m * wetted * v_piston / m.piston_clearance_m
    mass = np.diag(
        [masses.piston_mass_kg] * 2 + [1e-4] + [masses.slider_mass_kg] * 2 + [1e-5]
        + [masses.crankshaft_inertia_kg_m2]
    )  # fmt: skip

    def push(force, place, body_centre):
        lever = np.asarray(place) - body_centre
        return np.array([*force, lever[0] * force[1] - lever[1] * force[0]])

    G = np.zeros((6, 7))
    G[0, :3] = push((0, 1), (head, axis), centre)
    G[1, :3] = push((0, 1), (foot, axis), centre)
    G[2, :3], G[2, 3] = push((1, 0), pin, centre), -1.0
    G[3, 2], G[3, 5] = 1.0, -1.0
    G[4, 3], G[4, 6] = 1.0, R * s
    G[5, 4], G[5, 6] = 1.0, -R * c
    drift = np.array([0, 0, 0, 0, -R * velocity**2 * c, -R * velocity**2 * s])
    friction = dict.fromkeys(("crank_pin", "upper", "lower"), 0.0)
    multipliers, previous = np.zeros(6), np.full(7, np.inf)
    for _ in range(60):
        front, rear, link = multipliers[:3]
        load = np.zeros(7)
        load[:3] += push((film - gas, 0), (0, axis), centre)
        for normal, x in ((front, head), (rear, foot)):
            rub = -np.sign(v_piston) * m.cylinder_friction_ratio * abs(normal)
            load[:3] += push((rub, 0), (x, axis - np.sign(normal) * m.bore_m / 2), centre)
        rub = np.sign(v_slider) * m.link_friction_ratio * abs(link)
        place = pin + np.array([np.sign(link) * m.slider_diameter_m / 2, 0.0])
        load[:3] += push((0, rub), place, centre)
        load[3:6] -= push((0, rub), place, pin)
        load[5] += friction["crank_pin"]
        weight = masses.crankshaft_mass_kg * STANDARD_GRAVITY_M_PER_S2
        steady = thrust_friction_moment(machine.bearings.thrust, weight)
        steady += machine.oil.pump_moment_n_m
        load[6] = torque - sum(friction.values()) - steady
        system = np.block([[mass, -G.T], [G, np.zeros((6, 6))]])
        solution = np.linalg.solve(system, np.concatenate([load, drift]))
        acceleration, multipliers = solution[:7], solution[7:]
        if np.allclose(acceleration, previous, rtol=1e-11, atol=1e-9):
            break
        previous = acceleration
        bearing = static_bearings(machine, angle, velocity, acceleration[6], multipliers[4:])
        loads = {"crank_pin": multipliers[4:], **bearing}
        friction = {
            name: float(
                journal_friction_moment(
                    getattr(machine.bearings, name), np.array([np.hypot(*force)]),
                    np.array([velocity]), machine.oil.viscosity_pa_s,
                )[0]
            )
            for name, force in loads.items()
        }  # fmt: skip
    return acceleration, multipliers, bearing


def static_bearings(machine, angle, velocity, acceleration, pin):
    """Bearing forces from Σ F = 0 and Σ r x F = 0 of the shaft with its inertia, four unknowns."""
    masses, heights = machine.masses, machine.heights
    out = np.array([np.cos(angle), np.sin(angle), 0.0])
    around = np.array([-np.sin(angle), np.cos(angle), 0.0])
    turn = -(velocity**2) * out + acceleration * around
    # Two point masses with the product of inertia; the centre of mass is at height zero.
    inertia = masses.crankshaft_mass_kg * masses.crankshaft_mass_offset_m * turn
    couple = -masses.crankshaft_product_kg_m2 * np.cross([0, 0, 1.0], turn)
    top = np.array([0, 0, -heights.piston_axis_m])
    upper = top + np.array([0, 0, heights.upper_bearing_m])
    lower = upper + np.array([0, 0, heights.bearing_distance_m])
    load = -np.array([*pin, 0.0])
    matrix, right = np.zeros((4, 4)), np.zeros(4)
    for column, (place, direction) in enumerate(
        (p, d) for p in (upper, lower) for d in (np.eye(3)[0], np.eye(3)[1])
    ):
        matrix[:2, column] = direction[:2]
        matrix[2:, column] = np.cross(place, direction)[:2]
    right[:2] = -(load + inertia)[:2]
    right[2:] = -(np.cross(top, load) + couple)[:2]
    found = np.linalg.solve(matrix, right)
    return {"upper": found[:2], "lower": found[2:]}


def test_lagrange_multipliers_agree(case):
    """Accelerations and all constraint forces at 16 angles off the dead centres."""
    machine, cycle = case
    forces, contacts = cycle.forces, cycle.forces.contacts
    for k in range(3, len(cycle.time_s), len(cycle.time_s) // 16):
        acceleration, multipliers, bearing = lagrange(
            machine, cycle.state.angle[k], cycle.state.velocity[k], cycle.motor_torque_n_m[k]
        )
        ours = [contacts.front[k], contacts.rear[k], contacts.link[k], *forces.crank_pin[:, k]]
        scale = np.max(np.abs(ours))
        # The iteration of the friction ends at 1e-11; the 13 x 13 system has condition 1e8.
        np.testing.assert_allclose(multipliers[[0, 1, 2, 4, 5]], ours, atol=1e-8 * scale)
        assert acceleration[6] == pytest.approx(
            cycle.state.acceleration[k], abs=1e-8 * np.max(np.abs(cycle.state.acceleration))
        )
        for name in ("upper", "lower"):
            mine = getattr(forces, f"{name}_bearing")[:, k]
            np.testing.assert_allclose(bearing[name], mine, atol=1e-8 * scale)


@pytest.mark.long
def test_time_integration_returns_after_one_revolution(machine, cycle):
    """SciPy integrates the Lagrange equations over time from our state at crank angle zero."""
    mean = cycle.motor_torque_n_m[0] + machine.motor.slope_n_m_s_per_rad * (
        cycle.state.velocity[0] - SPEED
    )

    def rate(_, state):
        torque = mean - machine.motor.slope_n_m_s_per_rad * (state[1] - SPEED)
        acceleration, _, _ = lagrange(machine, state[0], state[1], torque)
        return [state[1], acceleration[6]]

    start = [0.0, cycle.state.velocity[0]]
    kept = cycle.time_s[::60]
    period = 2.0 * np.pi / SPEED
    found = solve_ivp(
        rate, (0.0, period), start, t_eval=[*kept, period], rtol=1e-8, atol=[1e-10, 1e-7]
    )
    # 1e-8 a step, some 60 steps; a torque wrong by 1 % would change the velocity by 2e-4.
    angle = [*cycle.state.angle[::60], 2.0 * np.pi]
    np.testing.assert_allclose(found.y[0], angle, atol=60e-8 * 2.0 * np.pi)
    velocity = [*cycle.state.velocity[::60], cycle.state.velocity[0]]
    np.testing.assert_allclose(found.y[1], velocity, rtol=60e-8)


# --- gas and bearings ----------------------------------------------------------------------------


def test_pressure_is_continuous_and_the_valves_open_in_time(machine):
    suction, discharge = valve_angles(machine.gas)
    assert 0.0 < suction < np.pi < discharge < 2.0 * np.pi
    near = np.array([suction, discharge, np.pi]) + np.array([[-1e-9], [1e-9]])
    pressure = cylinder_pressure(machine.gas, near)
    low, high = machine.gas.suction_pressure_pa, machine.gas.discharge_pressure_pa
    np.testing.assert_allclose(pressure, [[low, high, low]] * 2, rtol=1e-7)


@pytest.mark.parametrize("ratio", [0.05, 0.5, 0.9])
def test_short_bearing_by_its_film(ratio):
    """Load and friction on the shaft from Ocvirk's pressure and the shear in the film."""
    slenderness = 0.7

    def thickness(angle):
        return 1.0 + ratio * np.cos(angle)

    # Dimensionless: pressure over length, of the half film from 0 to π, with h = c (1 + ε cos).
    def pressure(angle):
        return ratio * np.sin(angle) / thickness(angle) ** 3

    along, _ = quad(lambda a: pressure(a) * np.cos(a), 0.0, np.pi)
    across, _ = quad(lambda a: pressure(a) * np.sin(a), 0.0, np.pi)
    # F = η ω r l³ / (2 c²) · integrals, hence Φ_p = (l/d)² times them.
    load = slenderness**2 * np.hypot(along, across)
    assert float(short_bearing_load(np.array(ratio), slenderness)) == pytest.approx(load, rel=1e-9)
    shear, _ = quad(lambda a: 1.0 / thickness(a), 0.0, 2.0 * np.pi)
    friction = 0.5 * shear + 0.5 * ratio * slenderness**2 * across
    assert float(short_bearing_friction(np.array(ratio), slenderness)) == pytest.approx(
        friction, rel=1e-9
    )


def test_unloaded_bearing_has_petroffs_friction():
    bearing = JournalBearing(radius_m=8e-3, length_m=16e-3, clearance_m=1e-5)
    load, velocity = np.array([1e-3]), np.array([SPEED])
    moment = journal_friction_moment(bearing, load, velocity, 0.005)
    petroff = petroff_coefficient(bearing, load, velocity, 0.005) * load * bearing.radius_m
    np.testing.assert_allclose(moment, petroff, rtol=1e-6)
    none = journal_friction_moment(bearing, np.zeros(1), velocity, 0.005)
    np.testing.assert_allclose(none, petroff, rtol=1e-6)


@given(st.lists(st.floats(0.0, 1e6), min_size=1, max_size=5), st.floats(0.2, 2.0))
def test_eccentricity_carries_the_load(loads, slenderness):
    loads = np.array(loads)
    ratio = eccentricity_ratio(loads, slenderness)
    assert np.all((ratio >= 0.0) & (ratio < 1.0))
    # The last digit of ε is 1e-16 of 1 - ε, which stands squared in the load.
    slack = 4.0 * 2.0**-53 / (1.0 - ratio)
    carried = short_bearing_load(ratio, slenderness)
    np.testing.assert_array_less(np.abs(carried - loads), (slack + 1e-12) * loads + 1e-12)


@pytest.mark.parametrize("bad", [-0.1, 1.0, 2.0, np.nan])
def test_eccentricity_beyond_one_is_refused(bad):
    for function in (short_bearing_load, short_bearing_friction):
        with pytest.raises(ParameterError, match="eccentricity_ratio"):
            function(np.array([0.5, bad]), 1.0)


def test_gauss_panels_integrate_polynomials():
    """Degree 7 over the panels, degree 3 up to each node: exact."""
    panels = GaussPanels(np.array([0.0, 0.3, 1.0, 1.1]))
    x = panels.nodes
    assert panels.integral(8.0 * x**7) == pytest.approx(1.1**8, rel=1e-13)
    inner, edges = panels.running(4.0 * x**3)
    np.testing.assert_allclose(inner, x**4, atol=1e-14)
    np.testing.assert_allclose(edges, panels.edges**4, atol=1e-14)


# --- vibration -----------------------------------------------------------------------------------


def test_unbalance_at_constant_speed(machine):
    """By hand at φ = 0: F_x = ((m_p + m_s) R - m_r e_cr) ω² = (1.17 - 0.48) g m · ω²."""
    state = CrankState(np.array([0.0, 0.5 * np.pi]), np.full(2, SPEED), np.zeros(2))
    force = total(unbalance(machine, state)).force_n
    assert force[0, 0] == pytest.approx((1.17e-3 - 0.48e-3) * SPEED**2, rel=1e-12)
    assert force[1, 1] == pytest.approx((0.27e-3 - 0.48e-3) * SPEED**2, rel=1e-12)
    assert not force[2].any()


def test_moment_about_the_centre_of_mass(machine, cycle):
    """(41): M_Z = M_z - x_c F_y; z up, y and z and the moments about them change sign."""
    paper = total(unbalance(machine, cycle.state))
    force, moment = paper.placed(machine.crank_frame)
    turn = np.array([1.0, -1.0, -1.0])[:, None]
    np.testing.assert_array_equal(force, turn * paper.force_n)
    moment_z = paper.moment_n_m[2] - machine.centre_of_mass_offset_m * paper.force_n[1]
    expected = turn * np.stack([*paper.moment_n_m[:2], moment_z])
    np.testing.assert_allclose(moment, expected, atol=1e-13)


def test_vibration_on_springs_is_the_free_one_above_resonance(machine, cycle):
    """(42) on the internal springs against (43): they differ by (f0/f)² of the highest mode."""
    inside = machine.suspension
    on_springs = MachineOnMounts(inside.block, inside.springs, inside.springs_height_m)
    highest = on_springs.isolation.natural_modes()[0][-1]
    resultant = total(unbalance(machine, cycle.state)).placed(machine.crank_frame)
    orders = order_spectrum(np.concatenate(resultant), 4)
    for order in range(1, 5):
        frequency = order * SPEED / (2.0 * np.pi)
        ratio = (highest / frequency) ** 2
        assert ratio < 0.2
        moving = 2j * np.pi * frequency * on_springs.response(orders[:, order], frequency).velocity
        free = free_acceleration(inside.block, orders[:, order])
        scale = np.sqrt(on_springs.isolation.mass_matrix.diagonal())  # energy norm
        difference = np.linalg.norm(scale * (moving - free)) / np.linalg.norm(scale * free)
        assert difference < 1.05 * ratio / (1.0 - ratio)


# --- in the chain --------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def revolution(machine) -> Revolution:
    return machine.revolution(2950.0, 360)


def test_wrench_is_the_momentum_change_of_the_parts(machine, revolution):
    """Parts along their paths in the machine's frame, z up, and the spin of the crankshaft."""
    masses, radius = machine.masses, machine.mechanism.crank_radius_m
    turn, height = revolution.rotation, machine.heights.piston_axis_m
    angle, axis = turn.crank_angle, -machine.centre_of_mass_offset_m
    arm = machine.mechanism.link_offset_m - machine.mechanism.piston_mass_offset_m
    x, y = axis + radius * np.cos(angle), -radius * np.sin(angle)
    pair = masses.crankshaft_product_kg_m2 / (0.1 * 0.02)  # 0.1 m apart in height, at 20 mm
    out, across = 0.02 * np.cos(angle), -0.02 * np.sin(angle)
    share = masses.crankshaft_mass_offset_m / 0.02
    parts = [
        MovingPart("piston", masses.piston_mass_kg, path(x, arm, height)),
        MovingPart("slider", masses.slider_mass_kg, path(x, y, height)),
        MovingPart("crankshaft", share * masses.crankshaft_mass_kg, path(axis - out, -across, 0.0)),
        MovingPart("crankshaft", pair, path(axis + out, across, -0.05)),
        MovingPart("crankshaft", pair, path(axis - out, -across, 0.05)),
    ]
    by_parts = wrenches_of_parts(parts, turn)
    # Of the point masses' own spin about the shaft only the right amount may count.
    points = (share * masses.crankshaft_mass_kg + 2.0 * pair) * 0.02**2
    spin = masses.crankshaft_inertia_kg_m2 - points
    for name, found in revolution.wrenches.items():
        force, moment = by_parts[name]
        if name == "crankshaft":
            moment = moment + np.outer([0.0, 0.0, 1.0], spin * turn.acceleration_rad_per_s2)
        # Fourier derivatives of 360 samples: 180² eps; forces reach 90 N, moments 6 N m.
        np.testing.assert_allclose(found.force_n, force, atol=180.0**2 * EPSILON * 90.0)
        np.testing.assert_allclose(found.moment_n_m, moment, atol=180.0**2 * EPSILON * 6.0)


@pytest.mark.parametrize("inertia", [1.0, 1000.0])
def test_first_order_of_the_chain_is_that_of_constant_speed(machine, inertia):
    """m R ω² in x and y, in error by twice the mean swing |δ| of the crank about its mean turning.

    2/T ∫ (cos(ωt + δ) - cos ωt) e^(-jωt) dt is at most 2 mean |δ|.
    """
    masses, radius = machine.masses, machine.mechanism.crank_radius_m
    heavy = masses.model_copy(
        update={"crankshaft_inertia_kg_m2": inertia * masses.crankshaft_inertia_kg_m2}
    )
    found = machine.model_copy(update={"masses": heavy}).revolution(2950.0, 360)
    turn = found.rotation
    order = order_spectrum_at_speed(total(found.wrenches).force_n, turn.speed_rad_per_s, 1)[:, 1]
    swing = turn.crank_angle - SPEED * turn.time_s
    slack = 2.0 * np.mean(np.abs(swing - swing.mean()))
    assert slack * inertia < 0.02
    counter = masses.crankshaft_mass_kg * masses.crankshaft_mass_offset_m
    along = (masses.piston_mass_kg + masses.slider_mass_kg) * radius - counter
    across = masses.slider_mass_kg * radius - counter
    scale = masses.piston_mass_kg * radius * SPEED**2
    assert abs(order[0]) == pytest.approx(along * SPEED**2, abs=slack * scale)
    assert abs(order[1]) == pytest.approx(-across * SPEED**2, abs=slack * scale)
    assert order[2] == 0.0


def test_losses_add_up_to_the_shaft_power(machine, revolution):
    facts = dict(revolution.figures)
    gas = 0.01 * facts.pop("mechanical_efficiency_percent") * facts["shaft_power_w"]
    assert facts.pop("speed_fluctuation_percent") == pytest.approx(2.12, abs=0.005)  # golden
    pump = machine.oil.pump_power_w
    assert facts.pop("shaft_power_w") - gas - pump == pytest.approx(sum(facts.values()), rel=1e-9)


def test_any_number_of_samples_is_taken_from_whole_quarters(machine):
    coarse, fine = (machine.revolution(2950.0, count) for count in (90, 360))
    for name, own in coarse.wrenches.items():
        np.testing.assert_array_equal(own.force_n, fine.wrenches[name].force_n[:, ::4])
    assert coarse.figures == fine.figures


@pytest.mark.parametrize("samples", [61, 122])
def test_odd_samples_run(machine, samples):
    found = machine.revolution(2950.0, samples)
    assert found.rotation.speed_rad_per_s.size == samples
    assert found.rotation.duration_s == pytest.approx(60.0 / 2950.0, rel=1e-6)


def test_counterweight_takes_its_share_of_the_piston(machine):
    """It is opposite to a mass s m_p that goes round with the crank pin at the piston's height."""
    turn = constant_rotation(2950.0, 96)
    option = RotatingCounterweight(share_ratio=0.4)
    added = option.added(machine, steady(2950.0, turn.crank_angle.size)).parts
    mass, radius = 0.4 * machine.masses.piston_mass_kg, machine.mechanism.crank_radius_m
    along, across = radius * np.cos(turn.crank_angle), -radius * np.sin(turn.crank_angle)
    round_ = path(along - machine.centre_of_mass_offset_m, across, machine.heights.piston_axis_m)
    left = wrench([*added, MovingPart("pin", mass, round_)], turn)
    # Fourier derivatives of 96 samples: 48² eps of 35 N and 3 N m.
    assert np.max(np.abs(left.force_n)) < 48.0**2 * EPSILON * 35.0
    assert np.max(np.abs(left.moment_n_m)) < 48.0**2 * EPSILON * 3.0
    low, high = machine.counterweights.lower_height_m, machine.counterweights.upper_height_m
    assert {float(part.position_m[2, 0]) for part in added} == {low, high}


def test_lanchester_takes_the_piston_alone(machine):
    turn = constant_rotation(2950.0, 96)
    option = Lanchester(share_ratio=1.0, radius_m=0.015)
    added = wrench(option.added(machine, steady(2950.0, turn.crank_angle.size)).parts, turn)
    size = machine.masses.piston_mass_kg * machine.mechanism.crank_radius_m * SPEED**2
    expected = [-size * np.cos(turn.crank_angle), 0.0 * turn.crank_angle, 0.0 * turn.crank_angle]
    np.testing.assert_allclose(added.force_n, expected, atol=48.0**2 * EPSILON * size)
    # The piston's force acts at its height: M_y = z F_x.
    height = machine.heights.piston_axis_m
    np.testing.assert_allclose(added.moment_n_m[1], height * added.force_n[0], atol=1e-10)


def test_study_loads():
    study = load_study(STUDY)
    kinds = {option.kind for option in study.options.values()}
    assert {"none", "rotating-counterweight", "lanchester", "redesign"} <= kinds
    assert study.options["more-link-offset"].machine.mechanism.link_offset_m == 2e-3


# --- bad geometry --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"mechanism__bore_mm": 0.0}, "mechanism.bore_mm = 0"),
        ({"mechanism__crank_radius_mm": -9.0}, "mechanism.crank_radius_mm = -9"),
        ({"mechanism__cylinder_length_mm": 17.0}, "cylinder_length_mm = 17 mm"),
        ({"mechanism__piston_length_mm": 35.0}, "piston_length_mm = 35 mm"),
        ({"mechanism__piston_clearance_um": -1.0}, "piston_clearance_um = -1"),
        ({"mechanism__slider_diameter_mm": 15.0}, "slider_diameter_mm = 15 mm"),
        ({"bearings__upper__clearance_um": 0.0}, "bearings.upper.clearance_um = 0"),
        ({"bearings__lower__clearance_um": 999.0}, "clearance_um = 999"),
        ({"bearings__thrust__inner_radius_mm": 12.0}, "inner_radius_mm = 12 mm"),
        ({"gas__discharge_pressure_bar": 1.0}, "discharge_pressure_bar = 1 bar"),
        ({"gas__discharge_pressure_bar": 90.0}, "discharge_pressure_bar = 90 bar"),
        ({"masses__piston_mass_kg": 0.0}, "masses.piston_mass_kg = 0"),
        ({"heights__bearing_distance_mm": 0.0}, "heights.bearing_distance_mm = 0"),
        ({"counterweights__upper_height_mm": -60.0}, "upper_height_mm = -60 mm"),
        ({"suspension__springs__pitch_mm": 0.0}, "suspension.springs.pitch_mm = 0"),
        ({"suspension__block__inertia_zz_kg_m2": 1.0}, "largest moment of inertia"),
    ],
)
def test_bad_geometry_is_one_line_naming_the_parameter(change, words):
    with pytest.raises(ParameterError) as error:
        changed_machine(**change)
    assert words in str(error.value)
    assert "\n" not in str(error.value)


NUMBERS = st.floats(allow_nan=True, allow_infinity=True)


@settings(max_examples=60, deadline=None)
@given(
    radius=st.one_of(NUMBERS, st.floats(1e-3, 2e-2)),
    bore=st.one_of(NUMBERS, st.floats(1e-2, 5e-2)),
    length=st.one_of(NUMBERS, st.floats(1e-2, 0.1)),
)
def test_any_geometry_is_refused_or_runs(machine, radius, bore, length):
    changed = machine.mechanism.model_dump() | {
        "crank_radius_m": radius, "bore_m": bore, "piston_length_m": length,
    }  # fmt: skip
    try:
        mechanism = type(machine.mechanism).model_validate(changed)
        cycle = steady_motion(machine.model_copy(update={"mechanism": mechanism}), SPEED, 16)
    except (ValidationError, ParameterError, SolverError):
        return
    assert np.all(np.isfinite(cycle.state.acceleration))
    assert _imbalance_ratio(cycle) < 1e-3  # 16 panels only
