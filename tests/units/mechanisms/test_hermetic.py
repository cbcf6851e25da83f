"""Hermetic reciprocating compressor of Estupiñan & Santos (2009): invariants, second methods.

What the paper prints is in test_literature.
"""

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from printed_films import printed_film_force
from scipy.integrate import solve_ivp
from support import PIPELINES, ROOT, steady

from vibroacoustics.balancers.lanchester import Lanchester
from vibroacoustics.balancers.rotating_counterweight import RotatingCounterweight
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.mechanics.capabilities import Slider
from vibroacoustics.mechanics.moving_parts import wrench
from vibroacoustics.mechanics.rotation import constant_rotation
from vibroacoustics.mechanisms.hermetic.cycle import (
    bearing_cycles,
    cycle_at_speed,
    mean_speed_rad_per_s,
    motion_of,
    steady_cycle,
    support_reaction,
    uniform_samples,
    works_per_cycle_j,
)
from vibroacoustics.mechanisms.hermetic.gas import (
    dead_centres,
    fill,
    gas_force_n,
    piston_area_m2,
    piston_position_m,
    valve_angles,
)
from vibroacoustics.mechanisms.hermetic.journal_bearing import film_coordinates, short_bearing_force
from vibroacoustics.mechanisms.hermetic.pin import crank_point, mechanism_motion, rod_motion
from vibroacoustics.mechanisms.hermetic.revolution import hermetic_revolution, housing_wrenches
from vibroacoustics.study.loading import load_machine, load_study

MACHINE_FILE = ROOT / "data" / "machines" / "estupinan_hermetic.toml"
GRAVITY = 9.80665
CASES = ("I", "II", "III")
STEPS = {"I": 360, "II": 360, "III": 180}


def in_case(machine, case):
    return machine.model_copy(update={"case": case})


@pytest.fixture(scope="module")
def machine():
    return load_machine(MACHINE_FILE)


@pytest.fixture(scope="module")
def cycles(machine):
    """Steady cycle of each case."""
    return {case: steady_cycle(in_case(machine, case), steps=STEPS[case]) for case in CASES}


# --- kinematics ----------------------------------------------------------------------------------

angles = st.floats(-1.0, 1.0)
five = st.tuples(*[angles] * 5).map(np.array)


@given(five, five, five)
def test_point_of_the_crank_moves_as_its_rotations_say(place, rates, second):
    """Position from the paper's transformation matrices; rates by a complex step along a path."""

    def at(time):
        x, y, beta, gamma, theta = place + rates * time + 0.5 * second * time**2
        tilt = np.array([[1, 0, 0], [0, np.cos(beta), np.sin(beta)],
                         [0, -np.sin(beta), np.cos(beta)]])  # fmt: skip
        turn = np.array([[np.cos(gamma), 0, -np.sin(gamma)], [0, 1, 0],
                         [np.sin(gamma), 0, np.cos(gamma)]])  # fmt: skip
        spin = np.array([[np.cos(theta), np.sin(theta), 0], [-np.sin(theta), np.cos(theta), 0],
                         [0, 0, 1]])  # fmt: skip
        return np.array([x, y, 0.0]) + tilt.T @ turn.T @ spin.T @ np.array([0.75, 0.0, -0.6])

    point = crank_point(place, rates, 0.75, 0.6)
    assert point.position_m == pytest.approx(at(0.0), abs=1e-14)
    assert point.velocity(rates) == pytest.approx(at(1e-30j).imag / 1e-30, abs=1e-13)
    step = 1e-4
    difference = (at(step) - 2.0 * at(0.0) + at(-step)) / step**2
    # Second differences: step² times a fourth derivative of a few hundred, and rounding of 1e-8.
    assert point.acceleration(second) == pytest.approx(difference, abs=2e-5)


