"""Run-down after switch-off: closed forms, conservation of momentum and energy, order map."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from machine_files import machine_file, values_of
from support import CRANK_ANGLE, PIPELINES, machine_parts

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.machine.stopping import Stopping
from vibroacoustics.mechanics.moving_parts import (
    MovingPart,
    derivative,
    path,
    wrench,
)
from vibroacoustics.mechanics.rotation import constant_rotation
from vibroacoustics.orders import angular_resample, block_phasors, from_angle, order_map
from vibroacoustics.stopping.coasting import peaks, run_down
from vibroacoustics.stopping.equation import (
    brake_shift,
    inertia_over_angle,
    path_derivatives,
    wrench_along,
)
from vibroacoustics.study.loading import load_study

FILE = values_of(machine_file("copeland_zp41k3e"))["stopping"]
VALUES = {**FILE, "friction_torque_n_m": 1.5}
"""With more friction than the file assumes: shorter runs."""
PARTS = machine_parts(load_study(PIPELINES / "copeland_derived.toml"))
SHIFTED = ("orbiting_scroll", "brake", "oldham")
SPEED = 2900.0 * np.pi / 30.0
GAS = 10.24 + 0.725 * np.cos(CRANK_ANGLE) + 0.201 * np.cos(2.0 * CRANK_ANGLE)
"""Scroll's gas torque, N m (data/validation/scroll_gas.csv; phases made up)."""
NO_GAS = np.zeros(8)
RATE_HZ = 20000.0


def residual_force_n(mass_moment_kg_m, shift_rad, speed_rad_per_s):
    """Force of balanced masses after one side has turned by δ, 2 m e sin(δ/2) ω²."""
    return 2.0 * mass_moment_kg_m * abs(np.sin(0.5 * shift_rad)) * speed_rad_per_s**2


def stopping(**values) -> Stopping:
    return Stopping(**{**VALUES, **values})


def stopped(parts=PARTS, shifted=SHIFTED, gas=GAS, speed=SPEED, steady=0, **values):
    return run_down(stopping(**values), parts, shifted, gas, speed, RATE_HZ, steady)


def of_source(result, source):
    at = result.sources.index(source)
    return result.force_n[at], result.moment_n_m[at]


def without(source):
    return [part for part in PARTS if part.source != source]


# --- closed forms --------------------------------------------------------------------------------


def test_constant_drag_makes_the_angle_quadratic():
    """θ = Ω0 t - ½ α t², α = T/J; stops after Ω0/α. Circling parts have a constant inertia."""
    parts = without("oldham")
    result = stopped(parts, SHIFTED[:2], NO_GAS, shift_rad=0.0)
    inertia = VALUES["shaft_inertia_kg_m2"] + inertia_over_angle(parts, np.zeros(1))[0]
    slowing, time = VALUES["friction_torque_n_m"] / inertia, result.time_s
    assert result.stop_time_s == pytest.approx(SPEED / slowing, rel=1e-9)
    exact = SPEED * time - 0.5 * slowing * time**2
    # Steps of fourth order are exact for parabolas: rounding of some 1e5 steps to 442 rad.
    assert result.crank_angle_rad == pytest.approx(exact, abs=1e-9)
    assert result.speed_rad_per_s == pytest.approx(SPEED - slowing * time, abs=1e-9)
    assert result.acceleration_rad_per_s2 == pytest.approx(-slowing, rel=1e-9)
    roll = result.moment_n_m[:, 2].sum(axis=0)
    # Force times the rounding of places, in the cross product: 400 N times 3 mm times 1e-12.
    assert roll == pytest.approx(VALUES["friction_torque_n_m"], rel=1e-8)


def test_viscous_drag_makes_the_speed_exponential():
    """Ω = (Ω0 + T/c) exp(-c t/J) - T/c."""
    parts, drag = without("oldham"), 1e-3
    result = stopped(parts, (), NO_GAS, shift_rad=0.0, viscous_torque_n_m_s=drag)
    inertia = VALUES["shaft_inertia_kg_m2"] + inertia_over_angle(parts, np.zeros(1))[0]
    rest = VALUES["friction_torque_n_m"] / drag
    exact = (SPEED + rest) * np.exp(-drag / inertia * result.time_s) - rest
    # Steps of 0.05 ms over a time constant of 2.7 s, each (c h/J)⁵/120 of the speed.
    assert result.speed_rad_per_s == pytest.approx(exact, abs=1e-9)


