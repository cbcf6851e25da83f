"""Scroll with mini-crank (Zhao et al. 2013): laws, second methods, bad input.

Published numbers are in test_literature.
"""

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from machine_files import changed, machine_file
from minicrank_reach import reachable_crank_angles
from scipy.integrate import solve_ivp
from scipy.optimize import least_squares
from support import PIPELINES

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.mechanics.moving_parts import (
    MovingPart,
    axes_of,
    derivative,
    path,
    wrench,
)
from vibroacoustics.mechanics.rotation import uniform_crank_angle
from vibroacoustics.mechanisms.minicrank.cycle import (
    crank_pin_force,
    four_bar_motion,
    minicrank_pin_force,
    steady_minicrank_cycle,
    three_minicranks_motion,
)
from vibroacoustics.mechanisms.minicrank.links import CLOSING, FourBar, Links, closing_margins
from vibroacoustics.mechanisms.minicrank.machine import MiniCrankMachine
from vibroacoustics.mechanisms.minicrank.revolution import (
    counterweight_moments,
    housing_wrenches,
    minicrank_revolution,
)
from vibroacoustics.orders import order_spectrum, order_spectrum_at_speed
from vibroacoustics.study.loading import load_machine, load_study

MACHINE = load_machine(machine_file("zhao_minicrank"))
HEAVY = changed(  # with what the paper neglects, to see every term
    MACHINE,
    four_bar={"crank_error_m": -1e-4},
    masses={"minicrank_mass_kg": 0.3, "minicrank_inertia_kg_m2": 1e-4, "motor_slope_ratio": -1.0},
)
G = 9.80665


def links(crank_um=0.0, scroll_um=0.0, minicrank_um=0.0, bracket_um=0.0) -> Links:
    return Links(
        4.5e-3 + 1e-6 * crank_um,
        0.115 + 1e-6 * scroll_um,
        4.5e-3 + 1e-6 * minicrank_um,
        0.115 + 1e-6 * bracket_um,
    )


def test_ideal_mechanism_needs_the_load_torque_only():
    """Equations (7) and (18)."""
    cycle = steady_minicrank_cycle(changed(MACHINE, four_bar={"crank_error_m": 0.0}), 1500.0)
    assert not cycle.motion.scroll_angle.any()
    np.testing.assert_array_equal(cycle.motion.minicrank_angle[0], cycle.motion.crank_angle)
    total = np.sum(list(cycle.input_torque_n_m.values()), axis=0)
    np.testing.assert_allclose(total, cycle.load.tangential_force_n * 4.5e-3, rtol=1e-14)


# --- kinematics ----------------------------------------------------------------------------------

errors_um = st.floats(-100.0, 100.0)


# Five in six samples do not close; those are what closing_margins is for.
@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.filter_too_much])
@given(
    crank=errors_um, scroll=errors_um, minicrank=errors_um, bracket=errors_um,
    branch=st.sampled_from([1, -1]),
)  # fmt: skip
def test_links_close_on_both_branches(crank, scroll, minicrank, bracket, branch):
    form = links(crank, scroll, minicrank, bracket)
    assume(min(closing_margins(form)) > 1e-7)
    moved = four_bar_motion(form, uniform_crank_angle(3600), branch)
    first, second, third = moved.crank_angle, moved.scroll_angle[0], moved.minicrank_angle[0]
    l1, l2, l3, l4 = form.crank_m, form.scroll_m, form.minicrank_m, form.bracket_m
    gap_x = l1 * np.cos(first) + l2 * np.cos(second) - l3 * np.cos(third) - l4  # equation (1)
    gap_y = l1 * np.sin(first) + l2 * np.sin(second) - l3 * np.sin(third)
    # Rounding of the root's small factors: eps 115 mm over a margin of 0.1 µm, of l3.
    assert np.max(np.hypot(gap_x, gap_y)) < 1e-13
    # One way of assembly throughout, and no jump: sin(θ3 - θ2) keeps its sign.
    assert np.all(np.sign(np.sin(third - second)) == np.sign(np.sin(third - second))[0])
    assert np.max(np.abs(np.diff(third))) < np.deg2rad(20.0)
    # Variations as the paper writes them, equation (16).
    varied = l1 * (l2 * np.sin(second - first) + l4 * np.sin(first))
    varied /= l2 * (l1 * np.sin(second - first) - l4 * np.sin(second))
    np.testing.assert_allclose(moved.scroll_angle[1], varied, rtol=1e-6, atol=1e-7)
    varied = l1 * (l3 * np.sin(third - first) - l4 * np.sin(first))
    varied /= l3 * (l1 * np.sin(third - first) - l4 * np.sin(third))
    np.testing.assert_allclose(moved.minicrank_angle[1], varied, rtol=1e-6, atol=1e-7)


