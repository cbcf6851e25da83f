"""Induction motors: published examples, closed forms, the motor simulated in time."""

import csv
from types import SimpleNamespace

import numpy as np
import pytest
from documents import FITZGERALD
from evidence import claim
from hypothesis import given, settings
from hypothesis import strategies as st
from kloss import KlossMotor, slip_at_torque, slope_ratio, torque
from machine_files import machine_file, values_of
from scipy.integrate import solve_ivp
from support import ROOT

from vibroacoustics.base.errors import ParameterError, SolverError
from vibroacoustics.mechanics.crankshaft import steady_rotation
from vibroacoustics.mechanics.ports import HOUSING
from vibroacoustics.mechanics.rotation import uniform_crank_angle
from vibroacoustics.sources import motor as motor_source
from vibroacoustics.sources.induction_motor.revolving_fields import (
    CapacitorMotor,
    breakdown_slip,
    field_impedance,
    on_supply,
    operating_point,
    point_at_torque,
    supply_frequency_hz,
)
from vibroacoustics.sources.induction_motor.torque_lines import (
    TorqueLine,
    rotor_in_motor,
    speed_response,
    torque_lines,
    two_axis_motor,
)
from vibroacoustics.sources.motor import MotorPulsation

VALUES = values_of(machine_file("copeland_zp41k3e"))["motor"]
MOTOR = CapacitorMotor(**VALUES)
INERTIA = 2.5e-3
GAS_TORQUE = 10.24
"""Mean of the scroll's gas torque, N m (data/validation/scroll_gas.csv)."""
ROOT2 = np.sqrt(2.0)


def lines_under(motor, inertia_kg_m2, load_order_n_m):
    """Of a load's mean and its orders, N m."""
    mean, *ripple = load_order_n_m
    rotor = rotor_in_motor(motor, inertia_kg_m2, mean)
    return torque_lines(rotor, np.array(ripple, dtype=complex))


def changed(motor=MOTOR, **values) -> CapacitorMotor:
    return motor.model_copy(update=values)


def fitzgerald_9_5() -> CapacitorMotor:
    """Two-pole motor with a run capacitor, by its inductances; any referral of the rotor does."""
    omega, main, auxiliary, rotor = 2.0 * np.pi * 60.0, 0.0806, 0.196, 4.7e-6
    referral = np.sqrt(main / rotor)
    ratio = 0.909 / 0.588
    magnetising = omega * referral * 0.588e-3
    return CapacitorMotor(
        line_voltage_v=230.0,
        line_frequency_hz=60.0,
        pole_pairs=1,
        main_resistance_ohm=0.58,
        main_leakage_ohm=omega * main - magnetising,
        auxiliary_resistance_ohm=3.37,
        auxiliary_leakage_ohm=omega * auxiliary - ratio**2 * magnetising,
        magnetising_ohm=magnetising,
        rotor_resistance_ohm=referral**2 * 37.6e-6,
        rotor_leakage_ohm=omega * referral**2 * rotor - magnetising,
        turns_ratio=ratio,
        capacitance_f=35e-6,
    )


def fitzgerald_9_2() -> CapacitorMotor:
    """Quarter-horsepower motor whose auxiliary winding is open: behind next to no capacitance."""
    return changed(
        line_voltage_v=110.0,
        line_frequency_hz=60.0,
        pole_pairs=2,
        main_resistance_ohm=2.02,
        main_leakage_ohm=2.79,
        magnetising_ohm=66.8,
        rotor_resistance_ohm=4.12,
        rotor_leakage_ohm=2.12,
        capacitance_f=1e-15,
    )


def published(example):
    with (ROOT / "data" / "validation" / "induction_motor.csv").open(encoding="utf-8") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        return {
            row["quantity"]: (float(row["value"]), float(row["tolerance"]))
            for row in rows
            if row["example"] == example
        }


UNITS = {"phase": "deg", "factor": "1", "power": "W"}


def assert_published(example, found):
    printed = published(example)
    assert printed.keys() == found.keys()
    for quantity, (value, tolerance) in printed.items():
        unit = next((unit for word, unit in UNITS.items() if word in quantity), "A")
        claim(
            f"Motor of example {example}: {quantity}", kind="printed", unit=unit, reference=value,
            source=FITZGERALD(f"example {example}, quoted from memory"), computed=found[quantity],
            tolerance=tolerance, topics=("torque-ripple",),
        )  # fmt: skip


