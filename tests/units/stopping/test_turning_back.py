"""What follows a stop: reversal under trapped gas, jam of the brake, valve, sound of the shell."""

import numpy as np
import pytest
from machine_files import machine_file, values_of
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from sources_study import SOURCES_STUDY, run_made_up
from support import CRANK_ANGLE, PIPELINES, machine_parts

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.machine.frame import BEARING_HOUSING, ORBITING_SCROLL
from vibroacoustics.machine.stopping import CheckValve, Stopping, TurningBack
from vibroacoustics.report.sections.stopping import sentences
from vibroacoustics.stopping.coasting import (
    AfterStop,
    closing_force_n,
    closing_time_s,
    flight_s,
    run_down,
)
from vibroacoustics.stopping.equation import Coasting, path_derivatives
from vibroacoustics.stopping.event import _height_of_brake, brake_on_parts
from vibroacoustics.stopping.labelled import stopping_variables
from vibroacoustics.stopping.reversal import STUCK_RATIO, TrappedGas
from vibroacoustics.study.loading import load_study
from vibroacoustics.transfer import on_mounts

FILE = values_of(machine_file("copeland_zp41k3e"))
PARTS = machine_parts(load_study(PIPELINES / "copeland_derived.toml"))
SHIFTED = ("orbiting_scroll", "brake", "oldham")
SPEED = 2900.0 * np.pi / 30.0
GAS = 10.24 + 0.725 * np.cos(CRANK_ANGLE) + 0.201 * np.cos(2.0 * CRANK_ANGLE)
TRAPPED = TrappedGas(30e-6, 16.16e-6, (9.98e5, 33.86e5), 1.05)
RATE_HZ = 200e3
TURNS = {"operation.turning_back": True}


def back(**values) -> TurningBack:
    return TurningBack(**{**FILE["turning_back"], **values})


def valve(**values) -> CheckValve:
    return CheckValve(**{**FILE["check_valve"], **values})


def stopped(table=None, gas=TRAPPED, torque=GAS, parts=PARTS, rate=RATE_HZ, **values):
    stopping = Stopping(**{**FILE["stopping"], **values})
    shifted = tuple(name for name in SHIFTED if name in {part.source for part in parts})
    after = AfterStop(table or back(), gas, None)
    return run_down(stopping, parts, shifted, torque, SPEED, rate, 0, after)


@pytest.fixture(scope="module")
def result():
    return stopped()


def of_motion(run, parts=PARTS, torque=GAS, **values):
    """Equation of motion and the set's angle, speed and acceleration."""
    stopping = Stopping(**{**FILE["stopping"], **values})
    shifted = tuple(name for name in SHIFTED if name in {part.source for part in parts})
    coasting = Coasting.of(stopping, parts, shifted, torque)
    ahead = [
        one + shift
        for one, shift in zip(
            (run.crank_angle_rad, run.speed_rad_per_s, run.acceleration_rad_per_s2),
            run.shift,
            strict=True,
        )
    ]
    return coasting, *ahead


def work(power, run):
    """Of a power from switch-off on, by trapezia, J."""
    step = run.time_s[1] - run.time_s[0]
    return np.concatenate([[0.0], np.cumsum(0.5 * step * (power[1:] + power[:-1]))])


# --- energy and momentum -------------------------------------------------------------------------