@pytest.mark.parametrize("branch", [1, -1])
def test_motion_has_its_own_derivatives(branch):
    """Against Fourier derivatives; peaks 2.7° wide are resolved by 3600 samples to rounding."""
    moved = four_bar_motion(links(-100.0), uniform_crank_angle(3600), branch)
    for angle in (moved.scroll_angle, moved.minicrank_angle):
        # Rounding times orders squared, 1800² · 2.2e-16 · 3 rad, over the least sin(θ3 - θ2), 0.2.
        np.testing.assert_allclose(derivative(angle[0], 2), angle[2], rtol=0, atol=1e-7)
        swept = 0.5 * (angle[1] + np.roll(angle[1], 1)) * 2.0 * np.pi / 3600
        assert abs(np.sum(swept)) < 1e-10  # comes back: a rocker


def test_branches_are_mirror_images():
    angle = uniform_crank_angle(360)
    one, other = (four_bar_motion(links(-50.0), angle, branch) for branch in (1, -1))
    mirrored = -np.roll(other.scroll_angle[0][::-1], 1)
    np.testing.assert_allclose(one.scroll_angle[0], mirrored, atol=1e-12)


# --- closing -------------------------------------------------------------------------------------


def test_shorter_minicrank_does_not_close():
    """l3 < l1 by 10 µm: the joints must give 10 µm in both collinear positions."""
    form = links(minicrank_um=-10.0)
    assert closing_margins(form) == pytest.approx((-1e-5, -1e-5), rel=1e-9)
    first, last = reachable_crank_angles(form)
    for angle, span in ((first, 0.115 - 4.49e-3), (last, 0.115 + 4.49e-3)):
        reach = np.hypot(0.115 - 4.5e-3 * np.cos(angle), 4.5e-3 * np.sin(angle))
        assert reach == pytest.approx(span, rel=1e-12)
    assert np.rad2deg([first, last]) == pytest.approx([3.74, 176.11], abs=0.005)
    with pytest.raises(ParameterError, match=r"minicrank_mm.*4\.49.*10 µm are missing"):
        four_bar_motion(form, uniform_crank_angle(8), 1)


@pytest.mark.parametrize("turned", [{"scroll_um": 20.0}, {"scroll_um": -20.0}])
def test_one_condition_alone_is_not_enough(turned):
    """(19) or (20) holds, not both: the paper's "or" would let the crank turn."""
    form = links(**turned)
    assert sorted(np.sign(closing_margins(form))) == [-1.0, 1.0]
    with pytest.raises(ParameterError, match="20 µm are missing"):
        four_bar_motion(form, uniform_crank_angle(8), 1)


def test_closed_mechanism_reaches_all_crank_angles():
    assert reachable_crank_angles(links(-50.0)) == (0.0, np.pi)
    assert reachable_crank_angles(links()) == (0.0, np.pi)


@settings(max_examples=60, deadline=None)
@given(crank=errors_um, scroll=errors_um, minicrank=errors_um, bracket=errors_um)
def test_what_is_reachable_closes(crank, scroll, minicrank, bracket):
    form = links(crank, scroll, minicrank, bracket)
    first, last = reachable_crank_angles(form)
    assert (first > 0.0 or last < np.pi) == (min(closing_margins(form)) < 0.0)
    reach = np.hypot(
        form.bracket_m - form.crank_m * np.cos([first, last]),
        form.crank_m * np.sin([first, last]),
    )
    assert reach[0] >= (form.scroll_m - form.minicrank_m) * (1.0 - 1e-12)
    assert reach[1] <= (form.scroll_m + form.minicrank_m) * (1.0 + 1e-12)


def test_links_that_never_close():
    with pytest.raises(ParameterError, match="close at no crank angle"):
        reachable_crank_angles(Links(4.5e-3, 0.05, 4.5e-3, 0.115))
    with pytest.raises(ParameterError, match="do not close"):
        four_bar_motion(Links(4.5e-3, 0.05, 4.5e-3, 0.115), uniform_crank_angle(8), 1)


def test_change_point_that_is_no_parallelogram():
    with pytest.raises(ParameterError, match="they only just reach"):
        four_bar_motion(links(scroll_um=-20.0, minicrank_um=20.0), uniform_crank_angle(8), 1)


