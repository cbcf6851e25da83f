"""Large reciprocating compressor (Tsuji et al. 2012): laws, second methods, bad input."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from machine_files import changed, machine_file
from scipy.integrate import solve_ivp
from slider_crank_parts import slider_crank_parts

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.mechanics.crankshaft import planar, reduced_inertia
from vibroacoustics.mechanics.moving_parts import derivative, wrench
from vibroacoustics.mechanics.rotation import constant_rotation, uniform_crank_angle
from vibroacoustics.mechanisms.reciprocating.cycle import (
    cylinder_pressure,
    optimum_bore,
    steady_cycle,
)
from vibroacoustics.mechanisms.reciprocating.slider_crank import (
    SliderCrank,
    design_at_bore,
    housing_wrenches,
    motion,
    moving_masses,
    top_dead_centre_m,
)
from vibroacoustics.study.loading import load_machine

MACHINE = load_machine(machine_file("mayekawa_wbhe"))
BORE_M = 0.13
OFFSET = changed(MACHINE, piston_and_rod={"crank_offset_m": 0.02})


def compression_work_j(displaced_m3, gas):
    """Indicated work of a revolution in closed form, ∮ V dp of two polytropes, J.

    W = n/(n-1) p_s V_i [(p_d/p_s)^((n-1)/n) - 1] with the volume V_i drawn in, which is the
    displaced one less the expansion of the clearance.
    """
    n, ratio = gas.polytropic_index, gas.discharge_pressure_pa / gas.suction_pressure_pa
    drawn_in = displaced_m3 * (1.0 + gas.clearance_ratio * (1.0 - ratio ** (1.0 / n)))
    return n / (n - 1.0) * gas.suction_pressure_pa * drawn_in * (ratio ** ((n - 1.0) / n) - 1.0)


def shaking_of(cycle):
    """On the housing in the cylinder's plane, about the shaft's axis, by source."""
    spin = -MACHINE.crankshaft.inertia_kg_m2 * cycle.rotation.acceleration_rad_per_s2
    shaft = planar(np.zeros((2, spin.size)), spin)
    return {**housing_wrenches(cycle.crank, cycle.kinematics, cycle.rotation), "crankshaft": shaft}


@pytest.fixture(scope="module", params=[MACHINE, OFFSET], ids=["in line", "offset"])
def cycle(request):
    return steady_cycle(request.param, BORE_M, 1000.0)


# --- laws ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("bore_m", [0.10, 0.13, 0.18])
@pytest.mark.parametrize(("slope", "offset_m"), [(1.0, 0.0), (0.0, 0.0), (-3.0, 0.0), (1.0, 0.02)])
def test_energy_balance(bore_m, slope, offset_m):
    """Motor against closed-form gas work and the joints' own sliding: to 1e-6 of the gas work."""
    machine = changed(
        MACHINE,
        crankshaft={"motor_slope_ratio": slope},
        piston_and_rod={"crank_offset_m": offset_m},
    )
    run = steady_cycle(machine, bore_m, 1000.0)
    pairs, moved, forces = machine.sliding_pairs, run.kinematics, run.forces
    rod = moved.rod_angle[1]
    losses = [
        pairs.wall_friction * np.abs(forces.piston_pin_n[1] * moved.piston_m[1]),
        pairs.bearing_friction
        * (
            pairs.piston_pin_radius_m * np.hypot(*forces.piston_pin_n) * np.abs(rod)
            + pairs.crank_pin_radius_m * np.hypot(*forces.crank_pin_n) * np.abs(1.0 + rod)
            + pairs.journal_radius_m * np.hypot(*forces.journal_n)
        ),
    ]
    crank = run.crank
    stroke = top_dead_centre_m(crank) - np.sqrt(
        (crank.rod_length_m - crank.crank_radius_m) ** 2 - offset_m**2
    )
    gas = compression_work_j(crank.piston_area_m2 * stroke, machine.gas)
    lost = 2.0 * np.pi * float(np.mean(np.sum(losses, axis=0)))
    assert run.supplied_work_j == pytest.approx(gas + lost, abs=1e-6 * gas)
    assert run.mechanical_efficiency == pytest.approx(gas / (gas + lost), abs=1e-6)


