"""Scroll with mini-crank: published trends (Zhao et al. 2013), laws, second methods."""

import csv

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from machine_files import changed, load_machine, machine_file
from scipy.integrate import solve_ivp
from support import ROOT

from vibroacoustics.errors import ParameterError
from vibroacoustics.mechanisms.minicrank.cycle import (
    minicrank_pin_force,
    steady_minicrank_cycle,
)
from vibroacoustics.mechanisms.minicrank.four_bar import (
    Links,
    closing_margins,
    four_bar_motion,
    links_of,
    reachable_crank_angles,
)
from vibroacoustics.moving_parts import derivative
from vibroacoustics.parameters.minicrank import MiniCrankMachine
from vibroacoustics.rotation import uniform_crank_angle

MACHINE = load_machine(machine_file("zhao_minicrank"), MiniCrankMachine)
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


def inertia_peak(form: Links, speed_rpm: float, branch: int = 1) -> tuple[float, float]:
    """Largest |J2 θ̈2 θ̇2/θ̇1| and its crank angle, N m and degrees; 0.01° apart."""
    moved = four_bar_motion(form, uniform_crank_angle(36000), branch)
    omega = 2.0 * np.pi * speed_rpm / 60.0
    torque = np.abs(0.142 * omega**2 * moved.scroll_angle[2] * moved.scroll_angle[1])
    peak = int(np.argmax(torque))
    return float(torque[peak]), float(np.rad2deg(moved.crank_angle[peak]))


def published(quantity: str):
    with (ROOT / "data" / "validation" / "zhao.csv").open(encoding="utf-8") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        keys = ("crank_error_um", "scroll_error_um", "speed_rpm", "value")
        return [[float(row[key]) for key in keys] for row in rows if row["quantity"] == quantity]


# --- published -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("crank_um", "scroll_um", "speed_rpm", "torque"), published("peak inertia torque")
)
def test_peak_inertia_torque(crank_um, scroll_um, speed_rpm, torque):
    assert inertia_peak(links(crank_um, scroll_um), speed_rpm)[0] == pytest.approx(torque, rel=0.01)


@pytest.mark.parametrize(
    ("crank_um", "scroll_um", "speed_rpm", "degrees"), published("crank angle of the peak")
)
def test_peaks_stand_where_the_links_are_in_line(crank_um, scroll_um, speed_rpm, degrees):
    found = inertia_peak(links(crank_um, scroll_um), speed_rpm)[1]
    assert found == pytest.approx(degrees, abs=0.005 + 0.005)  # last digit and our own grid


@pytest.mark.parametrize(("crank_um", "_", "__", "degrees"), published("swing of the mini-crank"))
def test_shorter_crank_makes_the_minicrank_rock(crank_um, _, __, degrees):
    moved = four_bar_motion(links(crank_um), uniform_crank_angle(36000), 1)
    assert np.rad2deg(np.ptp(moved.minicrank_angle[0])) == pytest.approx(degrees, abs=0.5)
    # "4.4° scroll swing", physics.md B6: 4.39° and 4.48°.
    assert np.rad2deg(np.ptp(moved.scroll_angle[0])) == pytest.approx(4.4, abs=0.1)


def test_torque_goes_as_speed_squared():
    ratio = inertia_peak(links(-20.0), 3000.0)[0] / inertia_peak(links(-20.0), 1500.0)[0]
    assert ratio == pytest.approx(4.0, rel=1e-12)


def test_order_of_the_error_sizes():
    """Section 5: l1 shorter or l3 longer lowers the extremes; l2 longer or l4 shorter raises."""
    sizes = [inertia_peak(links(error), 1500.0)[0] for error in (-10.0, -20.0, -50.0, -100.0)]
    assert sizes == sorted(sizes, reverse=True)
    base = sizes[2]
    assert inertia_peak(links(-50.0, minicrank_um=20.0), 1500.0)[0] < base
    assert inertia_peak(links(-50.0, minicrank_um=-20.0), 1500.0)[0] > base
    assert inertia_peak(links(-50.0, scroll_um=20.0), 1500.0)[0] > base
    assert inertia_peak(links(-50.0, bracket_um=-20.0), 1500.0)[0] > base
    # physics.md B6: as the error to the power -0.53, so without bound.
    assert np.log(sizes[3] / sizes[0]) / np.log(10.0) == pytest.approx(-0.53, abs=0.005)


@pytest.mark.parametrize(("branch", "larger"), [(-1, "joins"), (1, "leaves")])
def test_larger_extreme_of_the_two_reversals(branch, larger):
    """Section 5: the larger is where the mini-crank joins the crankshaft's direction; M = -1."""
    moved = four_bar_motion(links(-10.0), uniform_crank_angle(36000), branch)
    torque = np.abs(moved.scroll_angle[2] * moved.scroll_angle[1])
    forward = moved.minicrank_angle[1] > 0.0
    joins = int(np.flatnonzero(forward & ~np.roll(forward, 1))[0])
    leaves = int(np.flatnonzero(~forward & np.roll(forward, 1))[0])
    extreme = {
        name: np.max(np.roll(torque, 600 - place)[:1200])  # 6° to either side
        for name, place in {"joins": joins, "leaves": leaves}.items()
    }
    assert max(extreme, key=extreme.__getitem__) == larger
    assert sorted(extreme.values()) == pytest.approx([0.0235, 0.0285], abs=5e-5)