# --- dynamics ------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def heavy():
    return steady_minicrank_cycle(HEAVY, 1500.0)


def at_constant_speed(machine: MiniCrankMachine, speed_rpm: float):
    """An endless flywheel, so that the crankshaft runs at constant speed."""
    return steady_minicrank_cycle(changed(machine, masses={"rotor_inertia_kg_m2": 1e9}), speed_rpm)


@pytest.mark.parametrize("machine", [HEAVY, changed(MACHINE, four_bar={"scroll_error_m": 2e-5})])
def test_virtual_work_equals_newton_and_euler(machine):
    """Input torque against the moment of the force that the scroll passes on to the crank pin."""
    cycle = at_constant_speed(machine, 1500.0)
    given = (cycle.links, cycle.motion, machine.masses, cycle.load, cycle.rotation)
    x, y = crank_pin_force(*given)
    y = y + G * machine.masses.scroll_mass_kg  # held by the counterweights
    angle = cycle.motion.crank_angle
    euler = -cycle.links.crank_m * (np.cos(angle) * y - np.sin(angle) * x)
    torque = cycle.input_torque_n_m
    total = np.sum(list(torque.values()), axis=0)
    # Constant speed to W/(J Ω²) = 1e-12; rounding of sin(θ3 - θ2), at least 0.03 in line.
    np.testing.assert_allclose(total, euler, rtol=0, atol=1e-9 * np.max(np.abs(total)))
    printed = total - 2.0 * torque["scroll_inertia"]
    assert np.max(np.abs(printed - euler)) > 0.5 * np.max(np.abs(total))


@pytest.mark.parametrize("source", ["scroll_inertia", "minicrank_inertia", "weight"])
def test_inertia_and_weight_do_no_work_over_a_revolution(source, heavy):
    gas = 2.0 * np.pi * np.mean(heavy.load.tangential_force_n) * heavy.links.crank_m
    work = 2.0 * np.pi * np.mean(heavy.input_torque_n_m[source])
    assert np.max(np.abs(heavy.input_torque_n_m[source])) > 1e-3  # it is there
    assert abs(work) < 1e-6 * gas


@pytest.mark.parametrize("machine", [MACHINE, HEAVY])
def test_energy_balance(machine):
    """Motor against the work at crank pin and scroll; in between the kinetic energy follows."""
    cycle = steady_minicrank_cycle(machine, 1500.0)
    moved = cycle.motion
    supplied = 2.0 * np.pi * np.mean(cycle.rotation.motor_torque_n_m)
    pin_work = 2.0 * np.pi * 2000.0 * cycle.links.crank_m  # the ripple has no mean
    turned = np.diff(moved.scroll_angle[0], append=moved.scroll_angle[0][0])
    middle = 0.5 * (cycle.load.moment_n_m + np.roll(cycle.load.moment_n_m, -1))
    assert supplied == pytest.approx(pin_work - np.sum(middle * turned), abs=1e-6 * pin_work)
    speed, masses = cycle.rotation.speed_rad_per_s, machine.masses
    energy = 0.5 * masses.rotor_inertia_kg_m2 * speed**2
    energy += 0.5 * masses.scroll_inertia_kg_m2 * (moved.scroll_angle[1] * speed) ** 2
    energy += 0.5 * masses.minicrank_inertia_kg_m2 * (moved.minicrank_angle[1] * speed) ** 2
    height = cycle.links.minicrank_m * np.sin(moved.minicrank_angle[0])
    energy += masses.minicrank_mass_kg * G * height
    surplus = cycle.rotation.motor_torque_n_m - cycle.input_torque_n_m["load"]
    step = 2.0 * np.pi / speed.size
    gained = step * np.cumsum(0.5 * (surplus + np.roll(surplus, -1)))
    np.testing.assert_allclose(energy[1:] - energy[0], gained[:-1], atol=1e-6 * pin_work)


def in_the_plane(machine: MiniCrankMachine, cycle) -> tuple[np.ndarray, np.ndarray]:
    """Resultant in the mechanism's axes about the shaft in the links' plane."""
    frame, wrenches = machine.plane(0.0), housing_wrenches(machine, cycle).values()
    force = sum(own.force_n for own in wrenches)
    moment = sum(own.moment_n_m for own in wrenches)
    moment = moment - np.cross(np.array(frame.origin_m)[:, None], force, axis=0)
    return axes_of(frame).T @ force, axes_of(frame).T @ moment