@given(st.floats(0.0, 6.28), st.floats(100.0, 400.0), st.floats(-2e3, 2e3))
def test_piston_and_rod_by_differentiating_the_closed_form(angle, speed, acceleration):
    """Shows that (7) needs -r_c (θ̈ sin θ + θ̇² cos θ); the paper prints - θ̇² cos θ."""
    radius, length = 0.0075, 0.04
    place, rates, second = np.zeros((3, 5))
    place[4], rates[4], second[4] = angle, speed, acceleration
    pin = crank_point(place, rates, radius, 0.01)
    motion = rod_motion(length, pin.position_m, pin.velocity(rates), pin.acceleration(second))
    sine, cosine = np.sin(angle), np.cos(angle)
    swing = np.sqrt(length**2 - (radius * sine) ** 2)
    slope = -radius * sine - radius**2 * sine * cosine / swing
    bend = -radius * cosine - radius**2 * (cosine**2 - sine**2) / swing
    bend -= radius**4 * sine**2 * cosine**2 / swing**3
    assert motion.piston_position_m == pytest.approx(radius * cosine + swing, rel=1e-14)
    assert motion.piston_velocity == pytest.approx(slope * speed, abs=1e-12 * speed)
    expected = slope * acceleration + bend * speed**2
    assert motion.piston_acceleration == pytest.approx(expected, abs=1e-12 * speed**2)


# --- forces: invariants and second methods -------------------------------------------------------


def _appendix_a(machine, angle, speed, gas):
    """Case I by appendix A, its last row and missing h_p moments corrected: 16 unknowns."""
    rod, crank, piston = machine.rod, machine.crank, machine.piston
    length, radius, distance = rod.length_m, crank.radius_m, rod.centre_of_mass_m
    sa = radius * np.sin(angle) / length
    ca = np.sqrt(1.0 - sa**2)
    rate = radius * speed * np.cos(angle) / (length * ca)
    s, c = np.sin(angle), np.cos(angle)
    names = "Bx By Bz Ny Nz Ax Ay Az Cx Cy Cz Mx My theta xB alpha".split()  # noqa: SIM905
    rows = [
        ({"Bx": 1, "xB": piston.mass_kg}, -gas),
        ({"By": -1, "Ny": 1}, 0.0),
        ({"Bz": 1, "Nz": -1}, -piston.mass_kg * GRAVITY),
        ({"Bx": 1, "Ax": -1, "xB": -rod.mass_kg, "alpha": -rod.mass_kg * distance * sa},
         rod.mass_kg * rate**2 * distance * ca),
        ({"By": 1, "Ay": -1, "alpha": -rod.mass_kg * distance * ca},
         -rod.mass_kg * rate**2 * distance * sa),
        ({"Bz": 1, "Az": 1}, rod.mass_kg * GRAVITY),
        ({"Ax": 1, "Cx": -1}, 0.0),
        ({"Ay": 1, "Cy": -1}, 0.0),
        ({"Az": -1, "Cz": 1}, crank.mass_kg * GRAVITY),
        ({"Az": length}, distance * rod.mass_kg * GRAVITY),
        ({"Ax": length * sa, "Ay": length * ca, "xB": rod.mass_kg * distance * sa,
          "alpha": rod.piston_pin_inertia_kg_m2}, 0.0),
        ({"Mx": c, "My": s, "Ax": -s * crank.pin_offset_m, "Ay": c * crank.pin_offset_m}, 0.0),
        ({"Mx": -s, "My": c, "Ax": -c * crank.pin_offset_m, "Ay": -s * crank.pin_offset_m,
          "Az": radius}, 0.0),
        ({"Ax": radius * s, "Ay": -radius * c, "theta": _axial_inertia(machine)},
         machine.motor.torque_slope_n_m_s * (machine.motor.synchronous_speed_rad_per_s - speed)),
        ({"theta": radius * s, "xB": 1, "alpha": length * sa},
         -radius * speed**2 * c - length * rate**2 * ca),
        ({"theta": -radius * c, "alpha": length * ca},
         -radius * speed**2 * s + length * rate**2 * sa),
    ]  # fmt: skip
    matrix, right = np.zeros((16, 16)), np.zeros(16)
    for number, (row, value) in enumerate(rows):
        for name, factor in row.items():
            matrix[number, names.index(name)] = factor
        right[number] = value
    return dict(zip(names, np.linalg.solve(matrix, right), strict=True))


def _axial_inertia(machine):
    """About the shaft axis; the crank's eccentric mass adds by the parallel axis theorem."""
    crank = machine.crank
    own = crank.axial_inertia_kg_m2 + machine.rotor.axial_inertia_kg_m2
    return own + crank.mass_kg * crank.mass_eccentricity_m**2