def test_energy_closes_through_reversal_and_jam(result):
    """Kinetic energy lost = work against gas, friction and brake, less that of the shift."""
    coasting, angle, speed, acceleration = of_motion(result)
    shaft = result.speed_rad_per_s
    moved = coasting.shifted_inertia(angle)
    kinetic = 0.5 * coasting.fixed_inertia(result.crank_angle_rad) * shaft**2
    kinetic += 0.5 * moved * speed**2
    gas = result.gas_share * coasting.gas_torque(angle)
    held = moved * acceleration + 0.5 * coasting.shifted_inertia(angle, 1) * speed**2 + gas
    friction = FILE["stopping"]["friction_torque_n_m"] * np.abs(shaft)
    brake = back().wall_radius_m * result.brake_force_n * shaft  # negative while it is pressed
    shift = held * result.shift.rate
    lost = work(gas * speed + friction - brake - shift, result)
    initial = kinetic[0]
    assert np.abs(kinetic + lost - initial).max() < 1e-3 * initial
    rest = int(np.argmax(result.crank_angle_rad))
    # Until the first rest without impacts: trapezia, (ω h)²/12 = 2e-7 of the ripple of the torque.
    assert np.abs(kinetic + lost - initial)[:rest].max() < 1e-7 * initial
    # The reversal and the jam alone, beside what the gas gave: 1 % of that too.
    given = -work(gas * speed, result)[-1] + work(gas * speed, result)[rest]
    change = (kinetic + lost)[rest:] - (kinetic + lost)[rest]
    assert np.abs(change).max() < 0.01 * given
    assert kinetic[-1] < 1e-6 * initial
    assert work(brake, result)[-1] < -0.5 * given  # most of it goes into the contact


def test_housing_gets_the_momentum_of_the_jam_too(result):
    """∫ roll moment dt = angular momentum lost, through reversal and jam."""
    roll = result.moment_n_m[:, 2].sum(axis=0)
    coasting, _, _, _ = of_motion(result)
    total = coasting.stopping.shaft_inertia_kg_m2 * result.speed_rad_per_s
    for part in PARTS:
        turned = part.source in SHIFTED
        angle = result.crank_angle_rad + turned * result.shift.angle
        place, slope, _ = path_derivatives(part.position_m, angle)
        linear = part.mass_kg * slope * (result.speed_rad_per_s + turned * result.shift.rate)
        total += np.cross(place, linear, axis=0)[2]
    pushed = work(roll, result)
    # Trapezia at impacts of half a millisecond, 100 samples: (π/100)²/12 of their momentum.
    assert np.abs(pushed - (total[0] - total)).max() < 1e-3 * total[0]
    jam = result.brake_force_n > 0.0
    assert np.abs(roll[jam]).max() > 10.0 * np.abs(roll[~jam]).max()


# --- closed forms --------------------------------------------------------------------------------


def test_reversal_without_a_brake_has_the_work_of_the_gas():
    """½ J Ω² = T ∫ share dψ - T_f ψ; p (V + ΔV)^κ constant behind the scrolls."""
    parts = [part for part in PARTS if part.source != "oldham"]
    torque, friction = np.full(8, 10.0), 0.5
    values = {"shift_rad": 0.0, "friction_torque_n_m": friction}
    run = stopped(back(free_angle_rad=600.0), torque=torque, parts=parts, rate=2e4, **values)
    coasting, _, _, _ = of_motion(run, parts, torque, **values)
    turned = run.crank_angle_rad.max() - run.crank_angle_rad
    backwards = (run.speed_rad_per_s < 0.0) & (turned > 1.0) & (turned < 20.0)
    psi, suction, discharge = turned[backwards], 9.98e5, 33.86e5
    rate = 16.16e-6 / (2.0 * np.pi * 30e-6)
    gas = discharge / (-0.05 * rate) * ((1.0 + rate * psi) ** -0.05 - 1.0) - suction * psi
    gas *= 10.0 / (discharge - suction)
    inertia = coasting.fixed_inertia(0.0) + coasting.shifted_inertia(0.0)
    kinetic = 0.5 * inertia * run.speed_rad_per_s[backwards] ** 2
    assert kinetic == pytest.approx(gas - friction * psi, rel=1e-5)


def test_jam_is_a_hertz_impact():
    """Without loss ½ m v² + F δ = ⅖ K δ^2.5 of the reduced mass J/r² under the gas's F."""
    parts = [part for part in PARTS if part.source != "oldham"]
    torque = np.full(8, 10.0)
    values = {"shift_rad": 0.0, "friction_torque_n_m": 4.0}
    table = back(restitution_ratio=1.0)
    run = stopped(table, torque=torque, parts=parts, **values)
    radius, stiffness = table.wall_radius_m, table.contact_stiffness_n_per_m1p5
    net = (10.0 - 4.0) / radius  # the gas all but constant over 5°
    free = table.free_angle_rad * radius
    depth = brentq(lambda d: net * (free + d) - 0.4 * stiffness * d**2.5, 1e-6, 1e-2)
    assert run.brake_force_n.max() == pytest.approx(stiffness * depth**1.5, rel=0.01)