def test_hinges_b_c_d_run_clockwise_with_m_negative():
    """Section 2.1 says M is positive then; with (5) as printed it is negative."""
    form = links(-50.0)
    for branch in (1, -1):
        moved = four_bar_motion(form, np.array([0.5 * np.pi]), branch)
        third = moved.minicrank_angle[0, 0]
        b, c, d = 1j * form.crank_m, form.bracket_m + form.minicrank_m * np.exp(1j * third), 0.115
        clockwise = np.imag(np.conj(c - b) * (d - c)) < 0.0
        assert clockwise == (branch == -1)


def test_ideal_mechanism_needs_the_load_torque_only():
    """Equations (7) and (18)."""
    cycle = steady_minicrank_cycle(changed(MACHINE, four_bar={"crank_error_m": 0.0}), 1500.0)
    assert not cycle.moved.scroll_angle.any()
    np.testing.assert_array_equal(cycle.moved.minicrank_angle[0], cycle.moved.crank_angle)
    total = np.sum(list(cycle.input_torque_n_m.values()), axis=0)
    np.testing.assert_allclose(total, cycle.load.tangential_force_n * 4.5e-3, rtol=1e-14)


# --- kinematics ----------------------------------------------------------------------------------

errors_um = st.floats(-100.0, 100.0)


@settings(max_examples=60, deadline=None)
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
    pin = minicrank_pin_force(cycle.links, cycle.moved, machine.masses, cycle.load, cycle.rotation)
    arm = cycle.links.crank_m
    angle = cycle.moved.crank_angle
    through_pin = arm * (np.cos(angle) * pin[1] - np.sin(angle) * pin[0])
    euler = arm * cycle.load.tangential_force_n + through_pin
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
    moved = cycle.moved
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


def test_momentum_change_is_the_resultant_on_the_housing(heavy):
    """Crankshaft bearing at the origin, mini-crank axis, stator and fixed scroll."""
    masses, moved, form = HEAVY.masses, heavy.moved, heavy.links
    pin = minicrank_pin_force(form, moved, masses, heavy.load, heavy.rotation)
    third, speed = moved.minicrank_angle, heavy.rotation.speed_rad_per_s
    # Acceleration of the mini-crank's pin by differences of its place in time.
    place = form.minicrank_m * np.stack([np.cos(third[0]), np.sin(third[0])])
    step = 2.0 * np.pi / speed.size
    velocity = (np.roll(place, -1, axis=1) - np.roll(place, 1, axis=1)) / (2.0 * step) * speed
    moving = (np.roll(velocity, -1, axis=1) - np.roll(velocity, 1, axis=1)) / (2.0 * step) * speed
    weight = np.array([[0.0], [-masses.minicrank_mass_kg * G]])
    on_housing = pin + weight - masses.minicrank_mass_kg * moving  # at the mini-crank's axis
    reaction = heavy.load.tangential_force_n * form.crank_m - heavy.load.moment_n_m
    turning = form.bracket_m * on_housing[1] + reaction - heavy.rotation.motor_torque_n_m
    # The weight itself comes from outside the machine.
    turning = turning - weight[1] * (form.bracket_m + place[0])
    total = np.sum([own.moment_n_m[2] for own in heavy.housing.values()], axis=0)
    # Central differences over 0.025° of a motion that turns within 2.7°: (0.025/2.7)² = 9e-5.
    np.testing.assert_allclose(total, turning, atol=1e-4 * np.max(np.abs(total)))
    inertia_force = np.sum([own.force_n[:2] for own in heavy.housing.values()], axis=0)
    expected = -masses.minicrank_mass_kg * moving
    np.testing.assert_allclose(inertia_force, expected, atol=2e-3 * np.max(np.abs(expected)))


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
    pin = minicrank_pin_force(heavy.links, heavy.moved, HEAVY.masses, heavy.load, heavy.rotation)
    for index in [*range(0, 14400, 800), 109, 7100]:
        angles = np.array([heavy.moved.crank_angle[index], heavy.moved.scroll_angle[0, index],
                           heavy.moved.minicrank_angle[0, index]])  # fmt: skip
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

    start = [0.0, heavy.moved.scroll_angle[0, 0], heavy.moved.minicrank_angle[0, 0], speeds[0]]
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
    for moment in (own.moment_n_m[2] for own in heavy.housing.values()):
        mean = np.mean(moment * slowness) / np.mean(slowness)
        assert abs(mean) < 1e-6 * np.max(np.abs(moment))


# --- bad input -----------------------------------------------------------------------------------


def test_one_minicrank_cannot_hold_a_parallelogram():
    machine = changed(MACHINE, four_bar={"crank_error_m": 0.0})
    cycle = steady_minicrank_cycle(machine, 1500.0)
    with pytest.raises(ParameterError, match="a parallelogram with one mini-crank"):
        minicrank_pin_force(cycle.links, cycle.moved, machine.masses, cycle.load, cycle.rotation)


@pytest.mark.parametrize("speed_rpm", [0.0, -1.0, float("nan"), float("inf")])
def test_speed_that_cannot_be(speed_rpm):
    with pytest.raises(ParameterError, match="speed_rpm = "):
        steady_minicrank_cycle(MACHINE, speed_rpm)


def test_errors_add_to_the_nominal_lengths():
    assert links_of(MACHINE.four_bar).crank_m == pytest.approx(4.45e-3, rel=1e-12)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("\ncrank_mm = { value = 4.5", "\ncrank_mm = { value = 0.0", "crank_mm = 0.0 mm"),
        ("branch = { value = -1,", "branch = { value = 0,", "branch = 0"),
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
        load_machine(file, MiniCrankMachine)