# --- published -----------------------------------------------------------------------------------


def test_run_capacitor_motor_of_the_book():
    point = operating_point(fitzgerald_9_5(), 1.0 / 36.0)
    main, auxiliary = point.main_current_a, -point.auxiliary_current_a
    line = point.main_current_a + point.auxiliary_current_a
    found = {}
    for name, current in (("main", main), ("auxiliary", auxiliary), ("line", line)):
        found[f"{name} current"] = abs(current) / ROOT2
        found[f"phase of {name} current"] = np.rad2deg(np.angle(current))
    assert_published("9.5", found)


def test_single_phase_motor_of_the_book():
    motor = fitzgerald_9_2()
    point = operating_point(motor, 0.05)
    speed = 0.95 * motor.synchronous_speed_rad_per_s
    # The book takes mechanical power as (1 - s) times the difference of the air-gap powers.
    found = {
        "stator current": abs(point.main_current_a) / ROOT2,
        "power factor": np.cos(np.angle(point.main_current_a)),
        "mechanical power": point.torque_n_m * speed,
    }
    assert_published("9.2", found)


# --- invariants ----------------------------------------------------------------------------------

slips = st.floats(0.001, 1.0)


@given(slips)
def test_power_closes(slip):
    """Line power = copper of both windings and the rotor + mechanical power."""
    point = operating_point(MOTOR, slip)
    fields = ((point.forward_current_a, slip), (point.backward_current_a, 2.0 - slip))
    gap = [abs(i) ** 2 * field_impedance(MOTOR, s).real for i, s in fields]
    copper = 0.5 * MOTOR.main_resistance_ohm * abs(point.main_current_a) ** 2
    copper += 0.5 * MOTOR.auxiliary_resistance_ohm * abs(point.auxiliary_current_a) ** 2
    rotor = sum(s * power for power, (_, s) in zip(gap, fields, strict=True))
    mechanical = point.torque_n_m * MOTOR.synchronous_speed_rad_per_s * (1.0 - slip)
    assert copper + rotor + mechanical == pytest.approx(point.input_power_w, rel=1e-12)


@given(st.floats(0.001, 0.9))
def test_open_auxiliary_winding(slip):
    """Equal fields: no torque at rest, and a torque that pulsates by more than its mean."""
    point = operating_point(changed(capacitance_f=1e-15), slip)
    assert abs(point.forward_current_a) == pytest.approx(abs(point.backward_current_a), rel=1e-9)
    assert abs(point.pulsating_torque_n_m) > abs(point.torque_n_m)
    at_rest = operating_point(changed(capacitance_f=1e-15), 1.0)
    assert abs(at_rest.torque_n_m) < 1e-9 * abs(point.pulsating_torque_n_m)


def test_balanced_fields_do_not_pulsate():
    """Equal windings and the capacitance that turns the current by a quarter: no backward field.

    Then (R + jX + Z_f) j = R + jX + Z_f - jX_c: resistance equals reactance, and X_c is their sum.
    """
    ohm = 2.0
    motor = changed(
        turns_ratio=1.0,
        main_resistance_ohm=ohm,
        auxiliary_resistance_ohm=ohm,
        main_leakage_ohm=1.0,
        auxiliary_leakage_ohm=1.0,
    )

    def excess(slip):
        z = ohm + 1j + field_impedance(motor, slip)
        return z.real - z.imag

    low, high = 0.01, 0.04
    assert excess(low) * excess(high) < 0.0
    for _ in range(100):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if excess(low) * excess(middle) > 0.0 else (low, middle)
    reactance = 2.0 * (ohm + field_impedance(motor, low).real)
    motor = changed(motor, capacitance_f=1.0 / (motor.line_rad_per_s * reactance))
    point = operating_point(motor, low)
    assert abs(point.backward_current_a) < 1e-12 * abs(point.forward_current_a)
    assert abs(point.pulsating_torque_n_m) < 1e-12 * point.torque_n_m


@settings(max_examples=20)
@given(st.floats(1.0, 20.0))
def test_slip_carries_the_load(load):
    point = point_at_torque(MOTOR, load)
    assert point.torque_n_m == pytest.approx(load, rel=1e-10)
    assert 0.0 <= point.slip <= breakdown_slip(MOTOR)