@pytest.mark.parametrize("at", [10, 100, 250, 320])
def test_case_1_by_the_papers_matrix_of_constraint_forces(machine, cycles, at):
    equations, solution = cycles["I"]
    angle, state = solution.mesh[at : at + 1], solution.states[at : at + 1]
    gas = float(gas_force_n(machine, angle)[0])
    expected = _appendix_a(machine, angle[0], state[0, -1], gas)
    motion = motion_of(equations, angle, state)
    joints, rod = motion.joints, motion.rod
    found = {
        "theta": equations.accelerations(angle, state)[0, -1],
        "xB": rod.piston_acceleration[0],
        "alpha": rod.angular_acceleration[0],
        "Ax": joints.rod_on_crank[0, 0],
        "Ay": joints.rod_on_crank[0, 1],
        "Az": -joints.rod_on_crank[0, 2],
        "Bx": joints.piston_on_rod[0, 0],
        "By": joints.piston_on_rod[0, 1],
        "Ny": joints.wall_on_piston[0, 1],
        "Nz": joints.wall_on_piston[0, 2],
    }
    for name, value in found.items():
        assert value == pytest.approx(expected[name], rel=1e-10, abs=1e-9), name
    # The paper leaves the crank's unbalance out of the support.
    unbalance = -machine.crank.mass_kg * motion.mass_centre_acceleration[0]
    reaction = support_reaction(equations, angle, state)[0]
    assert -reaction[:2] - unbalance[:2] == pytest.approx([expected["Cx"], expected["Cy"]])
    # Rows 12 and 13 hold the moments about X and Y, turned to the axes of the crank.
    weight = machine.crank.mass_kg * GRAVITY * motion.mass_centre.position_m[0]
    assert reaction[2] - weight[1] == pytest.approx(expected["Mx"], rel=1e-9)
    assert reaction[3] + weight[0] == pytest.approx(expected["My"], rel=1e-9)


@given(five, five, five, st.floats(0.0, 300.0))
def test_forces_by_lagrange_multipliers(machine, place, rates, second, gas):
    """Rod and piston with coordinates x_B and α; the two closures' multipliers are f_A."""
    scale = np.array([1e-5, 1e-5, 0.02, 0.02, 3.0])
    place, rates, second = place * scale, 300.0 * rates * scale, 9e4 * second * scale
    motion = mechanism_motion(machine, place, rates, second, np.array(gas))
    rod, piston, length = machine.rod, machine.piston, machine.rod.length_m
    pin = motion.pin
    sa = pin.position_m[1] / length
    ca = np.sqrt(1.0 - sa**2)
    closure = np.array([[1.0, length * sa], [0.0, length * ca]])  # of (x_B, α) against the pin
    velocity = np.linalg.solve(closure, pin.velocity(rates)[:2])
    curve = velocity[1] ** 2 * length * np.array([ca, -sa])
    moment = rod.mass_kg * rod.centre_of_mass_m
    mass = np.array([[piston.mass_kg + rod.mass_kg, moment * sa],
                     [moment * sa, rod.piston_pin_inertia_kg_m2]])  # fmt: skip
    centrifugal = np.array([moment * velocity[1] ** 2 * ca, 0.0])
    applied = np.array([-gas, 0.0])
    matrix = np.block([[mass, closure.T], [closure, np.zeros((2, 2))]])
    right = np.concatenate((applied - centrifugal, pin.acceleration(second)[:2] - curve))
    solved = np.linalg.solve(matrix, right)
    size = 1.0 + np.max(np.abs(solved[2:]))
    assert motion.joints.rod_on_crank[:2] == pytest.approx(solved[2:], abs=1e-9 * size)
    assert motion.rod.piston_acceleration == pytest.approx(solved[0], rel=1e-9, abs=1e-6)


@pytest.mark.parametrize("case", CASES)
def test_energy_balance_closes(cycles, case):
    works = works_per_cycle_j(*cycles[case])
    assert works["gas"] < 0.0 < works["motor"]
    assert works["films"] <= 0.0  # oil takes energy
    assert abs(sum(works.values())) < 1e-6 * abs(works["gas"])  # what is left over


