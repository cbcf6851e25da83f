"""Large reciprocating compressor: published numbers (Tsuji et al. 2012), laws, second methods."""

import csv

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from machine_files import changed, load_machine, machine_file
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, minimize_scalar
from support import ROOT

from vibroacoustics.errors import ParameterError
from vibroacoustics.mechanisms.crankshaft import (
    reduced_inertia,
    uniform_crank_angle,
)
from vibroacoustics.mechanisms.reciprocating.cycle import efficiency_map, optimum_bore, steady_cycle
from vibroacoustics.mechanisms.reciprocating.gas import (
    compression_work_j,
    cylinder_pressure,
)
from vibroacoustics.mechanisms.reciprocating.slider_crank import (
    SliderCrank,
    design_at_bore,
    housing_wrench,
    motion,
    moving_masses,
    slider_crank_parts,
)
from vibroacoustics.moving_parts import second_derivative, wrench
from vibroacoustics.parameters.reciprocating import ReciprocatingMachine

MACHINE = load_machine(machine_file("mayekawa_wbhe"), ReciprocatingMachine)
BORE_M = 0.13
PRINTED_RADII = {"journal_radius_m": 0.092, "crank_pin_radius_m": 0.09, "piston_pin_radius_m": 0.04}
# The paper's own dynamics: 0.0857 mm taken at its word, and a rod of uniform thickness, m l²/12.
PRINTED_ROD = {
    "small_end_to_centre_m": 0.2999,
    "big_end_to_centre_m": 0.0857e-3,
    "rod_inertia_kg_m2": 3.864 * 0.3**2 / 12.0,
}


def published(quantity: str) -> dict[str, float]:
    """Values of a quantity by where they hold."""
    with (ROOT / "data" / "validation" / "tsuji.csv").open(encoding="utf-8") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        return {row["at"]: float(row["value"]) for row in rows if row["quantity"] == quantity}


@pytest.fixture(scope="module")
def cycle():
    return steady_cycle(MACHINE, BORE_M, 1000.0)


# --- published numbers ---------------------------------------------------------------------------


@pytest.mark.parametrize("speed_rpm", [800, 1000, 1200])
def test_best_efficiency_and_its_bore(speed_rpm):
    """Within 0.4 points and 2 mm (issue 5): radii, centre of mass and clearance are inferred."""
    bore_m, efficiency = optimum_bore(MACHINE, speed_rpm, 0.10, 0.18)
    assert 1e3 * bore_m == pytest.approx(published("optimum bore")[f"{speed_rpm} rpm"], abs=2.0)
    printed = published("mechanical efficiency")[f"{speed_rpm} rpm"]
    assert 100.0 * efficiency == pytest.approx(printed, abs=0.4)


@pytest.mark.parametrize(
    ("speed_rpm", "bore_mm", "percent"),
    [(800.0, 120.0, 86.63), (1000.0, 129.0, 84.63), (1200.0, 138.0, 82.71)],  # physics.md A4
)
def test_printed_radii_are_no_radii(speed_rpm, bore_mm, percent):
    """The page's own model, solved otherwise: to 0.1 points, and to 1 mm as it prints whole ones.

    At 1000 rpm to the digit of the issue, 84.6 %.
    """
    bore_m, efficiency = optimum_bore(
        changed(MACHINE, sliding_pairs=PRINTED_RADII), speed_rpm, 0.10, 0.18
    )
    assert 1e3 * bore_m == pytest.approx(bore_mm, abs=1.0)
    assert 100.0 * efficiency == pytest.approx(percent, abs=0.1)
    if speed_rpm == 1000.0:
        assert 100.0 * efficiency == pytest.approx(84.6, abs=0.05)


@pytest.mark.parametrize("bore_mm", [100, 130])
def test_speed_fluctuation_with_one_inertia(bore_mm):
    """Half a unit of the last digit, with the printed centre of mass taken at its word."""
    machine = changed(MACHINE, piston_and_rod=PRINTED_ROD)
    ratio = steady_cycle(machine, 1e-3 * bore_mm, 1000.0).rotation.fluctuation_ratio
    assert 100.0 * ratio == pytest.approx(published("speed fluctuation")[f"{bore_mm} mm"], abs=0.05)