def test_forces_at_the_bearings_are_the_resultant_on_the_housing(heavy):
    """Crankshaft bearing, mini-crank axis, stator and fixed scroll, less the weights."""
    masses, moved, form, rotation = HEAVY.masses, heavy.motion, heavy.links, heavy.rotation
    given = (form, moved, masses, heavy.load, rotation)
    third, turn = moved.minicrank_angle, np.exp(1j * moved.crank_angle)
    # Acceleration of the mini-crank's pin by differences of its place in time.
    place = form.minicrank_m * np.exp(1j * third[0])
    step = 2.0 * np.pi / turn.size

    def slope(signal):
        change = np.roll(signal, -1) - np.roll(signal, 1)
        return change / (2.0 * step) * rotation.speed_rad_per_s

    carried = masses.minicrank_mass_kg * slope(slope(place))
    at_minicrank = complex_of(minicrank_pin_force(*given)) - carried
    at_crankshaft = complex_of(crank_pin_force(*given)) + 1j * masses.scroll_mass_kg * G
    on_shaft = masses.crank_pin_mass_kg * form.crank_m + sum(counterweight_moments(HEAVY))
    at_crankshaft -= on_shaft * slope(slope(turn))
    gas = turn * (heavy.load.radial_force_n + 1j * heavy.load.tangential_force_n)
    force, moment = in_the_plane(HEAVY, heavy)
    # Central differences over 0.025° of a motion that turns within 2.7°: (0.025/2.7)² = 9e-5 of
    # what the mini-crank makes; of 1400 N on the crankshaft (4.4e-4)²/3.
    allowed = 1e-4 * np.max(np.abs(carried)) + 1e-7 * 1400.0
    found = at_minicrank + at_crankshaft + gas
    np.testing.assert_allclose(complex_of(force), found, rtol=0, atol=allowed)
    roll = heavy.load.tangential_force_n * form.crank_m - heavy.load.moment_n_m
    roll += form.bracket_m * at_minicrank.imag - rotation.motor_torque_n_m
    roll += masses.minicrank_mass_kg * G * place.real  # the weight itself comes from outside
    np.testing.assert_allclose(moment[2], roll, rtol=0, atol=1e-4 * np.max(np.abs(moment[2])))


def complex_of(force: np.ndarray) -> np.ndarray:
    return force[0] + 1j * force[1]


THREE = changed(HEAVY, four_bar={"minicranks": 3, "bracket_error_m": 3e-5})


def test_closing_does_not_limit_errors_of_three_minicranks():
    """Elastic pins close with any errors; one rigid mini-crank has limits."""
    assert [limit.rule(THREE) for limit in CLOSING] == [(-np.inf, np.inf)] * 2
    crank, bracket = (limit.rule(MACHINE) for limit in CLOSING)
    assert np.isfinite([crank[1], *bracket]).all()


@pytest.mark.parametrize("machine", [HEAVY, THREE])
def test_momentum_change_is_the_resultant(machine):
    """All parts as points with Fourier derivatives, all six components; spins besides."""
    cycle = steady_minicrank_cycle(machine, 1500.0, 3600)
    masses, planes, rotation = machine.masses, machine.counterweights, cycle.rotation
    heights = (0.0, planes.upper_height_m, planes.lower_height_m)
    orbiting = masses.scroll_mass_kg + masses.crank_pin_mass_kg
    radii = [np.copysign(planes.radius_m, moment) for moment in counterweight_moments(machine)]
    weights = [moment / r for moment, r in zip(counterweight_moments(machine), radii, strict=True)]
    turning = [(orbiting, cycle.links.crank_m), *zip(weights, radii, strict=True)]
    parts = [
        point(machine, mass, radius * np.exp(1j * cycle.motion.crank_angle), height)
        for (mass, radius), height in zip(turning, heights, strict=True)
    ]
    count, form = machine.four_bar.minicranks, cycle.links
    pin = form.minicrank_m * np.exp(1j * cycle.motion.minicrank_angle[0])
    axes = form.bracket_m * np.exp(2j * np.pi * np.arange(count) / 3.0)
    parts += [point(machine, masses.minicrank_mass_kg, axis + pin, 0.0) for axis in axes]
    force, moment = wrench(parts, rotation)
    # What turns besides the points: each spin less what its points already have.
    crankshaft = np.broadcast_to([[0.0], [1.0], [0.0]], (3, 3600))
    own = masses.minicrank_inertia_kg_m2 - masses.minicrank_mass_kg * form.minicrank_m**2
    for inertia, (_, first, second) in (
        (masses.rotor_inertia_kg_m2 - sum(mass * r**2 for mass, r in turning), crankshaft),
        (masses.scroll_inertia_kg_m2, cycle.motion.scroll_angle),
        (count * own, cycle.motion.minicrank_angle),
    ):
        spin = second * rotation.speed_rad_per_s**2 + first * rotation.acceleration_rad_per_s2
        moment = moment - inertia * spin * np.array(machine.plane(0.0).shaft)[:, None]
    wrenches = housing_wrenches(machine, cycle).values()
    # Rounding of Fourier derivatives: 1800² · 1.1e-16 = 4e-10 of at most 1700 N, in six parts.
    found = sum(each.force_n for each in wrenches), sum(each.moment_n_m for each in wrenches)
    np.testing.assert_allclose(found[0], force, rtol=0, atol=4e-6)
    np.testing.assert_allclose(found[1], moment, rtol=0, atol=4e-6)