@pytest.mark.parametrize("case", CASES)
def test_momentum_change_is_the_resultant_on_the_housing(machine, cycles, case):
    """Gas on the cylinder head, piston on the wall, journals on their bearings."""
    equations, solution = cycles[case]
    angle, states = solution.mesh, solution.states
    momentum = sum(w.force_n for w in housing_wrenches(equations, angle, states).values())
    wall = motion_of(equations, angle, states).joints.wall_on_piston
    head = np.stack((gas_force_n(machine, angle), -wall[..., 1]), axis=-1)
    held = support_reaction(equations, angle, states)[..., :2]
    resultant = head - held - equations.film_forces(states).sum(axis=-2)
    size = np.max(np.abs(momentum))
    assert momentum[:2] == pytest.approx(resultant.T, abs=1e-10 * size)


def test_roll_moment_is_that_of_motor_wall_and_head(machine, cycles):
    """Case I about the shaft: motor's reaction and the wall's force, with no other about z."""
    equations, solution = cycles["I"]
    angle, states = solution.mesh, solution.states
    moment = sum(w.moment_n_m for w in housing_wrenches(equations, angle, states).values())
    motion = motion_of(equations, angle, states)
    wall = -motion.joints.wall_on_piston[..., 1] * motion.rod.piston_position_m
    expected = wall - equations.motor_torque(states[..., -1])
    assert moment[2] == pytest.approx(expected, abs=1e-10 * np.max(np.abs(expected)))


def test_tilting_moment_is_that_of_films_wall_and_head(machine, cycles):
    """Case III about X and Y, weights taken off. The pin's height changes by its tilt, 3 µm of the
    10 mm that the rod's plane is off, which the wrench leaves out."""
    equations, solution = cycles["III"]
    angle, states = solution.mesh, solution.states
    moment = sum(w.moment_n_m for w in housing_wrenches(equations, angle, states).values())
    motion, films = motion_of(equations, angle, states), equations.film_forces(states)
    wall = -motion.joints.wall_on_piston[..., 1]
    head, offset = gas_force_n(machine, angle), machine.crank.pin_offset_m
    weight = -machine.crank.mass_kg * GRAVITY
    share = motion.joints.rod_on_crank[..., 2]
    centre, pin = motion.mass_centre.position_m, motion.pin.position_m
    lower = machine.shaft.bearing_distance_m
    about_x = offset * wall + lower * films[..., 1, 1]
    about_x = about_x - weight * centre[..., 1] - share * pin[..., 1]
    about_y = -offset * head - lower * films[..., 1, 0]
    about_y = about_y + weight * centre[..., 0] + share * pin[..., 0]
    size = np.max(np.abs(moment[:2]))
    assert size > 1.0
    expected = np.stack((about_x, about_y))
    assert moment[:2] == pytest.approx(expected, abs=3e-4 * size)


@pytest.mark.parametrize("case", CASES)
def test_virtual_work_equals_the_newton_euler_torque(machine, cycles, case):
    """Power of the joint force on the pin = gas power less change of rod's and piston's energy."""
    equations, solution = cycles[case]
    angle, states = solution.stage_angles, solution.stages
    motion, speed = motion_of(equations, angle, states), states[..., -1]
    _, rates = equations.crank_coordinates(angle, states)
    rod, body = motion.rod, machine.rod
    pin_power = np.sum((motion.joints.rod_on_crank * motion.pin.velocity(rates))[..., :2], axis=-1)
    along, across = rod.centre_acceleration(body)
    distance = body.centre_of_mass_m
    velocity = (rod.piston_velocity + distance * rod.sine * rod.angular_velocity,
                distance * rod.cosine * rod.angular_velocity)  # fmt: skip
    kinetic = machine.piston.mass_kg * rod.piston_velocity * rod.piston_acceleration
    kinetic = kinetic + body.mass_kg * (velocity[0] * along + velocity[1] * across)
    kinetic = kinetic + body.inertia_kg_m2 * rod.angular_velocity * rod.angular_acceleration
    gas_power = -gas_force_n(machine, angle) * rod.piston_velocity
    size = np.max(np.abs(gas_power))
    assert pin_power == pytest.approx(gas_power - kinetic, abs=1e-12 * size)
    assert speed.min() > 0.0