def test_speed_of_the_thesis():
    """The rotor's resistance is chosen for 2900 rpm at the gas torque, to two digits: 3 rpm."""
    speed = 3000.0 * (1.0 - point_at_torque(MOTOR, GAS_TORQUE).slip)
    assert speed == pytest.approx(2900.0, abs=3.0)


# --- second methods ------------------------------------------------------------------------------


@given(slips)
def test_two_axis_equations_give_the_revolving_fields(slip):
    point, axes = operating_point(MOTOR, slip), two_axis_motor(MOTOR)
    states = axes.steady_states(MOTOR.synchronous_speed_rad_per_s * (1.0 - slip))
    mean = 0.5 * (states.conj() @ axes.torque_form @ states).real
    pulsating = 0.5 * states @ axes.torque_form @ states
    size = abs(point.pulsating_torque_n_m) + abs(point.torque_n_m)
    # Condition of the five equations: 1e3 (volts beside volt seconds).
    assert mean == pytest.approx(point.torque_n_m, abs=1e-11 * size)
    assert abs(pulsating - point.pulsating_torque_n_m) < 1e-11 * size


@pytest.mark.parametrize("slip", [0.005, 0.033, 0.1])
def test_slow_swing_follows_the_torque_curve(slip):
    """At no frequency the response is the slope over speed of mean and pulsating torque.

    Central differences over 2h of a curve that bends over 0.05 of slip: (h/0.05)² = 4e-6.
    """
    step, synchronous = 1e-4, MOTOR.synchronous_speed_rad_per_s
    slow, fast = (operating_point(MOTOR, slip + sign * step) for sign in (1.0, -1.0))
    response = speed_response(two_axis_motor(MOTOR), synchronous * (1.0 - slip), 0.0)
    span = 2.0 * step * synchronous
    slope = (fast.torque_n_m - slow.torque_n_m) / span
    assert response.direct == pytest.approx(slope, rel=1e-5)
    modulation = (fast.pulsating_torque_n_m - slow.pulsating_torque_n_m) / span
    assert response.upper + response.lower == pytest.approx(modulation, rel=1e-5)


def simulated_lines(ripple, inertia, names):
    """Motor torque and roll moment by least squares from the motor simulated in time."""
    axes = two_axis_motor(MOTOR)
    expected = lines_under(MOTOR, inertia, [GAS_TORQUE, ripple])

    def load(angle):
        return GAS_TORQUE + ripple * np.cos(angle)

    def slopes(time, y):
        voltage = axes.voltage_v * np.cos(axes.line_rad_per_s * time)
        flux = axes.at_rest @ y[:5] + y[5] * (axes.per_speed @ y[:5]) + axes.input_vector * voltage
        turning = (y[:5] @ axes.torque_form @ y[:5] - load(y[6])) / inertia
        return np.concatenate([flux, [turning, y[5]]])

    start = np.append(
        axes.steady_states(expected.speed_rad_per_s).real, [expected.speed_rad_per_s, 0.0]
    )
    times = np.linspace(0.4, 1.0, 6001)
    solution = solve_ivp(slopes, (0.0, 1.0), start, "DOP853", times, rtol=1e-7, atol=1e-8)
    states, angle = solution.y[:5], solution.y[6]
    motor = np.einsum("it,ij,jt->t", states, axes.torque_form, states)
    turn, first = np.polyfit(times, angle, 1)
    line = 2.0 * axes.line_rad_per_s * times
    phases = [line * names[n][0] + (turn * times + first) * names[n][1] for n in names]
    basis = np.stack([np.ones_like(times), *(f(p) for p in phases for f in (np.cos, np.sin))], -1)
    fits = np.linalg.lstsq(basis, np.stack([motor, load(angle) - motor], -1), rcond=None)[0]
    phasors = fits[1::2] - 1j * fits[2::2]
    return expected, dict(zip(names, phasors, strict=True))


LINES = {  # share of twice the line frequency, order
    "order 1": (0, 1), "2 x line": (1, 0), "4 x line": (2, 0), "2 x line + order 1": (1, 1),
    "2 x line - order 1": (1, -1), "order 2": (0, 2), "6 x line": (3, 0), "4 x line + 1": (2, 1),
}  # fmt: skip