def point(machine: MiniCrankMachine, mass_kg: float, place: np.ndarray, height_m: float):
    """A mass at a complex place in a plane of the mechanism."""
    frame = machine.plane(height_m)
    in_plane = path(place.real, place.imag, 0.0)
    return MovingPart(
        "part", mass_kg, axes_of(frame) @ in_plane + np.array(frame.origin_m)[:, None]
    )


def multipliers(
    cycle, machine, angles, speed: float, motor: float, tangential: float, moment: float
):
    """Acceleration of the crankshaft by Lagrange multipliers on the two closing conditions."""
    form, masses = cycle.links, machine.masses
    lengths = np.array([form.crank_m, form.scroll_m, -form.minicrank_m])
    J = np.stack([-lengths * np.sin(angles), lengths * np.cos(angles)])
    rates = np.array([1.0, *np.linalg.solve(J[:, 1:], -J[:, 0])]) * speed
    drift = np.stack([lengths * np.cos(angles), lengths * np.sin(angles)]) @ rates**2
    inertias = np.diag([masses.rotor_inertia_kg_m2, masses.scroll_inertia_kg_m2,
                        masses.minicrank_inertia_kg_m2])  # fmt: skip
    weight = masses.minicrank_mass_kg * G * form.minicrank_m * np.cos(angles[2])
    system = np.block([[inertias, J.T], [J, np.zeros((2, 2))]])
    loads = [motor - tangential * form.crank_m, moment, -weight]
    return rates, np.linalg.solve(system, [*loads, *drift])


def test_lagrange_multipliers_give_the_same_motion_and_force(heavy):
    pin = minicrank_pin_force(heavy.links, heavy.motion, HEAVY.masses, heavy.load, heavy.rotation)
    for index in [*range(0, 14400, 800), 109, 7100]:
        angles = np.array([heavy.motion.crank_angle[index], heavy.motion.scroll_angle[0, index],
                           heavy.motion.minicrank_angle[0, index]])  # fmt: skip
        _, solved = multipliers(
            heavy,
            HEAVY,
            angles,
            heavy.rotation.speed_rad_per_s[index],
            heavy.rotation.motor_torque_n_m[index],
            heavy.load.tangential_force_n[index],
            heavy.load.moment_n_m[index],
        )
        # Rounding: the system's condition is some 1e5 where the links are in line.
        expected = heavy.rotation.acceleration_rad_per_s2
        assert solved[0] == pytest.approx(expected[index], abs=1e-8 * np.max(np.abs(expected)))
        np.testing.assert_allclose(solved[3:], pin[:, index], atol=1e-8 * np.max(np.abs(pin)))