def test_steady_running_is_that_of_constant_speed():
    """Before switch-off force and moment are those of the moving parts at their crank angle."""
    result = stopped(steady=3)
    before = result.time_s < 0.0
    assert result.time_s[0] == pytest.approx(-3.0 / (SPEED / (2.0 * np.pi)), abs=1.0 / RATE_HZ)
    rotating, _ = wrench(PARTS, constant_rotation(2900.0, CRANK_ANGLE.size))
    angle = result.crank_angle_rad[before]
    force = result.force_n.sum(axis=0)[:, before]
    exact = path_derivatives(rotating, angle)[0]
    assert np.abs(force - exact).max() < 1e-6 * np.abs(exact).max()


@given(st.floats(-0.5, 0.5), st.floats(50.0, 400.0))
def test_residual_of_a_turned_set(shift, speed):
    """Phasor addition: |e^{jδ} - 1| = 2 sin(δ/2), against a mass and its counterweight."""
    mass, radius = 1.25, 3.461e-3
    angle = np.linspace(0.0, 6.0, 7)
    still = np.full_like(angle, speed), np.zeros_like(angle)
    circle = path(radius * np.cos(CRANK_ANGLE), radius * np.sin(CRANK_ANGLE), 0.1)
    part = MovingPart("set", mass, circle)
    weight = MovingPart("counterweight", mass, circle * np.array([[-1.0], [-1.0], [1.0]]))
    force = wrench_along(part, angle + shift, *still)[0] + wrench_along(weight, angle, *still)[0]
    expected = residual_force_n(mass * radius, shift, speed)
    # Rounding of the path's Fourier series, eps times the force of one part.
    rounding = 1e-13 * mass * radius * speed**2
    assert np.linalg.norm(force, axis=0) == pytest.approx(expected, abs=rounding)


def test_couple_after_the_shift_acts_at_the_set():
    """Balanced in two planes before; then force and couple are those of the turned set alone."""
    result = stopped(without("oldham"), SHIFTED[:2], NO_GAS, shift_duration_s=0.02)
    late = result.time_s > 0.021
    force, moment = result.force_n.sum(axis=0)[:, late], result.moment_n_m.sum(axis=0)[:, late]
    scroll, brake = (next(p for p in PARTS if p.source == name) for name in SHIFTED[:2])
    moments = [part.mass_kg * part.position_m[0, 0] for part in (scroll, brake)]
    heights = [part.position_m[2, 0] for part in (scroll, brake)]
    speed = result.speed_rad_per_s[late]
    expected = [residual_force_n(sum(moments), VALUES["shift_rad"], each) for each in speed]
    # Centrifugal force is all but the slowing's share (T/J)/Ω², which grows towards the stop.
    fast = speed > 0.2 * SPEED
    slowing = (VALUES["friction_torque_n_m"] / 2.5e-3 / (0.2 * SPEED) ** 2) ** 2
    found = np.linalg.norm(force, axis=0)
    assert found[fast] == pytest.approx(np.array(expected)[fast], rel=0.5 * slowing + 1e-9)
    height = np.dot(moments, heights) / sum(moments)
    tilting = np.linalg.norm(moment[:2], axis=0)
    assert tilting[fast] == pytest.approx(height * found[fast], rel=1e-9)


def test_shift_is_smooth_and_ends():
    time = np.linspace(-0.01, 0.03, 4001)
    shift = brake_shift(time, 0.1, 0.02)
    assert shift.angle[time <= 0.0] == pytest.approx(0.0)
    assert shift.angle[time >= 0.02] == pytest.approx(0.1)
    step = time[1] - time[0]
    # Central differences, error step²/6 times the third derivative 60 δ/duration³ (rate) and step
    # times the jump of the jerk where the turn starts and ends (acceleration).
    jerk = 60.0 * 0.1 / 0.02**3
    assert np.gradient(shift.angle, step)[1:-1] == pytest.approx(
        shift.rate[1:-1], abs=step**2 * jerk
    )
    rate = np.gradient(shift.rate, step)[1:-1]
    assert rate == pytest.approx(shift.acceleration[1:-1], abs=step * jerk)


# --- invariants ----------------------------------------------------------------------------------