@pytest.mark.parametrize("inertia", [INERTIA, 10.0 * INERTIA])
def test_lines_of_the_motor_simulated_in_time(inertia):
    """Nothing linear in the simulation; what the lines leave out is of second order.

    The swing that makes the 4 x line torque of the 2 x line torque acts twice: a share (T4/T2)² of
    each line. It also makes a mean torque, which shifts the speed and with it the 2 x line torque.
    """
    expected, found = simulated_lines(0.725, inertia, LINES)
    lines = {ln.name: ln for ln in (*expected.shaft, *expected.line, *expected.sidebands)}
    twice, fourth = (lines[name] for name in ("2 x line", "4 x line"))
    axes, line = two_axis_motor(MOTOR), 2.0 * MOTOR.line_rad_per_s
    still = speed_response(axes, expected.speed_rad_per_s, 0.0)
    mean = speed_response(axes, expected.speed_rad_per_s, line).lower * twice.speed_swing_rad_per_s
    drift = abs(mean / still.direct * (still.upper + still.lower) / twice.motor_torque_n_m)
    share = abs(fourth.motor_torque_n_m / twice.motor_torque_n_m) ** 2 + drift
    for name in ("order 1", "2 x line", "4 x line"):
        predicted = [lines[name].motor_torque_n_m, lines[name].roll_moment_n_m]
        assert np.abs(found[name] - predicted).max() < share * np.abs(predicted).max(), name
    # The load's crank angle swings by Ω/ω: half the ripple times that is in the sidebands.
    load = 0.5 * 0.725 * abs(twice.speed_swing_rad_per_s) / line
    upper = abs(lines["2 x line + order 1"].motor_torque_n_m)
    for name in ("2 x line + order 1", "2 x line - order 1"):
        predicted = [lines[name].motor_torque_n_m, lines[name].roll_moment_n_m]
        assert np.abs(found[name] - predicted).max() < share * upper + load, name


def test_lines_balance():
    """Roll moment = reaction of the motor + reaction of the load = -J dΩ/dt, line by line."""
    ripple = [0.725 + 0.1j, 0.2j, 0.075, 0.052]
    lines = lines_under(MOTOR, INERTIA, [GAS_TORQUE, *ripple])
    loads = [*ripple, *[0.0] * (len(lines.line) + len(lines.sidebands))]
    for line, load in zip((*lines.shaft, *lines.line, *lines.sidebands), loads, strict=True):
        assert line.roll_moment_n_m == pytest.approx(load - line.motor_torque_n_m, abs=1e-12)
        inertia = -2j * np.pi * line.frequency_hz * INERTIA * line.speed_swing_rad_per_s
        assert line.roll_moment_n_m == pytest.approx(inertia, rel=1e-12)


def test_twice_line_frequency_is_no_shaft_order():
    lines = lines_under(MOTOR, INERTIA, [GAS_TORQUE, 0.725, 0.201])
    shaft = lines.speed_rad_per_s / (2.0 * np.pi)
    assert [line.frequency_hz for line in lines.shaft] == pytest.approx([shaft, 2.0 * shaft])
    assert [line.frequency_hz for line in lines.line] == [100.0, 200.0]
    assert 100.0 - lines.shaft[1].frequency_hz == pytest.approx(3.3, abs=0.1)
    # Twice the slip frequency of the rotor: the beat that an ear hears.
    beat = {line.name: line for line in lines.sidebands}["2 x line - order 2"]
    assert beat.frequency_hz == pytest.approx(2.0 * 50.0 * lines.operating_point.slip, rel=1e-9)


def test_infinite_inertia_keeps_the_speed():
    lines = lines_under(MOTOR, 1e9, [GAS_TORQUE, 0.725])
    pulsating = lines.operating_point.pulsating_torque_n_m
    assert lines.line[0].motor_torque_n_m == pytest.approx(pulsating, rel=1e-9)
    assert lines.shaft[0].roll_moment_n_m == pytest.approx(0.725, rel=1e-9)
    assert max(abs(line.motor_torque_n_m) for line in lines.sidebands) < 1e-9