def test_virtual_work_equals_newton_and_euler(cycle):
    """The crank's own equation of motion closes with the joint force of the rod."""
    crank, (x, y) = cycle.crank, cycle.forces.crank_pin_n
    angle = cycle.kinematics.crank_angle
    rod_torque = crank.crank_radius_m * (np.cos(angle) * y - np.sin(angle) * x)
    friction = cycle.friction.crank_pin_n_m + cycle.friction.journal_n_m
    euler = cycle.rotation.motor_torque_n_m - friction + rod_torque
    inertia_torque = MACHINE.crankshaft.inertia_kg_m2 * cycle.rotation.acceleration_rad_per_s2
    # Friction is iterated to 1e-12 of the mean torque; twice that for the factor of the forces.
    np.testing.assert_allclose(euler, inertia_torque, atol=1e-10 * np.max(np.abs(rod_torque)))


def test_equation_1_with_modified_masses():
    """I_0' θ̈ - m_p' ẍ_p x_p tan φ + α cos θ/cos φ I_c' φ̈ with two masses in the rod's eyes."""
    cycle = steady_cycle(MACHINE, BORE_M, 1000.0)
    crank, moved, turn = cycle.crank, cycle.kinematics, cycle.rotation
    a, b, length = crank.small_end_to_centre_m, crank.big_end_to_centre_m, crank.rod_length_m
    mass = crank.rod_mass_kg
    speed, acceleration = turn.speed_rad_per_s, turn.acceleration_rad_per_s2
    x_tan = moved.piston_m[0] * np.tan(moved.rod_angle[0])
    second = moved.piston_m[2] * speed**2 + moved.piston_m[1] * acceleration
    rod = moved.rod_angle[2] * speed**2 + moved.rod_angle[1] * acceleration
    own = crank.rod_inertia_kg_m2 - mass * a * b
    big = MACHINE.crankshaft.inertia_kg_m2 + mass * a / length * crank.crank_radius_m**2
    left = big * acceleration - (crank.piston_mass_kg + mass * b / length) * second * x_tan
    left += moved.rod_angle[1] * own * rod
    loads = np.sum(list(cycle.load_torque_n_m.values()), axis=0)
    np.testing.assert_allclose(left, turn.motor_torque_n_m - loads, atol=1e-10 * np.ptp(loads))


def test_momentum_change_is_the_resultant_on_the_housing(cycle):
    """Bearings, wall, gas on the head, stator: all that touches the housing."""
    forces, friction, moved = cycle.forces, cycle.friction, cycle.kinematics
    touching = forces.journal_n - np.stack(
        [friction.wall_n + cycle.gas_force_n, forces.piston_pin_n[1]]
    )
    turning = friction.journal_n_m - cycle.rotation.motor_torque_n_m - friction.piston_pin_n_m
    turning = turning - moved.piston_m[0] * forces.piston_pin_n[1]
    turning = turning + cycle.crank.offset_m * (friction.wall_n + cycle.gas_force_n)
    shaking = shaking_of(cycle)
    scale = np.max(np.abs(touching))
    total = np.sum([own.force_n[:2] for own in shaking.values()], axis=0)
    np.testing.assert_allclose(total, touching, atol=1e-10 * scale)
    moment = np.sum([own.moment_n_m[2] for own in shaking.values()], axis=0)
    np.testing.assert_allclose(moment, turning, atol=1e-10 * scale)


def test_momentum_does_not_drift(cycle):
    """Force and roll moment have no mean over time: speed and place repeat each revolution."""
    shaking = shaking_of(cycle)
    slowness = 1.0 / cycle.rotation.speed_rad_per_s
    for values in (part for own in shaking.values() for part in own):
        mean = np.mean(values * slowness, axis=-1) / np.mean(slowness)
        # The trapezoidal rule with kinks and jumps of the load: (2π/3600)² of the peak.
        assert np.all(np.abs(mean) <= 3e-6 * np.max(np.abs(values), initial=1e-300))