def momentum(result, parts, shifted):
    """Linear and angular momentum of the moving parts and the rotor, shape (6, times)."""
    total = np.zeros((6, result.time_s.size))
    total[5] = VALUES["shaft_inertia_kg_m2"] * result.speed_rad_per_s
    for part in parts:
        turned = part.source in shifted
        angle = result.crank_angle_rad + turned * result.shift.angle
        place, slope, _ = path_derivatives(part.position_m, angle)
        linear = part.mass_kg * slope * (result.speed_rad_per_s + turned * result.shift.rate)
        total[:3] += linear
        total[3:] += np.cross(place, linear, axis=0)
    return total


@pytest.mark.parametrize("gas_share", [0.0, 1.0])
def test_housing_gets_the_momentum(gas_share):
    """Integral of force and moment over time = momentum lost, from switch-off to the stop."""
    result = stopped(gas_share_ratio=gas_share)
    pushed = np.concatenate([result.force_n.sum(axis=0), result.moment_n_m.sum(axis=0)])
    step = 1.0 / RATE_HZ
    pushed = step * (np.cumsum(pushed, axis=1) - 0.5 * (pushed + pushed[:, :1]))
    lost = momentum(result, PARTS, SHIFTED)
    lost = lost[:, :1] - lost
    # Trapezoidal rule: step²/12 times the change of the slope, at most that of a force F at ω, Fω,
    # or of the shift's, F/duration (T = 10 ms < 1/ω): a share (ω step)²/6 = 4e-5 of F/ω. A kink at
    # the shift's start and end adds step²/12 of its jerk, less.
    swing = np.abs(lost).max(axis=1)
    assert np.abs(pushed - lost).max(axis=1) == pytest.approx(0.0, abs=1e-3 * swing.max())
    assert np.abs(pushed[5] - lost[5]).max() < 1e-4 * swing[5]


@pytest.mark.parametrize("shifted", [SHIFTED, SHIFTED[:2]])
def test_energy_goes_into_the_drag(shifted):
    """Kinetic energy = gas work + friction work, with an Oldham ring in either set, no shift."""
    result = stopped(shifted=shifted, shift_rad=0.0)
    inertia = VALUES["shaft_inertia_kg_m2"] + inertia_over_angle(PARTS, result.crank_angle_rad)
    kinetic = 0.5 * inertia * result.speed_rad_per_s**2
    angle = result.crank_angle_rad
    work = 10.24 * angle + 0.725 * np.sin(angle) + 0.1005 * np.sin(2.0 * angle)
    work += VALUES["friction_torque_n_m"] * angle
    # Integration at 1e-9; a cubic spline of the torque over 256 angles, (2π/256)⁴ 2⁴/384 = 1e-8.
    assert kinetic + work == pytest.approx(kinetic[0], rel=1e-7)


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 2**31))
def test_any_path_at_constant_speed(seed):
    """Force along a random band-limited path = that of `moving_parts`, at its own angles."""
    generator = np.random.default_rng(seed)
    order = np.arange(1, 9)[:, None] * CRANK_ANGLE
    place = generator.standard_normal((3, 8)) @ np.cos(order)
    place += generator.standard_normal((3, 8)) @ np.sin(order) + generator.standard_normal((3, 1))
    part = MovingPart("part", 1.0, place)
    force, moment = wrench_along(part, CRANK_ANGLE, np.full(256, 100.0), np.zeros(256))
    exact = -(100.0**2) * derivative(place, 2)
    # The derivative multiplies rounding by 128²: 1e4 times 20 times 16384 times 2e-16 = 1e-6.
    assert force == pytest.approx(exact, abs=1e-5)
    assert moment == pytest.approx(np.cross(place, exact, axis=0), abs=2e-4)


# --- the thesis's machine ------------------------------------------------------------------------


def test_full_load_stops_within_two_revolutions():
    """½ J Ω² over the work of a revolution: 117 J against 66 J."""
    result = stopped()
    revolutions = result.crank_angle_rad[-1] / (2.0 * np.pi)
    inertia = VALUES["shaft_inertia_kg_m2"] + inertia_over_angle(PARTS, CRANK_ANGLE).mean()
    balance = 0.5 * inertia * SPEED**2 / ((10.24 + VALUES["friction_torque_n_m"]) * 2.0 * np.pi)
    # The ripple's work and the shift's, 1 J or so of 66.
    assert revolutions == pytest.approx(balance, abs=0.03)
    assert result.stop_time_s < 0.1