def test_corrected_rod_does_not_give_both_speed_fluctuations():
    """The inertia that fits 130 mm misses 100 mm by 30 %: the reciprocating end is too heavy."""

    def percent(inertia, bore_mm):
        machine = changed(MACHINE, crankshaft={"inertia_kg_m2": inertia})
        return 100.0 * steady_cycle(machine, 1e-3 * bore_mm, 1000.0).rotation.fluctuation_ratio

    def misses(inertia, bore_mm):
        return percent(inertia, bore_mm) - published("speed fluctuation")[f"{bore_mm} mm"]

    fits = [brentq(misses, 0.1, 0.4, args=(bore,), xtol=1e-4) for bore in (100, 130)]
    assert fits == pytest.approx([0.211, 0.152], abs=5e-4)
    assert percent(fits[1], 100) == pytest.approx(10.7, abs=0.05)


def test_printed_rod_does_not_give_the_optimum_bore():
    """Taken at its word it moves the best bore by 9 mm; the efficiencies need the corrected one."""
    bore_m, _ = optimum_bore(changed(MACHINE, piston_and_rod=PRINTED_ROD), 1000.0, 0.10, 0.18)
    assert 1e3 * bore_m > published("optimum bore")["1000 rpm"] + 5.0


@pytest.mark.parametrize("bore_m", [0.13, 0.18])
def test_gas_torque_peaks_before_top_dead_centre(bore_m):
    """And with it, for large bores, deceleration and wall friction. The figure is read to 1°."""
    run = steady_cycle(MACHINE, bore_m, 1000.0)
    degrees = np.rad2deg(run.moved.crank_angle) - 360.0
    for peak in (
        np.argmax(run.load_torque_n_m["gas"]),
        np.argmin(run.rotation.acceleration_rad_per_s2),
        np.argmax(np.abs(run.friction.wall_n)),
    ):
        printed = published("crank angle of peak gas torque")["all"]
        assert degrees[peak] == pytest.approx(printed, abs=1.0)


def test_losses_over_bore():
    """3.2: with a smaller bore the piston pin loses less and the wall more.

    The paper has the least loss of the crank pin near 140 mm; ours is at 127 mm.
    """
    bores = 1e-3 * np.arange(100.0, 181.0, 10.0)
    works = [steady_cycle(MACHINE, bore, 1000.0).load_work_j for bore in bores]
    assert np.all(np.diff([work["piston_pin"] for work in works]) > 0.0)
    assert np.all(np.diff([work["cylinder_wall"] for work in works]) < 0.0)
    least = minimize_scalar(
        lambda bore: steady_cycle(MACHINE, float(bore), 1000.0).load_work_j["crank_pin"],
        bounds=(0.11, 0.15), method="bounded",
    ).x  # fmt: skip
    assert 1e3 * least == pytest.approx(127.0, abs=0.5)
    assert published("bore of least crank pin loss")["1000 rpm"] == 140.0


def test_efficiency_map():
    """One optimum a speed, at larger bores for higher speeds."""
    bores = 1e-3 * np.arange(100.0, 181.0, 10.0)
    efficiency = efficiency_map(MACHINE, [800.0, 1000.0, 1200.0], bores)
    assert efficiency.shape == (3, 9)
    assert bores[np.argmax(efficiency, axis=1)] == pytest.approx([0.12, 0.13, 0.14])
    assert np.all(np.diff(efficiency[:, :3], axis=0) < 0.0)


def test_piston_torque_is_a_misprint_by_ten():
    """physics.md A4: 71.2 N m at -38.6° for 100 mm, of the piston's mass alone."""
    crank = design_at_bore(MACHINE.piston_and_rod, 0.10)
    moved = motion(crank, np.deg2rad(np.arange(-1800, 1800) / 10.0))
    omega = 2.0 * np.pi * 1000.0 / 60.0
    torque = crank.piston_mass_kg * omega**2 * moved.piston_m[2] * moved.piston_m[1]
    peak = np.argmin(torque)
    assert torque[peak] == pytest.approx(-71.2, abs=0.05)
    assert np.rad2deg(moved.crank_angle[peak]) == pytest.approx(-38.6, abs=0.05)
    assert published("piston inertia torque")["100 mm"] == pytest.approx(
        0.1 * torque[peak], rel=0.1
    )