def test_mean_speed_and_time(cycle):
    time = cycle.rotation.time_s
    assert time[0] == 0.0
    assert np.all(np.diff(time) > 0.0)
    assert time[-1] < cycle.rotation.duration_s == pytest.approx(0.06, rel=1e-12)  # 1000 rpm


@settings(max_examples=20, deadline=None)
@given(
    ratio=st.floats(0.01, 0.8),
    centre=st.floats(0.0, 1.0),
    inertia=st.floats(0.0, 1.0),
    offset=st.floats(-0.1, 0.1),
)
def test_motion_has_its_own_derivatives(ratio, centre, inertia, offset):
    """Against Fourier derivatives; φ as a series of sin φ converges as 0.9^n, 0.9^1024 = 1e-47."""
    crank = SliderCrank(0.1, ratio, 1.0, 1.0, 1.0, centre, 1.0 - centre, inertia, offset)
    moved = motion(crank, uniform_crank_angle(2048))
    for value in (moved.rod_angle, moved.piston_m, moved.rod_x_m, moved.rod_y_m):
        # Rounding of the path times orders squared, 1024² · 2.2e-16 = 2.3e-10, of lengths up to 2.
        np.testing.assert_allclose(derivative(value[0], 2), value[2], atol=1e-8)
        np.testing.assert_allclose(
            np.mean(value[1] ** 2), -np.mean((value[0] - value[0].mean()) * value[2]), atol=1e-9
        )
    _, slope = reduced_inertia(0.1, moving_masses(crank, moved))
    assert abs(np.mean(slope)) < 1e-9  # the inertia repeats


# --- second methods ------------------------------------------------------------------------------


def lagrange(run, angle: float, speed: float, motor_per_speed: float, inside: float):
    """Acceleration and joint forces by Lagrange multipliers in Cartesian coordinates.

    Coordinates: piston x, y; rod x, y and its angle; crank angle. Five constraints: the two eyes
    of the rod and the cylinder wall. Friction is iterated on the spot.
    """
    crank, pairs = run.crank, MACHINE.sliding_pairs
    r, a, b = crank.crank_radius_m, crank.small_end_to_centre_m, crank.big_end_to_centre_m
    turn = -np.arcsin((r * np.sin(angle) - crank.offset_m) / (a + b))
    s, c, sine, cosine = np.sin(turn), np.cos(turn), np.sin(angle), np.cos(angle)
    turning = -r * cosine * speed / ((a + b) * c)
    moving = -r * sine * speed + (a + b) * s * -turning
    J = np.array(
        [
            [1, 0, -1, 0, a * s, 0],
            [0, 1, 0, -1, -a * c, 0],
            [0, 0, -1, 0, -b * s, -r * sine],
            [0, 0, 0, -1, b * c, r * cosine],
            [0, 1, 0, 0, 0, 0],
        ]
    )
    drift = np.array([-a * c * turning**2, -a * s * turning**2,
                      b * c * turning**2 + 0, b * s * turning**2 + 0, 0.0])  # fmt: skip
    drift[2:4] += r * speed**2 * np.array([cosine, sine])
    masses = np.diag([crank.piston_mass_kg, crank.piston_mass_kg, crank.rod_mass_kg,
                      crank.rod_mass_kg, crank.rod_inertia_kg_m2,
                      MACHINE.crankshaft.inertia_kg_m2])  # fmt: skip
    system = np.block([[masses, J.T], [J, np.zeros((5, 5))]])
    gas = -crank.piston_area_m2 * (inside - MACHINE.gas.crankcase_pressure_pa)
    f = m_t = m_s = m_q = 0.0
    for _ in range(30):
        load = [gas + f, 0.0, 0.0, 0.0, m_t + m_s, motor_per_speed * speed - m_s - m_q]
        solved = np.linalg.solve(system, np.concatenate([load, drift]))
        pin, crank_pin, wall = solved[6:8], -solved[8:10], -solved[10]
        f = -np.sign(moving) * pairs.wall_friction * abs(wall)
        m_t = (
            -np.sign(turning) * pairs.bearing_friction * pairs.piston_pin_radius_m * np.hypot(*pin)
        )
        size = pairs.bearing_friction * np.hypot(*crank_pin)
        m_s, m_q = pairs.crank_pin_radius_m * size, pairs.journal_radius_m * size
    return solved[5], pin, crank_pin