def test_shaft_orders_of_the_rotation_over_crank_angle():
    """Eksergian's equation at constant motor torque: the motor's answer is what it leaves out."""
    load = GAS_TORQUE + 0.725 * np.cos(uniform_crank_angle(64))
    lines = lines_under(MOTOR, INERTIA, [GAS_TORQUE, 0.725])
    still = np.zeros(64)
    rotation = steady_rotation(still + INERTIA, still, load, lines.speed_rad_per_s, 0.0)
    roll = -INERTIA * np.fft.rfft(rotation.acceleration_rad_per_s2)[1] / 32.0
    speed = lines.speed_rad_per_s
    response = speed_response(two_axis_motor(MOTOR), speed, speed).direct
    stiff = 1.0 - response / (1j * speed * INERTIA)
    assert lines.shaft[0].roll_moment_n_m * stiff == pytest.approx(roll, rel=1e-9)
    assert abs(stiff - 1.0) < 0.1


# --- Kloss ---------------------------------------------------------------------------------------

KLOSS = KlossMotor(
    synchronous_speed_rad_per_s=100.0 * np.pi, breakdown_torque_n_m=25.0, breakdown_slip_ratio=0.12
)


@given(st.floats(1e-6, 25.0))
def test_slip_of_kloss_torque(load):
    """Back to the torque; at breakdown the slip goes as the root of what is missing: 1e-8."""
    slip = slip_at_torque(KLOSS, load)
    assert 0.0 < slip <= 0.12
    assert torque(KLOSS, slip) == pytest.approx(load, rel=1e-12)


@pytest.mark.parametrize("slip", [0.005, 0.03, 0.119])
def test_kloss_is_the_circuit_without_stator_resistance(slip):
    """Balanced feed: T = R_f |I|²/Ω_s, s_k = R_2/(X_th + X_2), T_k = V_th²/2Ω_s(X_th + X_2)."""
    x_main, x_m = MOTOR.main_leakage_ohm, MOTOR.magnetising_ohm
    voltage = ROOT2 * 230.0
    forward = field_impedance(MOTOR, slip)
    exact = forward.real * abs(voltage / (1j * x_main + forward)) ** 2
    exact /= MOTOR.synchronous_speed_rad_per_s
    short = x_main * x_m / (x_main + x_m) + MOTOR.rotor_leakage_ohm
    open_voltage = voltage * x_m / (x_main + x_m)
    kloss = KlossMotor(
        synchronous_speed_rad_per_s=MOTOR.synchronous_speed_rad_per_s,
        breakdown_torque_n_m=open_voltage**2 / (2.0 * MOTOR.synchronous_speed_rad_per_s * short),
        breakdown_slip_ratio=MOTOR.rotor_resistance_ohm / short,
    )
    assert torque(kloss, slip) == pytest.approx(exact, rel=1e-12)


def test_slope_of_kloss_torque():
    slip, step = slip_at_torque(KLOSS, GAS_TORQUE), 1e-6
    slope = (torque(KLOSS, slip - step) - torque(KLOSS, slip + step)) / (2.0 * step)
    assert slope_ratio(KLOSS, slip) == pytest.approx(slope * (1.0 - slip) / GAS_TORQUE, rel=1e-6)


def test_speed_fluctuation_of_a_stiff_motor_on_a_light_rotor():
    """Against the rotor with the whole Kloss curve, integrated in time to the steady state."""
    slip = slip_at_torque(KLOSS, GAS_TORQUE)
    speed = KLOSS.synchronous_speed_rad_per_s * (1.0 - slip)
    angle = uniform_crank_angle(256)
    load = GAS_TORQUE + 0.725 * np.cos(angle)
    inertia = np.full_like(angle, INERTIA)
    found = steady_rotation(inertia, 0.0 * angle, load, speed, slope_ratio(KLOSS, slip))

    def slopes(_, y):
        motor = torque(KLOSS, 1.0 - y[0] / KLOSS.synchronous_speed_rad_per_s)
        return (motor - GAS_TORQUE - 0.725 * np.cos(y[1])) / INERTIA, y[0]

    times = np.linspace(0.5, 0.7, 20001)
    swing = solve_ivp(slopes, (0.0, 0.7), (speed, 0.0), "DOP853", times, rtol=1e-10, atol=1e-10)
    # The torque's line bends over the swing: 0.15 % of slip against 9 % up to breakdown.
    ratio = np.ptp(swing.y[0]) / np.mean(swing.y[0])
    assert found.fluctuation_ratio == pytest.approx(ratio, rel=0.02)
    assert found.fluctuation_ratio < 0.9 * 2.0 * 0.725 / (INERTIA * speed**2)  # the motor damps


