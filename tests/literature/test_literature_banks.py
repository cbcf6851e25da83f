"""Shaking forces and moments of banks of cylinders, beside the textbooks' closed forms.

C. F. Taylor, The Internal-Combustion Engine in Theory and Practice, vol. 2, chapter 8; J. E.
Shigley, J. J. Uicker, Theory of Machines and Mechanisms, chapter 15: with the place of a piston
as a series over the crank angle, order n of a cylinder's force is m r ω² A_n along its axis at n
times its own crank angle; banks and throws add up as vectors.
"""

from functools import partial
from itertools import pairwise

import numpy as np
import pytest
from documents import TAYLOR
from evidence import claim
from hypothesis import given, settings
from hypothesis import strategies as st
from machine_files import changed, machine_file
from support import ROOT

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.mechanics.capabilities import Slider
from vibroacoustics.mechanics.rotation import constant_rotation
from vibroacoustics.mechanisms.reciprocating.cycle import steady_cycle
from vibroacoustics.mechanisms.reciprocating.cylinders import CylinderBanks
from vibroacoustics.mechanisms.reciprocating.revolution import reciprocating_revolution
from vibroacoustics.mechanisms.reciprocating.slider_crank import ConstraintForces, journal_share
from vibroacoustics.orders import order_spectrum
from vibroacoustics.study.loading import load_machine, load_study

ONE = load_machine(machine_file("mayekawa_wbhe"))
PISTONS = changed(
    ONE,
    piston_and_rod={"rod_mass_kg": 0.0, "rod_inertia_kg_m2": 0.0},
    crankshaft={"inertia_kg_m2": 1e9},
).model_copy(update={"crankshaft_height_m": 0.0})
"""Rods without mass at constant speed: what the closed forms are of. Moments about the shaft."""
SPEED_RPM = 1000.0
RADIUS_M = 2.0 * ONE.piston_and_rod.displacement_m3 / (np.pi * ONE.piston_and_rod.bore_m**2)
PRIMARY_N = ONE.piston_and_rod.piston_mass_kg * RADIUS_M * (SPEED_RPM * np.pi / 30.0) ** 2
"""m r ω²."""
RATIO = ONE.piston_and_rod.crank_to_rod_ratio
SERIES = {
    1: 1.0,
    2: RATIO + RATIO**3 / 4.0 + 15.0 * RATIO**5 / 128.0,
    4: -(RATIO**3) / 4.0 - 3.0 * RATIO**5 / 16.0,
}
"""A_n of the piston's acceleration; what is left out is 35 λ⁷/512, 3e-7."""
LEFT_OUT = 1e-6 * PRIMARY_N
ZERO = 1e-9 * PRIMARY_N
claimed = partial(
    claim, kind="exact", source=TAYLOR("chapter 8"), unit="N", tolerance=LEFT_OUT,
    topics=("reciprocating",),
)  # fmt: skip


def banks(bank_deg, throw_deg=(0.0,), positions_m=(0.0,), pitch_m=0.0, weight_kg_m=0.0):
    return CylinderBanks(
        bank_angles_rad=tuple(np.deg2rad(bank_deg)),
        throw_angles_rad=tuple(np.deg2rad(throw_deg)),
        throw_positions_m=tuple(positions_m),
        rod_pitch_m=pitch_m,
        counterweight_kg_m=weight_kg_m,
    )


def shaking(cylinders, machine=PISTONS):
    """Force upright and across, and moments about across and upright, complex peaks by order."""
    given = machine.model_copy(update={"cylinders": cylinders})
    revolution = reciprocating_revolution(given, SPEED_RPM, 360)
    total = [sum(w[kind] for w in revolution.wrenches.values()) for kind in (0, 1)]
    force, moment = (order_spectrum(values, 8) for values in total)
    return force[2], force[0], moment[0], moment[2]


def closed_form(order, bank_deg, throw_deg=(0.0,)):
    """Upright and across, as Σ m r ω² A_n e^{jn(θ + δ - β)} along (cos β, sin β)."""
    upright = across = 0.0j
    for bank in np.deg2rad(bank_deg):
        for throw in np.deg2rad(throw_deg):
            force = PRIMARY_N * SERIES[order] * np.exp(1j * order * (throw - bank))
            upright, across = upright + force * np.cos(bank), across + force * np.sin(bank)
    return upright, across


@pytest.mark.parametrize("angle", [45.0, 60.0, 90.0, 120.0])
def test_v_of_two(angle):
    """2 F cos²(β/2) and 2 F sin²(β/2); 2 F λ cos(β/2) cos β and 2 F λ sin(β/2) sin β."""
    upright, across, *_ = shaking(banks([-angle / 2.0, angle / 2.0]))
    half, full = np.deg2rad(angle / 2.0), np.deg2rad(angle)
    first = 2.0 * PRIMARY_N * np.array([np.cos(half) ** 2, np.sin(half) ** 2])
    second = 2.0 * SERIES[2] * PRIMARY_N
    second *= np.array([np.cos(half) * np.cos(full), np.sin(half) * np.sin(full)])
    named = f"V of {angle:g}°"
    claimed(f"1× force upright, {named}", computed=upright[1], reference=first[0])
    claimed(f"1× force across, {named}", computed=across[1], reference=-1j * first[1])  # a sine
    claimed(f"2× force upright, {named}", computed=upright[2], reference=second[0])
    claimed(f"2× force across, {named}", computed=across[2], reference=-1j * second[1])