@pytest.mark.parametrize("case", ["II", "III"])
def test_film_stays_and_the_cycle_is_stable(machine, cycles, case):
    equations, solution = cycles[case]
    assert solution.largest_multiplier < 1.0
    for bearing in bearing_cycles(equations, solution.states):
        assert np.all(bearing.thinnest_film_m > 0.0)
        assert np.all(bearing.highest_pressure_pa >= 0.0)
        assert bearing.force_n.shape == bearing.orbit_m.shape


@pytest.mark.parametrize("case", CASES)
def test_tangent_meets_differences(cycles, case):
    equations, solution = cycles[case]
    angle, state = solution.mesh[40:42], solution.states[40:42]
    _, tangent = equations.slopes_and_tangents(angle, state)
    freedoms = equations.shaft.dof_count
    steps = np.concatenate((np.full(freedoms, 1e-10), np.full(freedoms, 1e-6), [1e-2]))
    for column, step in enumerate(steps):
        move = step * np.eye(state.shape[-1])[column]
        slope = equations.slopes(angle, state + move) - equations.slopes(angle, state - move)
        size = np.max(np.abs(tangent[..., column]), axis=-1, keepdims=True)
        # Differences: (1e-10 m / 1.4 µm of film)² and rounding of stiff forces over the step.
        assert np.all(np.abs(slope / (2.0 * step) - tangent[..., column]) < 1e-4 * size), column


@pytest.mark.long
def test_case_2_by_time_integration(machine, cycles):
    """SciPy's LSODA follows the cycle through compression, thinnest film and discharge."""
    equations, solution = cycles["II"]

    def slope(angle, state):
        return equations.slopes(np.array([angle]), state[np.newaxis])[0]

    _, discharge = valve_angles(machine)
    first, kink, last = np.searchsorted(solution.mesh, [np.deg2rad(270.0), discharge, 6.0])
    state = solution.states[first]
    for begin, end in ((first, kink), (kink, last)):
        span = solution.mesh[begin], solution.mesh[end]
        absolute = [1e-13, 1e-13, 1e-10, 1e-10, 1e-7]
        state = solve_ivp(slope, span, state, method="LSODA", rtol=1e-8, atol=absolute).y[:, -1]
    # Both err by some 1e-7 of the clearance.
    assert state[:2] == pytest.approx(solution.states[last, :2], abs=1e-6 * 15e-6)
    assert state[-1] == pytest.approx(solution.states[last, -1], rel=1e-7)


def test_cycle_converges_at_the_order_of_the_collocation(machine, cycles):
    """Order 5 of Radau IIA, lowered a little where the journal crosses the middle of the bearing.

    Measured against 720 steps: 2.9e-4, 1.3e-5 and 4.5e-7 of the clearance for 90, 180 and 360.
    """
    fine = cycles["II"][1]
    errors = []
    for steps in (90, 180):
        coarse = steady_cycle(in_case(machine, "II"), steps=steps)[1]
        common = np.argmin(np.abs(fine.mesh[:, None] - coarse.mesh), axis=0)
        errors.append(np.max(np.abs(fine.states[common, :2] - coarse.states[:, :2])))
    assert errors[1] < 2e-5 * machine.bearing.clearance_m
    assert np.log2(errors[0] / errors[1]) > 4.0


def test_uniform_samples_leave_the_valves_out(machine, cycles):
    angle, states = uniform_samples(cycles["II"][1])
    assert angle == pytest.approx(np.arange(360) * np.pi / 180.0, abs=1e-14)
    assert states.shape == (360, 5)
    assert len(cycles["II"][1].mesh) == 363  # two valves and the end
    with pytest.raises(ParameterError, match="steps = 100"):
        uniform_samples(cycles["II"][1], 100)


# --- what the films' law does --------------------------------------------------------------------


def test_printed_film_law_is_unstable_with_a_rotating_load(machine, cycles):
    """A load that turns with the shaft makes u = Ω - 2 dϕ/dt negative over most of the cycle. The
    printed (26), (27) then pull: the cycle exists, but deviations grow 10 000-fold a revolution.
    Without the unbalance that eq. 16 of the paper leaves out, the printed law is stable."""
    law = printed_film_force(short_bearing_force)
    _, with_unbalance = steady_cycle(in_case(machine, "II"), law, steps=180)
    crank = machine.crank.model_copy(update={"mass_eccentricity_m": 0.0})
    balanced = machine.model_copy(update={"crank": crank})
    _, without = steady_cycle(in_case(balanced, "II"), law, steps=180)
    assert cycles["II"][1].largest_multiplier < 1.0
    assert with_unbalance.largest_multiplier > 1e4
    assert without.largest_multiplier < 1.0