def test_jam_rebounds_by_its_restitution():
    """Flores's contact without other forces: β (1 + e) = ln((1 + β)/(1 - β e)) of both speeds.

    While the contact is closed gas and friction turn backwards by at most 14 N m.
    """
    parts = [part for part in PARTS if part.source != "oldham"]
    torque, friction = np.full(8, 10.0), 4.0
    values = {"shift_rad": 0.0, "friction_torque_n_m": friction}
    table = back(restitution_ratio=0.8, free_angle_rad=1.0)
    run = stopped(table, torque=torque, parts=parts, **values)
    pressed = np.flatnonzero(run.brake_force_n > 0.0)
    last = pressed[np.flatnonzero(np.diff(pressed) > 1)[0]]
    approach, rebound = -run.speed_rad_per_s[pressed[0] - 1], run.speed_rad_per_s[last + 1]
    factor = 1.6 * (1.0 - 0.8) / 0.8
    ratio = brentq(
        lambda e: factor * (1.0 + e) - np.log((1.0 + factor) / (1.0 - factor * e)), 0.5, 0.99
    )
    coasting, _, _, _ = of_motion(run, parts, torque, **values)
    inertia = coasting.fixed_inertia(0.0) + coasting.shifted_inertia(0.0)
    closed_s = (last + 2 - pressed[0]) / RATE_HZ
    lost = (10.0 + friction) * closed_s / inertia
    assert ratio * approach - 2.0 * lost < rebound < ratio * approach
    assert 2.0 * lost < 0.2 * approach


def test_share_of_the_trapped_gas():
    shares = TRAPPED.share(np.array([0.0, 2.0 * np.pi, 100.0]))
    one_turn = (33.86 / (1.0 + 16.16 / 30.0) ** 1.05 - 9.98) / (33.86 - 9.98)
    assert shares == pytest.approx([1.0, one_turn, 0.0])


def test_friction_may_hold_the_shaft():
    """Without gas nothing turns back: the stop is the one without the table."""
    values = {"gas_share_ratio": 0.0, "friction_torque_n_m": 3.0}
    one = stopped(rate=2e4, **values)
    stopping = Stopping(**{**FILE["stopping"], **values})
    other = run_down(stopping, PARTS, SHIFTED, GAS, SPEED, 2e4, 0)
    assert one.turned_back_rad == pytest.approx(0.0, abs=1e-6)
    np.testing.assert_array_equal(one.force_n, other.force_n)
    assert one.stop_time_s == other.stop_time_s


def test_shaft_comes_to_rest_on_the_brake(result):
    """Brake and friction carry what the gas still pushes."""
    gas = result.gas_share[-1] * np.interp(
        (result.crank_angle_rad[-1] + result.shift.angle[-1]) % (2.0 * np.pi), CRANK_ANGLE, GAS,
        period=2.0 * np.pi,
    )  # fmt: skip
    held = back().wall_radius_m * result.brake_force_n[-1]
    assert abs(gas - held) <= FILE["stopping"]["friction_torque_n_m"] + STUCK_RATIO * gas
    assert result.turned_back_rad == pytest.approx(np.radians(5.0), rel=0.02)


def test_brake_is_a_pair():
    angle, force = np.array([0.0, 1.0, 2.5]), np.array([100.0, 200.0, 300.0])
    table = back(friction_ratio=0.2, wall_radius_m=0.04)
    loads = brake_on_parts(table, force, angle, 0.095)
    total = sum(loads.values())
    assert np.abs(total[:5]).max() < 1e-12
    assert total[5] == pytest.approx(-0.04 * force)
    # At angle zero the wall is dragged towards -y and pressed towards +x.
    assert loads[BEARING_HOUSING][:2, 0] == pytest.approx([500.0, -100.0])
    assert loads[ORBITING_SCROLL][:2, 0] == pytest.approx([-500.0, 100.0])