def test_reference_design():
    crank = design_at_bore(MACHINE.piston_and_rod, BORE_M)
    # The displacement is printed to 0.5 cm³ of 1327, 0.04 % of the stroke.
    assert 2e3 * crank.crank_radius_m == pytest.approx(published("stroke")["130 mm"], rel=4e-4)
    assert crank.piston_mass_kg == pytest.approx(2.65)
    assert crank.displacement_m3 == pytest.approx(1327e-6)


# --- laws ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("bore_m", [0.10, 0.13, 0.18])
@pytest.mark.parametrize("slope", [1.0, 0.0, -3.0])
def test_energy_balance(bore_m, slope):
    """Motor against closed-form gas work and the joints' own sliding: to 1e-6 of the gas work."""
    machine = changed(MACHINE, crankshaft={"motor_slope_ratio": slope})
    run = steady_cycle(machine, bore_m, 1000.0)
    pairs, moved, forces = machine.sliding_pairs, run.moved, run.forces
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
    gas = compression_work_j(run.crank.displacement_m3, machine.gas)
    lost = 2.0 * np.pi * float(np.mean(np.sum(losses, axis=0)))
    assert run.supplied_work_j == pytest.approx(gas + lost, abs=1e-6 * gas)
    assert run.mechanical_efficiency == pytest.approx(gas / (gas + lost), abs=1e-6)


def test_virtual_work_equals_newton_and_euler(cycle):
    """The crank's own equation of motion closes with the joint force of the rod."""
    crank, (x, y) = cycle.crank, cycle.forces.crank_pin_n
    angle = cycle.moved.crank_angle
    rod_torque = crank.crank_radius_m * (np.cos(angle) * y - np.sin(angle) * x)
    friction = cycle.friction.crank_pin_n_m + cycle.friction.journal_n_m
    euler = cycle.rotation.motor_torque_n_m - friction + rod_torque
    inertia_torque = MACHINE.crankshaft.inertia_kg_m2 * cycle.rotation.acceleration_rad_per_s2
    # Friction is iterated to 1e-12 of the mean torque; twice that for the factor of the forces.
    np.testing.assert_allclose(euler, inertia_torque, atol=1e-10 * np.max(np.abs(rod_torque)))


def test_equation_1_with_modified_masses(cycle):
    """I_0' θ̈ - m_p' ẍ_p x_p tan φ + α cos θ/cos φ I_c' φ̈ with two masses in the rod's eyes."""
    crank, moved, turn = cycle.crank, cycle.moved, cycle.rotation
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
    forces, friction, moved = cycle.forces, cycle.friction, cycle.moved
    touching = forces.journal_n - np.stack(
        [friction.wall_n + cycle.gas_force_n, forces.piston_pin_n[1]]
    )
    turning = friction.journal_n_m - cycle.rotation.motor_torque_n_m - friction.piston_pin_n_m
    turning = turning - moved.piston_m[0] * forces.piston_pin_n[1]
    shaking = housing_wrench(cycle.crank, moved, cycle.rotation, MACHINE.crankshaft.inertia_kg_m2)
    scale = np.max(np.abs(touching))
    total = np.sum(list(shaking.force_n.values()), axis=0)
    np.testing.assert_allclose(total, touching, atol=1e-10 * scale)
    moment = np.sum(list(shaking.roll_moment_n_m.values()), axis=0)
    np.testing.assert_allclose(moment, turning, atol=1e-10 * scale)


def test_momentum_does_not_drift(cycle):
    """Force and roll moment have no mean over time: speed and place repeat each revolution."""
    shaking = housing_wrench(
        cycle.crank, cycle.moved, cycle.rotation, MACHINE.crankshaft.inertia_kg_m2
    )
    slowness = 1.0 / cycle.rotation.speed_rad_per_s
    for values in (*shaking.force_n.values(), *shaking.roll_moment_n_m.values()):
        mean = np.mean(values * slowness, axis=-1) / np.mean(slowness)
        # The trapezoidal rule with kinks and jumps of the load: (2π/3600)² of the peak.
        assert np.all(np.abs(mean) <= 3e-6 * np.max(np.abs(values), initial=1e-300))