def test_integration_in_time_repeats_the_cycle(heavy):
    """All three angles marched with the multipliers; they still close after a revolution."""
    speeds = heavy.rotation.speed_rad_per_s
    mean = 2.0 * np.pi * 25.0
    level = heavy.rotation.motor_torque_n_m[0] / (1.0 - (speeds[0] / mean - 1.0))
    loads = HEAVY.loads
    friction = heavy.load.friction_moment_n_m[0]

    def slope(_, state):
        angles, speed = state[:3], state[3]
        tangential = loads.tangential_force_n * (1.0 + loads.ripple_ratio * np.cos(angles[0]))
        moment = 0.5 * heavy.links.crank_m * tangential + friction
        motor = level * (1.0 - (speed / mean - 1.0))
        rates, solved = multipliers(heavy, HEAVY, angles, speed, motor, tangential, moment)
        return [*rates, solved[0]]

    start = [0.0, heavy.motion.scroll_angle[0, 0], heavy.motion.minicrank_angle[0, 0], speeds[0]]
    marks = [*heavy.rotation.time_s[[200, 3600, 7300, 12000]], 0.04]
    found = solve_ivp(
        slope, (0.0, 0.04), start, rtol=1e-9, atol=1e-10, t_eval=marks, method="DOP853"
    )
    # The trapezoidal rule over 0.025° steps of the smooth load: (2π/14400)²/12 = 1.6e-8; the
    # marches' own tolerance, amplified some 10 times at the reversals.
    expected = speeds[[200, 3600, 7300, 12000, 0]]
    np.testing.assert_allclose(found.y[3], expected, rtol=1e-6)
    np.testing.assert_allclose(found.y[0, -1], 2.0 * np.pi, rtol=1e-6)
    np.testing.assert_allclose(found.y[1:3, -1], start[1:3], atol=1e-6)


def test_ripple_of_the_rotor_grows_as_its_inertia_falls():
    light, heavy_rotor = (
        steady_minicrank_cycle(changed(MACHINE, masses={"rotor_inertia_kg_m2": inertia}), 1500.0)
        for inertia in (0.03, 0.3)
    )
    ratio = light.rotation.fluctuation_ratio / heavy_rotor.rotation.fluctuation_ratio
    # As 1/J, but for the scroll's own inertia at the shaft, up to 0.142 (2 · 4.5/115)² = 9e-4.
    assert ratio == pytest.approx(10.0, rel=0.03)


def test_roll_moment_has_no_mean(heavy):
    slowness = 1.0 / heavy.rotation.speed_rad_per_s
    wrenches = housing_wrenches(HEAVY, heavy)
    for moment in (wrenches[name].moment_n_m[1] for name in ("rotor", "orbiting_scroll")):
        mean = np.mean(moment * slowness) / np.mean(slowness)
        assert abs(mean) < 1e-6 * np.max(np.abs(moment))


# --- three mini-cranks ---------------------------------------------------------------------------


def elastic_scroll_angle(form: Links, crank_angle: float) -> float:
    """Turn of the scroll on three equal elastic pins, whole geometry, by least squares."""
    axes = np.exp(2j * np.pi * np.arange(3) / 3.0)
    loops = ((form.scroll_m, form.minicrank_m, form.bracket_m),
             *[(form.bracket_m, form.crank_m, form.bracket_m)] * 2)  # fmt: skip
    l2, l3, l4 = (np.array(lengths) for lengths in zip(*loops, strict=True))
    pin = form.crank_m * np.exp(1j * crank_angle)

    def gaps(unknown: np.ndarray) -> np.ndarray:
        turn, thirds = unknown[0], crank_angle + unknown[1:]
        gap = l4 * axes + l3 * np.exp(1j * thirds) - pin - l2 * axes * np.exp(1j * turn)
        return np.concatenate([gap.real, gap.imag]) / 4.5e-3

    return least_squares(gaps, np.zeros(4), xtol=1e-15, ftol=1e-15, gtol=1e-15).x[0]


@pytest.mark.parametrize("form", [links(-50.0), links(scroll_um=40.0), links(-20.0, -30.0)])
def test_three_elastic_minicranks(form):
    angle = uniform_crank_angle(24)
    turn = three_minicranks_motion(form, angle).scroll_angle
    found = [elastic_scroll_angle(form, value) for value in angle]
    # First order in the errors: the next are the error over the mini-crank's 4.5 mm, 1.1 %, each.
    np.testing.assert_allclose(turn[0], found, rtol=0, atol=0.025 * np.max(np.abs(turn[0])))
    for times in (1, 2):
        expected = derivative(turn[0], times)  # orders 1 and 2 only: exact
        np.testing.assert_allclose(turn[times], expected, rtol=0, atol=1e-12)


def test_three_minicranks_have_no_change_point():
    """Beside the rigid one: two thirds of its turn across the line, no peak along it."""
    one, three = (
        motion(links(-50.0), uniform_crank_angle(36000), *branch).scroll_angle
        for motion, branch in ((four_bar_motion, (-1,)), (three_minicranks_motion, ()))
    )
    # First order in the error, 50 µm over 4.5 mm.
    assert three[0, 9000] == pytest.approx(2.0 / 3.0 * one[0, 9000], rel=0.012)
    assert np.max(np.abs(three[2])) == pytest.approx(2.0 * 50e-6 / (3.0 * 0.115), rel=1e-6)
    assert np.max(np.abs(one[2])) > 900.0 * np.max(np.abs(three[2]))