def test_right_angled_v():
    """F turns with the crank: a counterweight of m r takes it all; 2× is √2 λ F across alone."""
    bare, across, *_ = shaking(banks([-45.0, 45.0]))
    assert bare[1] == pytest.approx(PRIMARY_N, abs=LEFT_OUT)
    assert abs(bare[2]) < ZERO
    claimed("2× force across, right-angled V", computed=abs(across[2]),
            reference=np.sqrt(2.0) * SERIES[2] * PRIMARY_N)  # fmt: skip
    weight = ONE.piston_and_rod.piston_mass_kg * RADIUS_M
    upright, across, *_ = shaking(banks([-45.0, 45.0], weight_kg_m=weight))
    assert abs(upright[1]) < ZERO
    assert abs(across[1]) < ZERO


def test_w_of_three():
    """1.5 F turns with the crank; 2× is ½ λ F upright and 3/2 λ F across."""
    upright, across, *_ = shaking(banks([-60.0, 0.0, 60.0]))
    second = SERIES[2] * PRIMARY_N
    claimed("1× force upright, W of three", computed=upright[1], reference=1.5 * PRIMARY_N)
    claimed("1× force across, W of three", computed=across[1], reference=-1.5j * PRIMARY_N)
    claimed("2× force upright, W of three", computed=upright[2], reference=0.5 * second)
    claimed("2× force across, W of three", computed=across[2], reference=-1.5j * second)
    weight = 1.5 * ONE.piston_and_rod.piston_mass_kg * RADIUS_M
    upright, across, *_ = shaking(banks([-60.0, 0.0, 60.0], weight_kg_m=weight))
    assert max(abs(upright[1]), abs(across[1])) < ZERO


@pytest.mark.parametrize("bank_deg", [[0.0], [-45, 45], [-60, 0, 60], [-67.5, -22.5, 22.5, 67.5]])
def test_opposite_throws(bank_deg):
    """One throw times their distance is left of the first order as a couple; the second adds."""
    distance = 0.2
    upright, across, about_x, about_z = shaking(
        banks(bank_deg, [0.0, 180.0], [-distance / 2.0, distance / 2.0])
    )
    throw = closed_form(1, bank_deg)
    assert max(abs(upright[1]), abs(across[1])) < ZERO
    named = f"opposite throws of {len(bank_deg)} cylinders"
    claimed(f"1× couple, {named}", unit="N m", computed=[about_x[1], about_z[1]],
            reference=[-distance * throw[0], distance * throw[1]])  # fmt: skip
    second = closed_form(2, bank_deg)
    claimed(f"2× force, {named}", computed=[upright[2], across[2]],
            reference=2.0 * np.array(second), tolerance=2.0 * LEFT_OUT)  # fmt: skip
    assert max(abs(about_x[2]), abs(about_z[2])) < ZERO


@pytest.mark.parametrize("count", [2, 3, 4])
def test_counterweights_take_the_couple_of_opposite_throws(count):
    """A bank's first order turns where the banks stand evenly over 180°: B/2 m r on each throw."""
    bank_deg = (np.arange(count) - 0.5 * (count - 1)) * 180.0 / count
    weight = 0.5 * count * ONE.piston_and_rod.piston_mass_kg * RADIUS_M
    _, _, about_x, about_z = shaking(banks(bank_deg, [0.0, 180.0], [-0.1, 0.1], weight_kg_m=weight))
    assert max(abs(about_x[1]), abs(about_z[1])) < ZERO


def test_six_in_line_shakes_in_no_order_up_to_five():
    six = banks([0.0], [0, 240, 120, 120, 240, 0], np.arange(6) * 0.15 - 0.375)
    for orders in shaking(six):
        assert np.max(np.abs(orders[1:6])) < ZERO
    assert abs(shaking(six)[0][6]) > 1e-6 * PRIMARY_N


def test_four_in_line_has_its_second_order():
    four = banks([0.0], [0, 180, 180, 0], np.arange(4) * 0.15 - 0.225)
    upright, _, about_x, _ = shaking(four)
    assert abs(upright[1]) < ZERO
    assert np.max(np.abs(about_x[:7])) < ZERO
    claimed("2× force, four in line", computed=upright[2], tolerance=4.0 * LEFT_OUT,
            reference=4.0 * SERIES[2] * PRIMARY_N)  # fmt: skip