# --- cylinder beside the shaft -------------------------------------------------------------------


@pytest.fixture(scope="module")
def offset_machine(machine):
    piston = machine.piston.model_copy(update={"cylinder_offset_m": -2e-3})
    return in_case(machine, "I").model_copy(update={"piston": piston})


@pytest.fixture(scope="module")
def offset_cycle(offset_machine):
    return steady_cycle(offset_machine)


def test_dead_centres_of_an_offset_cylinder(offset_machine):
    """Farthest and nearest place of the piston, found by a search."""
    angle = np.linspace(0.0, 2.0 * np.pi, 200_001)
    place = piston_position_m(offset_machine, angle)
    top, bottom = dead_centres(offset_machine)
    found = np.array([angle[np.argmax(place)] - 2.0 * np.pi, angle[np.argmin(place)]])
    assert [top, bottom] == pytest.approx(found, abs=2.0 * np.pi / 200_000)
    assert fill(offset_machine, np.array([top, bottom])) == pytest.approx(
        offset_machine.gas.clearance_ratio + np.array([0.0, 1.0]), abs=1e-14
    )


def test_offset_cylinder_keeps_its_balances(offset_machine, offset_cycle):
    """Energy, and the roll moment with the head's force beside the shaft."""
    works = works_per_cycle_j(*offset_cycle)
    assert abs(sum(works.values())) < 1e-6 * abs(works["gas"])  # what is left over
    equations, solution = offset_cycle
    angle, states = solution.mesh, solution.states
    moment = sum(w.moment_n_m for w in housing_wrenches(equations, angle, states).values())
    motion = motion_of(equations, angle, states)
    wall = -motion.joints.wall_on_piston[..., 1] * motion.rod.piston_position_m
    head = -offset_machine.piston.cylinder_offset_m * gas_force_n(offset_machine, angle)
    expected = wall + head - equations.motor_torque(states[..., -1])
    assert moment[2] == pytest.approx(expected, abs=1e-10 * np.max(np.abs(expected)))


def test_offset_towards_the_compressing_pin_takes_load_off_the_wall(cycles, offset_cycle):
    straight, beside = (
        np.max(np.abs(motion_of(own[0], own[1].mesh, own[1].states).joints.wall_on_piston[..., 1]))
        for own in (cycles["I"], offset_cycle)
    )
    assert beside < 0.75 * straight  # 20 and 31 N


# --- in the chain --------------------------------------------------------------------------------


@pytest.mark.parametrize("case", ["I", "II"])
def test_cycle_at_a_mean_speed(machine, case):
    equations, solution = cycle_at_speed(in_case(machine, case), 3576.0, steps=144)
    assert 30.0 / np.pi * mean_speed_rad_per_s(solution) == pytest.approx(3576.0, rel=1e-6)
    supply = equations.machine.motor.synchronous_speed_rad_per_s
    assert supply > mean_speed_rad_per_s(solution)
    assert abs(sum(works_per_cycle_j(equations, solution).values())) < 1e-6


def test_first_order_at_constant_speed_in_closed_form(machine):
    """The mean square of the speed is Ω² but for its ripple, W/(J Ω²) of 1e-6 with 10 kg m².

    Only cos θ of x_B and of the rod's place is odd in order, and sin θ of its y:
    F_x = Ω² [(m_p + m_r) r + m_c e_c], F_y = Ω² (m_r d r/l + m_c e_c) against y, as the shaft
    points down; the moment is that of these forces at the heights of pin and crank.
    """
    rotor = machine.rotor.model_copy(update={"axial_inertia_kg_m2": 10.0})
    motion = hermetic_revolution(
        in_case(machine, "I").model_copy(update={"rotor": rotor}), 2980.0, 256
    )
    force, moment = (
        np.fft.rfft(sum(own[place] for own in motion.wrenches.values()))[:, 1] / 128.0
        for place in (0, 1)
    )
    rod, crank, squared = machine.rod, machine.crank, (2980.0 * np.pi / 30.0) ** 2
    along = squared * (machine.piston.mass_kg + rod.mass_kg) * crank.radius_m
    swing = rod.centre_of_mass_m / rod.length_m
    across = squared * rod.mass_kg * swing * crank.radius_m
    turning = squared * crank.mass_kg * crank.mass_eccentricity_m
    expected = np.array([along + turning, 1j * (across + turning), 0.0])
    assert force == pytest.approx(expected, rel=1e-5, abs=1e-5)
    height, pin = machine.crank_height_m, machine.crank_height_m + crank.pin_offset_m
    tilt = np.array([-1j * (across * pin + turning * height), along * pin + turning * height])
    assert moment[:2] == pytest.approx(tilt, rel=1e-5)
    assert motion.figures["speed_fluctuation_percent"] < 1e-3