# --- in the chain --------------------------------------------------------------------------------


def orders_of(machine: MiniCrankMachine, speed_rpm: float, source: str | None = None):
    """Force and moment at the shaft orders, shapes (3, 11)."""
    moved = minicrank_revolution(machine, speed_rpm, 720)
    own = [moved.wrenches[source]] if source else moved.wrenches.values()
    return [
        order_spectrum_at_speed(sum(getattr(each, name) for each in own),
                                moved.rotation.speed_rad_per_s, 10)
        for name in ("force_n", "moment_n_m")
    ]  # fmt: skip


@pytest.mark.parametrize("speed_rpm", [1500.0, 3000.0])
def test_first_order_at_constant_speed_in_closed_form(speed_rpm):
    """(10) balances the nominal crank: (m1 + m2) δ ω² is left, at the links' plane.

    At constant speed to W/(J ω²) = 1e-12 of the 1400 N that cancel.
    """
    machine = changed(MACHINE, masses={"rotor_inertia_kg_m2": 1e9})
    force, moment = orders_of(machine, speed_rpm)
    left = 12.3 * 50e-6 * (2.0 * np.pi * speed_rpm / 60.0) ** 2
    assert np.abs(force[[0, 2], 1]) == pytest.approx(left, rel=1e-8)
    assert np.max(np.abs(force[1])) == 0.0  # along the shaft
    assert np.abs(moment[[0, 2], 1]) == pytest.approx(0.18 * left, rel=1e-8)
    three = changed(machine, four_bar={"minicranks": 3})
    turn = 0.142 * (2.0 * np.pi * speed_rpm / 60.0) ** 2 * 2.0 * 50e-6 / (3.0 * 0.115)
    _, moment = orders_of(three, speed_rpm, "orbiting_scroll")
    assert abs(moment[1, 1]) == pytest.approx(turn, rel=1e-8)
    # The rocking mini-crank lets the scroll swing as a half wave of 2 l1/l2 when the error goes
    # to zero; the next term is the error over l1, 1.1 %.
    _, moment = orders_of(machine, speed_rpm, "orbiting_scroll")
    half_wave = 0.142 * (2.0 * np.pi * speed_rpm / 60.0) ** 2 * 4.45 / 115.0
    assert abs(moment[1, 1]) == pytest.approx(half_wave, rel=0.012)


def test_counterweights_balance_the_nominal_crank():
    """Equation (10), and no couple."""
    upper, lower = counterweight_moments(MACHINE)
    assert 12.3 * 4.5e-3 + upper + lower == pytest.approx(0.0, abs=1e-15)
    assert -0.07 * upper - 0.38 * lower == pytest.approx(0.0, abs=1e-15)
    assert upper < 0.0 < lower  # m_p1 opposite the pin, m_p2 beside it, as (10) has them


def test_samples_of_the_chain_are_enough():
    """Every twentieth sample of the peaks: nothing folds back into the orders."""
    moved = minicrank_revolution(MACHINE, 1500.0, 720)
    whole = minicrank_revolution(MACHINE, 1500.0, 14400)
    for name, own in whole.wrenches.items():
        found = order_spectrum(moved.wrenches[name].moment_n_m, 16)
        expected = order_spectrum(own.moment_n_m, 16)
        scale = max(float(np.max(np.abs(own.moment_n_m))), 1e-3)
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12 * scale)


def test_facts_of_a_revolution():
    rigid = minicrank_revolution(MACHINE, 1500.0, 720).figures
    assert rigid["minicrank_swing_deg"] == pytest.approx(164.0, abs=10.0)  # rocks: 156 to 172°
    assert rigid["scroll_swing_deg"] == pytest.approx(4.4, abs=0.1)
    # 2000 N at 4.45 mm and 1500 rpm; 2000 N · 0.5 · 0.1 of friction and M_z do next to nothing.
    assert rigid["shaft_power_w"] == pytest.approx(2000.0 * 4.45e-3 * 50.0 * np.pi, rel=0.005)
    matched = minicrank_revolution(
        changed(MACHINE, four_bar={"crank_error_m": 0.0}), 1500.0, 720
    ).figures
    assert matched["scroll_swing_deg"] == 0.0
    assert "minicrank_pin_force_n" not in matched  # no force closes a rigid parallelogram
    assert matched["largest_input_torque_nm"] == pytest.approx(2200.0 * 4.5e-3, rel=1e-12)