def test_set_does_not_overrun_under_load():
    """The gas holds the scroll against the pin: its drag is 5000 times the bound of an overrun."""
    inertia = 1.25 * 3.461e-3**2
    friction, shaft = FILE["friction_torque_n_m"], FILE["shaft_inertia_kg_m2"]
    bound = friction * inertia / shaft  # both coast freely and slow down alike
    assert bound == pytest.approx(1.8e-3, rel=0.01)
    assert GAS.min() > 5000.0 * bound


def test_peak_against_steady_running():
    """After the turn: Oldham ring 23.2 N and residual 34.7 N; during it the set's acceleration."""
    steady = peaks(*wrench(PARTS, constant_rotation(2900.0, CRANK_ANGLE.size)))
    slow, quick = (stopped(shift_duration_s=each).peaks for each in (0.04, 0.006))
    both = steady.force_n + residual_force_n(1.25 * 3.461e-3, VALUES["shift_rad"], SPEED)
    assert steady.force_n < slow.force_n < both
    assert quick.force_n > both
    assert steady.roll_moment_n_m < 1e-6 < slow.roll_moment_n_m


@pytest.mark.long
def test_order_map_of_the_run_down():
    """An unloaded machine: its first order follows (speed)² through the analysis."""
    result = stopped(gas=NO_GAS, shift_duration_s=0.02, friction_torque_n_m=0.3)
    motion = from_angle(result.time_s, result.crank_angle_rad)
    signal = angular_resample(result.force_n.sum(axis=0)[0], RATE_HZ, motion, 10.0)
    spectra = order_map(signal, 0.2)
    first = np.abs(block_phasors(signal, spectra, [1.0])[:, 0])
    speed = 2.0 * np.pi * spectra.shaft_frequency_hz
    late = (spectra.time_s > 0.1) & (speed > 0.2 * SPEED)
    ring = next(part for part in PARTS if part.source == "oldham")
    radius, shift = 3.461e-3, VALUES["shift_rad"]
    # Along x: the ring at the turned angle and the residual of scroll and brake.
    phasor = ring.mass_kg * np.exp(1j * shift) + 1.25 * (np.exp(1j * shift) - 1.0)
    expected = abs(phasor) * radius * speed**2
    # Over the crank angle the speed squared falls evenly, so that its windowed mean is that at the
    # middle angle; the block's speed, turns over time, is lower: Ω² (1 - s²/4), s = ΔΩ/Ω.
    inertia = VALUES["shaft_inertia_kg_m2"] + inertia_over_angle(PARTS, CRANK_ANGLE).mean()
    spread = 0.3 / inertia * 2.0 * np.pi * spectra.revolutions / speed**2
    found = first / expected - 1.0
    # Next term of that, and the middle of an even number of samples: half a sample beside it.
    allowed = spread**4 + 1.2 * spread / (spectra.revolutions * signal.samples_per_revolution)
    assert np.all(np.abs(found - 0.25 * spread**2)[late] < allowed[late] + 2e-5)
    assert late.sum() > 10


# --- bad input -----------------------------------------------------------------------------------


def test_unknown_source():
    with pytest.raises(ParameterError, match="shifted = scroll: no such moving part"):
        stopped(shifted=("scroll",))


@pytest.mark.parametrize("speed", [0.0, -1.0, float("nan"), float("inf")])
def test_speed_that_cannot_be(speed):
    with pytest.raises(ParameterError, match=r"speed = .* rpm: must be positive and finite"):
        stopped(speed=speed)


def test_shaft_that_does_not_stop():
    with pytest.raises(ParameterError, match="does not stop the shaft within 60 s"):
        stopped(without("oldham"), (), NO_GAS, friction_torque_n_m=1e-3)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"gas_share_ratio": 0.0, "friction_torque_n_m": 0.0}, "one must be above zero"),
        ({"shift_duration_s": 0.0}, "shift_duration_s"),
        ({"shift_rad": 2.0}, "shift_rad"),
        ({"shaft_inertia_kg_m2": float("nan")}, "shaft_inertia_kg_m2"),
    ],
)
def test_stopping_that_cannot_be(change, message):
    with pytest.raises(ValueError, match=message):
        stopping(**change)