def test_oscillation_is_what_first_order_balancers_take(machine):
    """A full Lanchester balancer leaves of the first order what turns: rod's big end and crank."""
    slider = machine.require(Slider)
    rod = machine.rod
    small_end = rod.mass_kg * (1.0 - rod.centre_of_mass_m / rod.length_m)
    assert slider.mass_kg == pytest.approx(machine.piston.mass_kg + small_end)
    option = Lanchester(share_ratio=1.0, radius_m=0.015)
    turning = constant_rotation(2980.0, 256)
    parts = option.added(machine, steady(2980.0)).parts
    own = wrench(parts, turning)
    force, moment = (np.fft.rfft(value)[:, 1] / 128.0 for value in own)
    expected = -slider.mass_kg * machine.crank.radius_m * (2980.0 * np.pi / 30.0) ** 2
    assert force == pytest.approx(np.array([expected, 0.0, 0.0]), abs=1e-9 * abs(expected))
    plane = machine.crank_height_m + machine.crank.pin_offset_m
    assert moment[1] == pytest.approx(expected * plane, rel=1e-9)


def test_counterweight_planes_lie_where_the_file_says(machine):
    """The shaft points down in the mechanism's frame; heights in the file are upwards."""
    option = RotatingCounterweight(share_ratio=1.0)
    parts = option.added(machine, steady(2980.0)).parts
    upper, lower = sorted((part.position_m[2, 0] for part in parts), reverse=True)
    planes = machine.counterweights
    assert upper == pytest.approx(machine.crank_height_m + planes.upper_height_m)
    assert lower == pytest.approx(machine.crank_height_m + planes.lower_height_m)


def test_facts_are_those_of_the_cycle(machine, cycles):
    """At 2980 rpm; the fixture's cycle runs at 50 Hz supply, 0.9 rpm slower."""
    facts = hermetic_revolution(in_case(machine, "II"), 2980.0, 360).figures
    equations, solution = cycles["II"]
    (bearing,) = bearing_cycles(equations, solution.states)
    assert facts["upper_bearing_thinnest_film_um"] == pytest.approx(
        1e6 * bearing.thinnest_film_m.min(), rel=2e-3
    )
    assert facts["upper_bearing_highest_pressure_mpa"] == pytest.approx(
        1e-6 * bearing.highest_pressure_pa.max(), rel=2e-3
    )
    assert facts["supply_frequency_hz"] == pytest.approx(50.0, abs=0.05)
    held = hermetic_revolution(in_case(machine, "I"), 2980.0, 180).figures
    # The journal's own acceleration is small beside the load that it carries.
    assert facts["upper_bearing_largest_load_n"] == pytest.approx(
        held["upper_bearing_largest_load_n"], rel=0.02
    )


def test_fewer_angles_than_the_cycle_needs(machine):
    """64 angles are every third of the cycle's 192."""
    coarse = hermetic_revolution(in_case(machine, "I"), 2980.0, 64)
    fine = hermetic_revolution(in_case(machine, "I"), 2980.0, 192)
    for name, own in fine.wrenches.items():
        assert coarse.wrenches[name].force_n == pytest.approx(own.force_n[:, ::3], abs=1e-9)
        assert coarse.wrenches[name].moment_n_m == pytest.approx(own.moment_n_m[:, ::3], abs=1e-9)