def test_brake_pushes_at_its_own_height():
    """95 mm above the shaft's origin."""
    machine = load_study(PIPELINES / "copeland_derived.toml").machine
    assert _height_of_brake(machine) == pytest.approx(0.095)


@pytest.mark.parametrize("step_s", [1e-3, 1e-4, 1e-6])
def test_valve_gives_its_momentum(step_s):
    """It flies with √(2 F s/m); impact and flight cancel over any steps."""
    disc = valve(mass_kg=0.01, lift_m=4e-3, closing_force_n=20.0)
    time = np.arange(-0.005, 0.05, step_s)
    force = closing_force_n(disc, time)
    struck = -np.sum(force[force < 0.0]) * step_s
    assert flight_s(disc) == pytest.approx(2e-3)
    if step_s == 1e-6:
        assert struck == pytest.approx(0.01 * np.sqrt(2.0 * 20.0 * 4e-3 / 0.01), rel=1e-3)
        assert force.max() == pytest.approx(20.0)
    assert abs(force.sum() * step_s) < 1e-12


def test_valve_is_on_its_seat_for_half_a_period():
    """From first contact to the return of a mass on its seat's spring, integrated in time."""
    disc = valve(mass_kg=0.01, seat_stiffness_n_per_m=2e6)

    def moved(_, state):
        return [state[1], -disc.seat_stiffness_n_per_m / disc.mass_kg * state[0]]

    def leaves(_, state):
        return state[0]

    leaves.terminal, leaves.direction = True, -1.0
    found = solve_ivp(moved, (0.0, 0.1), [0.0, 1.0], events=leaves, rtol=1e-10, atol=1e-14)
    ((contact_s,),) = found.t_events
    assert closing_time_s(disc) - flight_s(disc) == pytest.approx(contact_s, rel=1e-6)
    time = np.arange(0.0, 2.0 * closing_time_s(disc), 1e-6)
    acting = time[closing_force_n(disc, time) < 0.0]
    assert np.ptp(acting) == pytest.approx(contact_s, abs=2e-6)  # two steps


# --- in the chain --------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def study():
    study = load_study(SOURCES_STUDY)
    fewer = {f"options.{name}": None for name in study.options if name != "none"}
    small = {"sources.keys": None, "uncertainty.random_samples": 4}
    return study.replace({**fewer, **small, **TURNS})


@pytest.fixture(scope="module")
def results(study):
    return run_made_up(study.model_copy(update={"ranges": ()}), gain=0.2)


def test_sound_goes_through_the_shell(study, results):
    """Before switch-off it is that of gas and moving parts; the jam is louder than all."""
    machine, body = study.machine, on_mounts(study.machine)
    plain = study.replace({"operation.turning_back": False})
    before = stopping_variables(plain, machine, body, results)
    steady, jammed = results["stopping_fast_maximum_level"].sel(receiver="front_1m").values[:, 0]
    weighted = results["source_level"].sel(option="none", sound_source="gas", receiver="front_1m")
    assert steady == pytest.approx(weighted.item(), abs=0.5)
    assert jammed > steady + 10.0
    assert before["stopping_fast_maximum_level"].sel(receiver="front_1m").values[0, 0] < steady
    assert "stopping_brake_force" not in before
    assert results["stopping_turned_back_angle"].item() > np.radians(4.9)
    for name in ("stopping_revolutions", "stopping_foot_force"):
        assert results[name].values[..., 0].flat[0] == pytest.approx(
            before[name].values[..., 0].flat[0], rel=1e-3
        )


def test_report_says_what_it_holds(results):
    text = " ".join(sentences(results))
    assert "turns the shaft back by 5" in text
    assert "gas that flows" not in text


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"operation.stopping": False}, "turning_back: needs operation.stopping"),
        ({"machine.turning_back.free_angle_deg": -1.0}, "free_angle_deg"),
    ],
)
def test_bad_input(study, values, message):
    with pytest.raises(ParameterError, match=message):
        study.replace(values)