@settings(max_examples=15, deadline=None)
@given(
    bank_deg=st.lists(st.floats(-90.0, 90.0), min_size=1, max_size=4),
    throw_deg=st.lists(st.floats(0.0, 360.0), min_size=1, max_size=4),
    order=st.sampled_from([1, 2, 4]),
)
def test_any_banks_and_throws(bank_deg, throw_deg, order):
    upright, across, *_ = shaking(banks(bank_deg, throw_deg, [0.0] * len(throw_deg)))
    expected = closed_form(order, bank_deg, throw_deg)
    count = len(bank_deg) * len(throw_deg)
    assert upright[order] == pytest.approx(expected[0], abs=count * LEFT_OUT)
    assert across[order] == pytest.approx(expected[1], abs=count * LEFT_OUT)


# --- with rods, gas and friction -----------------------------------------------------------------


def test_banks_of_one_cylinder_are_the_machine_without_banks():
    with_table = ONE.model_copy(update={"cylinders": banks([0.0])})
    for name, wrench in reciprocating_revolution(ONE, SPEED_RPM, 360).wrenches.items():
        other = reciprocating_revolution(with_table, SPEED_RPM, 360).wrenches[name]
        np.testing.assert_array_equal(wrench.force_n, other.force_n)
        np.testing.assert_array_equal(wrench.moment_n_m, other.moment_n_m)


def test_a_turned_cylinder_is_the_same_cylinder():
    """Phase and direction turn together: the force in the cylinder's own axes stays."""
    turned = ONE.model_copy(update={"cylinders": banks([90.0], [90.0])})
    upright = reciprocating_revolution(ONE, SPEED_RPM, 360).wrenches["piston"].force_n
    lying = reciprocating_revolution(turned, SPEED_RPM, 360).wrenches["piston"].force_n
    np.testing.assert_allclose(lying[0], upright[2], atol=1e-9 * PRIMARY_N)
    np.testing.assert_allclose(lying[2], 0.0, atol=1e-9 * PRIMARY_N)


def test_work_of_banks_closes_and_their_torque_is_smoother():
    """Gas work as often as there are cylinders, and what the motor gives is what is lost."""
    layouts = ([0.0], [-45.0, 45.0], [-60.0, 0.0, 60.0], [-67.5, -22.5, 22.5, 67.5])
    swings = []
    for bank_deg in layouts:
        throws = banks(bank_deg, [0.0, 180.0], [-0.1, 0.1])
        machine = ONE.model_copy(update={"cylinders": throws})
        run = steady_cycle(machine, ONE.piston_and_rod.bore_m, SPEED_RPM)
        single = steady_cycle(ONE, ONE.piston_and_rod.bore_m, SPEED_RPM)
        count = 2 * len(bank_deg)
        assert run.load_work_j["gas"] == pytest.approx(count * single.load_work_j["gas"], rel=1e-5)
        lost = run.supplied_work_j - sum(run.load_work_j.values())
        assert abs(lost) < 1e-9 * run.supplied_work_j
        swings.append(run.rotation.fluctuation_ratio)
    assert all(later < earlier for earlier, later in pairwise(swings))


def test_journals_take_the_vector_sum_of_their_throw():
    """Two equal pulls 90° apart: 2 cos 45° of 2; with a counterweight as large, nothing is left."""
    axial = np.tile([[1.0], [0.0]], 4)
    joints = [ConstraintForces(axial, axial, axial)] * 2
    layout = banks([-45.0, 45.0])
    shares = journal_share(layout, joints, constant_rotation(SPEED_RPM, 4))
    np.testing.assert_allclose(shares, np.sqrt(0.5), rtol=1e-12)
    # At crank angle zero the weight pulls downwards with m r ω².
    weight = np.sqrt(2.0) / (SPEED_RPM * np.pi / 30.0) ** 2
    balanced = layout.model_copy(update={"counterweight_kg_m": weight})
    shares = journal_share(balanced, joints, constant_rotation(SPEED_RPM, 4))
    assert shares[0][0] == pytest.approx(0.0, abs=1e-12)
    assert shares[0][2] == pytest.approx(np.sqrt(2.0), rel=1e-12)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"throw_positions_mm": [0.0]}, "must be as many as throw_angles_deg, 2"),
        ({"bank_angles_deg": [-45.0, 400.0]}, "bank_angles_deg: must be from -360"),
    ],
)
def test_banks_that_cannot_be_are_refused(change, message):
    study = load_study(ROOT / "pipelines" / "mayekawa_banks.toml")
    values = {
        f"options.four-counterweights.change.cylinders.{key}": {"value": value, "source": "derived"}
        for key, value in change.items()
    }
    with pytest.raises(ParameterError, match=message):
        study.replace(values)


def test_options_that_need_one_slider_are_refused():
    machine = load_machine(machine_file("mayekawa_4wbhe"))
    assert machine.capability(Slider) is None
    assert ONE.capability(Slider) is not None