# --- bad input -----------------------------------------------------------------------------------


@pytest.mark.parametrize("load", [40.0, -5.0, float("nan")])
def test_load_beyond_the_motor(load):
    with pytest.raises(
        ParameterError, match=r"torque = .* between synchronous speed and breakdown"
    ):
        lines_under(MOTOR, INERTIA, [load, 0.7])


@pytest.mark.parametrize(
    ("name", "value"),
    [("capacitance_f", 0.0), ("main_resistance_ohm", -1.0), ("pole_pairs", 0),
     ("line_frequency_hz", float("nan"))],
)  # fmt: skip
def test_motor_that_cannot_be(name, value):
    with pytest.raises(ValueError, match=name):
        CapacitorMotor(**{**VALUES, name: value})


def test_rotation_that_does_not_converge():
    angle = uniform_crank_angle(64)
    with pytest.raises(SolverError, match="motor_slope_ratio = 40"):
        steady_rotation(np.ones(64), np.zeros(64), 20.0 + 15.0 * np.sin(angle), 10.0, 40.0)


# --- the supply that a speed needs ---------------------------------------------------------------


@pytest.mark.parametrize("speed_rpm", [1500.0, 2900.0, 3500.0])
@pytest.mark.parametrize("load_n_m", [2.0, GAS_TORQUE])
def test_supply_gives_back_the_speed_through_the_torque_curve(speed_rpm, load_n_m):
    supply = supply_frequency_hz(MOTOR, speed_rpm, load_n_m)
    motor = on_supply(MOTOR, supply)
    slip = point_at_torque(motor, load_n_m).slip
    assert slip > 0.0
    assert 60.0 * supply / MOTOR.pole_pairs * (1.0 - slip) == pytest.approx(speed_rpm, rel=1e-10)
    lines = lines_under(motor, INERTIA, [load_n_m, 1.0])
    assert lines.speed_rad_per_s == pytest.approx(2.0 * np.pi * speed_rpm / 60.0, rel=1e-10)


def test_supply_of_the_rated_speed_is_the_rated_one():
    slip = point_at_torque(MOTOR, GAS_TORQUE).slip
    speed_rpm = 3000.0 * (1.0 - slip)
    assert supply_frequency_hz(MOTOR, speed_rpm, GAS_TORQUE) == pytest.approx(50.0, rel=1e-10)
    assert on_supply(MOTOR, 50.0) == MOTOR


def test_motor_at_the_same_flux_draws_the_same_current_at_the_same_frequency_of_the_rotor():
    """Twice the supply, half the slip: voltage and impedance of the field are doubled."""
    doubled = on_supply(MOTOR, 100.0)
    assert doubled.line_voltage_v == 2.0 * MOTOR.line_voltage_v
    assert field_impedance(doubled, 0.01) == pytest.approx(2.0 * field_impedance(MOTOR, 0.02))


def test_load_beyond_breakdown_has_no_supply():
    with pytest.raises(ParameterError, match=r"torque = 500 N m: the motor gives .* at 2900 rpm"):
        supply_frequency_hz(MOTOR, 2900.0, 500.0)


def test_sidebands_below_a_ten_thousandth_of_the_largest_line_are_omitted(monkeypatch):
    """Lines themselves stay, however weak; a sideband below `LOWEST_LINE_HZ` is no sound."""
    torques = {"2 x line": (100.0, 2.0), "4 x line": (200.0, 1e-9)}
    beside = {"kept": (70.0, 2.1e-4), "weak": (130.0, 1.9e-4), "low": (9.0, 1.0)}
    lines, sidebands = (
        tuple(TorqueLine(name, hertz, torque, torque, 0.0) for name, (hertz, torque) in one.items())
        for one in (torques, beside)
    )
    balance = SimpleNamespace(line=lines, sidebands=sidebands)
    monkeypatch.setattr(motor_source, "_balance", lambda case, before: balance)
    machine = SimpleNamespace(mechanism_port=HOUSING)
    case = SimpleNamespace(machine=machine, maximum_frequency_hz=1000.0)
    tones = MotorPulsation().loads(case, {}).tones
    assert [tone.name for tone in tones] == ["2 x line", "4 x line", "kept"]