def test_study_of_the_machine_loads():
    study = load_study(PIPELINES / "estupinan_hermetic.toml")
    assert study.machine.kind == "hermetic-reciprocating"
    offset = study.options["cylinder-offset"].machine.piston.cylinder_offset_m
    assert offset == pytest.approx(-2e-3)
    # 67 g opposite the pin: turning mass and half of the piston's are balanced to 5 %.
    crank = study.options["crank-counterweight"].machine.crank
    slider, rod = study.machine.require(Slider), study.machine.rod
    turning = rod.mass_kg * rod.centre_of_mass_m / rod.length_m
    wanted = -(turning + 0.5 * slider.mass_kg) * crank.radius_m
    assert crank.mass_kg * crank.mass_eccentricity_m == pytest.approx(wanted, rel=0.05)


# --- bad input -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("length_mm = { value = 40.0", "length_mm = { value = 7.0", "rod.length_mm = 7 mm: must"),
        ("cylinder_offset_mm = { value = 0.0", "cylinder_offset_mm = { value = -33.0",
         "the size of piston.cylinder_offset_mm, 40.5 mm together"),
        ("clearance_um = { value = 15.0", "clearance_um = { value = -1.0",
         "bearing.clearance_um = -1.0 µm: out of range; allowed above 0"),
        ("clearance_um = { value = 15.0", "clearance_um = { value = 0.0",
         "bearing.clearance_um = 0.0 µm: out of range; allowed above 0"),
        ("\ndiameter_mm = { value = 23.0", "\ndiameter_mm = { value = 0.0",
         "piston.diameter_mm = 0.0 mm: out of range; allowed above 0"),
        ("discharge_pressure_bar = { value = 8.0", "discharge_pressure_bar = { value = 6.0",
         "discharge_pressure_bar = 6 bar: must exceed suction_pressure_bar = 6.5 bar"),
        ("discharge_pressure_bar = { value = 8.0", "discharge_pressure_bar = { value = 100.0",
         "discharge_pressure_bar = 100 bar: must be less than 86.9011 bar"),
        ("axial_inertia_kg_m2 = { value = 1.0e-3", "axial_inertia_kg_m2 = { value = 1.3e-3",
         "axial_inertia_kg_m2: must not exceed the sum of the two"),
        ('case = "III"', 'case = "IV"', "case = 'IV': must be 'I', 'II' or 'III'"),
    ],
)  # fmt: skip
def test_file_of_a_machine_that_cannot_be(tmp_path, old, new, message):
    text = MACHINE_FILE.read_text(encoding="utf-8")
    assert old in text
    text = text.replace(old, new)
    if "= 6 bar" in message:
        text = text.replace(
            "suction_pressure_bar = { value = 1.15", "suction_pressure_bar = { value = 6.5"
        )
    file = tmp_path / "machine.toml"
    file.write_text(
        re.sub(r", range = \[[^]]*\]", ", range = [-1e12, 1e12]", text), encoding="utf-8"
    )
    with pytest.raises(ParameterError, match=re.escape(message)) as refused:
        load_machine(file)
    assert "\n" not in str(refused.value)


def test_journal_beyond_its_clearance_is_refused(machine):
    """An eccentricity beyond one: the film's laws do not hold there."""
    touching = np.array([machine.bearing.clearance_m, 0.0])
    with pytest.raises(ParameterError, match="eccentricity ratio = 1: must be less than 1"):
        film_coordinates(machine.bearing, touching, np.zeros(2), np.array(312.0))


def test_pin_beyond_the_rods_reach_is_refused():
    pin = np.array([[0.0, 0.05, 0.0]])
    with pytest.raises(ParameterError, match=r"rod\.length_m = 0\.04 m: must exceed"):
        rod_motion(0.04, pin, np.zeros((1, 3)), np.zeros((1, 3)))


def test_gas_force_turns_at_the_valves(machine):
    """Discharge pressure at top dead centre, suction pressure at bottom, continuous between."""
    suction, discharge = valve_angles(machine)
    angle = np.array([0.0, suction, np.pi, discharge, 2.0 * np.pi - 1e-9])
    full = (8.0e5 - 1.15e5) * piston_area_m2(machine)
    assert gas_force_n(machine, angle) == pytest.approx([full, 0.0, 0.0, full, full], abs=1e-9)
    assert gas_force_n(machine, angle[[1, 3]] - 1e-9) == pytest.approx([0.0, full], abs=1e-4)