def test_mean_speed_and_time(cycle):
    time = cycle.rotation.time_s
    assert time[0] == 0.0
    assert np.all(np.diff(time) > 0.0)
    last = 0.5 * (1.0 / cycle.rotation.speed_rad_per_s[[0, -1]]).sum() * 2.0 * np.pi / time.size
    assert time[-1] + last == pytest.approx(0.06, rel=1e-12)  # 1000 rpm


@settings(max_examples=20, deadline=None)
@given(
    ratio=st.floats(0.01, 0.9), centre=st.floats(0.0, 1.0), inertia=st.floats(0.0, 1.0)
)  # fmt: skip
def test_motion_has_its_own_derivatives(ratio, centre, inertia):
    """Against Fourier derivatives; φ as a series of α sin θ converges as α^n, 0.9^1024 = 1e-47."""
    crank = SliderCrank(0.1, ratio, 1.0, 1.0, 1.0, centre, 1.0 - centre, inertia)
    moved = motion(crank, uniform_crank_angle(2048))
    for value in (moved.rod_angle, moved.piston_m, moved.rod_x_m, moved.rod_y_m):
        # Rounding of the path times orders squared, 1024² · 2.2e-16 = 2.3e-10, of lengths up to 2.
        np.testing.assert_allclose(second_derivative(value[0]), value[2], atol=1e-8)
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
    turn = -np.arcsin(r / (a + b) * np.sin(angle))
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
    angles = np.array([0.0, np.pi, angle])
    piston = motion(crank, angles).piston_m[0]
    swept = crank.piston_area_m2 * (piston[0] - piston)
    return float(cylinder_pressure(angles, swept, MACHINE.gas)[2])


def test_lagrange_multipliers_give_the_same_forces(cycle):
    per_speed = cycle.rotation.motor_torque_n_m[0] / cycle.rotation.speed_rad_per_s[0]
    for index in range(37, 3600, 200):
        angle, speed = cycle.moved.crank_angle[index], cycle.rotation.speed_rad_per_s[index]
        acceleration, pin, crank_pin = lagrange(
            cycle, angle, speed, per_speed, cycle.pressure_pa[index]
        )
        expected = cycle.rotation.acceleration_rad_per_s2[index]
        # Rounding of an 11 x 11 system, condition about 1e3, and the friction's tolerance.
        assert acceleration == pytest.approx(expected, abs=1e-8 * 500.0)
        np.testing.assert_allclose(pin, cycle.forces.piston_pin_n[:, index], rtol=0, atol=1e-5)
        np.testing.assert_allclose(crank_pin, cycle.forces.crank_pin_n[:, index], rtol=0, atol=1e-5)


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
        max_step=5e-4,
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
    force, moment = wrench(slider_crank_parts(run.crank, run.moved), 1000.0 / 60.0)
    shaking = housing_wrench(run.crank, run.moved, run.rotation, 0.0)
    # Fourier derivative: eps |r| times 1800² orders; the speed swings by W/(I Ω²) = 1e-11.
    total = np.sum(list(shaking.force_n.values()), axis=0)
    np.testing.assert_allclose(total, force[:2], atol=3e-9 * np.max(np.abs(force)))
    spin = inertia * np.max(np.abs(run.moved.rod_angle[2])) * (1000.0 / 30.0 * np.pi) ** 2
    turned = np.sum(list(shaking.roll_moment_n_m.values()), axis=0)
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
        torque = cylinder_pressure(moved.crank_angle, swept, gas) * moved.piston_m[1]
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
    with pytest.raises(ParameterError, match=r"crank_radius_mm = 300 mm: must be below rod_length"):
        motion(SliderCrank(0.1, 0.3, 0.3, 1.0, 1.0, 0.1, 0.2, 0.0), uniform_crank_angle(8))


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
    with pytest.raises(ParameterError, match=message) as refused:
        load_machine(file, ReciprocatingMachine)
    assert "\n" not in str(refused.value)