def test_a_heavier_rotor_leaves_the_roll_as_it_is():
    """The motor's torque is even: the housing takes the load's ripple, whatever the flywheel."""
    ideal = {"crank_error_m": 0.0, "minicranks": 3}
    rolls = [
        orders_of(
            changed(MACHINE, four_bar=ideal, masses={"rotor_inertia_kg_m2": inertia}), 1500.0
        )[1]
        for inertia in (0.03, 0.06)
    ]
    # 200 N at 4.5 mm; over time instead of angle to the speed fluctuation, 0.25 %.
    for roll in rolls:
        assert abs(roll[1, 1]) == pytest.approx(0.9, rel=0.0025)


# --- bad input -----------------------------------------------------------------------------------


def test_one_minicrank_cannot_hold_a_parallelogram():
    machine = changed(MACHINE, four_bar={"crank_error_m": 0.0})
    cycle = steady_minicrank_cycle(machine, 1500.0)
    with pytest.raises(ParameterError, match="a parallelogram with one mini-crank"):
        minicrank_pin_force(cycle.links, cycle.motion, machine.masses, cycle.load, cycle.rotation)


@pytest.mark.parametrize("speed_rpm", [0.0, -1.0, float("nan"), float("inf")])
def test_speed_that_cannot_be(speed_rpm):
    with pytest.raises(ParameterError, match="speed_rpm = "):
        steady_minicrank_cycle(MACHINE, speed_rpm)


def test_errors_add_to_the_nominal_lengths():
    assert MACHINE.four_bar.links.crank_m == pytest.approx(4.45e-3, rel=1e-12)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("\ncrank_mm = { value = 4.5", "\ncrank_mm = { value = 0.0", "crank_mm = 0.0 mm"),
        ("crank_mm = { value = 4.5", "crank_mm = { value = 200.0", "crank_mm.*200.* do not close"),
        ("branch = { value = -1,", "branch = { value = 0,", "branch = 0"),
        ("minicranks = { value = 1,", "minicranks = { value = 2,", "minicranks = 2"),
        ("radius_mm = { value = 50.0, s", "radius_mm = { value = 0.0, s", "radius_mm = 0"),
        ("plate_friction = { value = 0.1, s", "plate_friction = { value = 2.0, s",
         "plate_friction = 2"),
    ],
)  # fmt: skip
def test_file_of_a_machine_that_cannot_be(tmp_path, old, new, message):
    text = machine_file("zhao_minicrank").read_text(encoding="utf-8")
    assert old in text
    file = tmp_path / "machine.toml"
    file.write_text(text.replace(old, new), encoding="utf-8")
    with pytest.raises(ParameterError, match=message):
        load_machine(file)


STUDY = PIPELINES / "zhao_minicrank.toml"


def test_study_loads():
    study = load_study(STUDY)
    assert isinstance(study.machine, MiniCrankMachine)
    assert study.machine.four_bar.minicranks == 3
    assert study.options["one-rigid-minicrank"].machine.four_bar.minicranks == 1


def test_redesign_that_does_not_close(tmp_path):
    """A mini-crank 30 µm shorter than the crank: one line with the option's place."""
    (tmp_path / "study.toml").write_text(
        f"""
        extends = "{STUDY}"
        [options.short]
        kind = "redesign"
        [options.short.change.four_bar]
        minicranks = {{ value = 1, source = "test" }}
        minicrank_error_um = {{ value = -80.0, source = "test" }}
        """
    )
    with pytest.raises(
        ParameterError,
        match=r"four_bar: crank_mm.* = 4\.45, 115, 4\.42, 115 mm: .* 30 µm are missing",
    ) as refused:
        load_study(tmp_path / "study.toml")
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"minicranks": 3, "bracket_m": 0.116}, "must fit within 0.445 mm; they differ by 1.05 mm"),
        ({"crank_m": 5e-4, "crank_error_m": -6e-4}, "must be positive with their errors"),
        ({"crank_error_m": 0.0, "minicrank_error_m": -1e-5}, "10 µm are missing"),
    ],
)
def test_links_that_cannot_be(changes, message):
    with pytest.raises(ValueError, match=message):
        FourBar.model_validate(MACHINE.four_bar.model_dump() | changes)