def pressure_at(run, angle: float) -> float:
    crank = run.crank
    # Top dead centre and bottom dead centre scale the swept volume.
    top = np.arcsin(crank.offset_m / (crank.rod_length_m + crank.crank_radius_m))
    bottom = np.pi + np.arcsin(crank.offset_m / (crank.rod_length_m - crank.crank_radius_m))
    piston = motion(crank, np.array([top, bottom, angle])).piston_m
    swept = crank.piston_area_m2 * (piston[0, 0] - piston[0])
    return float(cylinder_pressure(swept, piston[1] < 0.0, MACHINE.gas)[2])


def test_lagrange_multipliers_give_the_same_forces(cycle):
    per_speed = cycle.rotation.motor_torque_n_m[0] / cycle.rotation.speed_rad_per_s[0]
    for index in range(37, 3600, 200):
        angle, speed = cycle.kinematics.crank_angle[index], cycle.rotation.speed_rad_per_s[index]
        acceleration, pin, crank_pin = lagrange(
            cycle, angle, speed, per_speed, cycle.pressure_pa[index]
        )
        expected = cycle.rotation.acceleration_rad_per_s2[index]
        # Rounding of an 11 x 11 system, condition about 1e3, and the friction's tolerance.
        assert acceleration == pytest.approx(expected, abs=1e-8 * 500.0)
        np.testing.assert_allclose(pin, cycle.forces.piston_pin_n[:, index], rtol=0, atol=1e-5)
        np.testing.assert_allclose(crank_pin, cycle.forces.crank_pin_n[:, index], rtol=0, atol=1e-5)


@pytest.mark.long
def test_integration_in_time_repeats_the_cycle(cycle):
    """Marching of the multipliers' equations through a revolution ends where it began."""
    speeds = cycle.rotation.speed_rad_per_s
    per_speed = cycle.rotation.motor_torque_n_m[0] / speeds[0]

    def slope(_, state):
        angle, speed = state
        inside = pressure_at(cycle, angle)
        return speed, lagrange(cycle, angle, speed, per_speed, inside)[0]

    marks = cycle.rotation.time_s[[900, 1800, 2700, 3300]]
    found = solve_ivp(
        slope,
        (0.0, 0.06),
        (0.0, speeds[0]),
        rtol=1e-7,
        atol=1e-7,
        t_eval=[*marks, 0.06],
        max_step=2.5e-4,
    )
    # Two errors: the steps across kinks of the gas pressure, and the trapezoidal rule, 2.5e-7.
    np.testing.assert_allclose(found.y[0, -1], 2.0 * np.pi, rtol=2e-6)
    expected = speeds[[900, 1800, 2700, 3300, 0]]
    np.testing.assert_allclose(found.y[1], expected, rtol=5e-6)


def test_wrench_of_moving_parts_at_constant_speed():
    """An endless flywheel: the general form for moving parts gives the same force and moment.

    With I_c = m a b the rod's spin cancels the moment of its centre of mass: nothing remains.
    """
    rod = MACHINE.piston_and_rod
    inertia = rod.rod_mass_kg * rod.small_end_to_centre_m * rod.big_end_to_centre_m
    machine = changed(
        MACHINE, crankshaft={"inertia_kg_m2": 1e9}, piston_and_rod={"rod_inertia_kg_m2": inertia}
    )
    run = steady_cycle(machine, BORE_M, 1000.0)
    force, moment = wrench(
        slider_crank_parts(run.crank, run.kinematics),
        constant_rotation(1000.0, run.kinematics.crank_angle.size),
    )
    shaking = housing_wrenches(run.crank, run.kinematics, run.rotation)
    # Fourier derivative: eps |r| times 1800² orders; the speed swings by W/(I Ω²) = 1e-11.
    total = np.sum([own.force_n[:2] for own in shaking.values()], axis=0)
    np.testing.assert_allclose(total, force[:2], atol=3e-9 * np.max(np.abs(force)))
    spin = inertia * np.max(np.abs(run.kinematics.rod_angle[2])) * (1000.0 / 30.0 * np.pi) ** 2
    turned = np.sum([own.moment_n_m[2] for own in shaking.values()], axis=0)
    assert np.max(np.abs(turned)) < 1e-9 * spin
    assert np.max(np.abs(moment)) < 1e-7 * spin


@pytest.mark.parametrize("clearance", [0.0, 0.005, 0.1])
@pytest.mark.parametrize("index", [1.05, 1.4])
def test_gas_work_in_closed_form(clearance, index):
    gas = changed(
        MACHINE, gas={"clearance_ratio": clearance, "polytropic_index": index}
    ).gas  # fmt: skip
    crank = design_at_bore(MACHINE.piston_and_rod, BORE_M)
    errors = []
    for samples in (3600, 14400):
        moved = motion(crank, uniform_crank_angle(samples))
        swept = crank.piston_area_m2 * (moved.piston_m[0, 0] - moved.piston_m[0])
        torque = cylinder_pressure(swept, moved.piston_m[1] < 0.0, gas) * moved.piston_m[1]
        work = 2.0 * np.pi * crank.piston_area_m2 * np.mean(torque)
        errors.append(abs(work / compression_work_j(crank.displacement_m3, gas) - 1.0))
    assert errors[0] < 1e-5
    assert errors[1] < 1e-6


# --- bad input -----------------------------------------------------------------------------------


@pytest.mark.parametrize("bore_m", [0.0, -0.1, float("nan"), float("inf")])
def test_bore_that_cannot_be(bore_m):
    with pytest.raises(ParameterError, match=r"bore_mm = .* must be above 0 mm"):
        steady_cycle(MACHINE, bore_m, 1000.0)


def test_mechanism_that_cannot_turn():
    with pytest.raises(ParameterError, match=r"crank_radius_mm = 300 mm and crank_offset"):
        motion(SliderCrank(0.1, 0.3, 0.3, 1.0, 1.0, 0.1, 0.2, 0.0, 0.0), uniform_crank_angle(8))


@pytest.mark.parametrize("speed_rpm", [0.0, -5.0, float("nan")])
def test_speed_that_cannot_be(speed_rpm):
    with pytest.raises(ParameterError, match="speed_rpm = "):
        steady_cycle(MACHINE, BORE_M, speed_rpm)


def test_flywheel_too_small_for_the_speed():
    with pytest.raises(ParameterError, match="speed_rpm = 100 rpm: the moving parts' inertia"):
        steady_cycle(MACHINE, BORE_M, 100.0)


def test_optimum_outside_the_range():
    with pytest.raises(ParameterError, match="bore_mm from 150 to 180 mm: holds no optimum"):
        optimum_bore(MACHINE, 1000.0, 0.15, 0.18)


@pytest.mark.parametrize("ends", [(0.18, 0.10), (0.0, 0.1), (0.1, float("nan"))])
def test_range_of_bores_that_cannot_be(ends):
    with pytest.raises(ParameterError, match="must be two rising, positive lengths"):
        optimum_bore(MACHINE, 1000.0, *ends)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("bore_mm = { value = 130.0", "bore_mm = { value = 0.0", "bore_mm = 0.0 mm: out of range"),
        ("crank_to_rod_ratio = { value = 0.17", "crank_to_rod_ratio = { value = 1.2",
         "crank_to_rod_ratio = 1.2"),
        ("clearance_ratio = { value = 0.005", "clearance_ratio = { value = -0.01",
         "clearance_ratio = -0.01"),
        ("value = 85.7", "value = 185.7", "small_end_to_centre_mm [+] big_end_to_centre_mm"),
        ("discharge_pressure_mpa = { value = 0.98", "discharge_pressure_mpa = { value = 0.05",
         "discharge_pressure_mpa = 0.05 MPa"),
    ],
)  # fmt: skip
def test_file_of_a_machine_that_cannot_be(tmp_path, old, new, message):
    text = machine_file("mayekawa_wbhe").read_text(encoding="utf-8")
    assert old in text
    file = tmp_path / "machine.toml"
    file.write_text(text.replace(old, new), encoding="utf-8")
    with pytest.raises(ParameterError, match=message):
        load_machine(file)
