"""Synchronous motor on an inverter: torque orders, dead time, sidebands, and the source."""

import numpy as np
import pytest
from scipy.special import jv
from sources_study import case_of
from support import PIPELINES

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.machine.frame import STATOR
from vibroacoustics.mechanics.ports import HOUSING
from vibroacoustics.sources.cases import loaded_cases, loads_of
from vibroacoustics.sources.synchronous_motor.harmonics import (
    dead_time_voltage_v,
    operating_point,
    shaft_orders,
    torque_harmonics,
)
from vibroacoustics.sources.synchronous_motor.parameters import SynchronousMotor
from vibroacoustics.sources.synchronous_motor.switching import (
    BASEBAND,
    leg_harmonics,
    reference,
    sidebands,
)
from vibroacoustics.study.loading import load_study

SPEED = 2900.0 * np.pi / 30.0
ANGLE = 2.0 * np.pi * np.arange(4096) / 4096
THIRD = 2.0 * np.pi / 3.0


def motor(**values) -> SynchronousMotor:
    given = {"pole_pairs": 3, "slots": 9, "flux_linkage_vs": 0.152, "fifth_ratio": 0.03,
             "seventh_ratio": -0.02, "eleventh_ratio": 0.01, "thirteenth_ratio": 0.005,
             "phase_resistance_ohm": 0.6, "phase_inductance_h": 6e-3, "cogging_torque_n_m": 0.2,
             "cogging_second_ratio": 0.3, "dc_link_voltage_v": 540.0,
             "switching_frequency_hz": 4000.0, "modulation": "space-vector",
             "dead_time_s": 2e-6}  # fmt: skip
    return SynchronousMotor(**{**given, **values})


def of_phases(phasors):
    """Values of three phases over the electrical angle, each a third of a turn behind."""
    return np.array(
        [
            sum((v * np.exp(1j * k * (ANGLE - shift))).real for k, v in phasors.items())
            for shift in (0.0, THIRD, 2.0 * THIRD)
        ]
    )


# --- torque by order -----------------------------------------------------------------------------


def test_torque_is_the_power_of_three_phases():
    """(e_a i_a + e_b i_b + e_c i_c)/Ω over a turn, whatever the phases of the harmonics."""
    emf = {1: 100.0 + 0j, 5: 4.0 - 3.0j, 7: 2.0j, 11: -1.0 + 0j, 13: 0.5 + 0.2j}
    current = {1: 15.0 - 2.0j, 5: 0.3j, 7: -0.2 + 0.1j, 11: 0.1 + 0j, 13: 0.05j}
    power = (of_phases(emf) * of_phases(current)).sum(axis=0) / SPEED
    spectrum = np.fft.rfft(power) / ANGLE.size * 2.0
    spectrum[0] *= 0.5
    expected = torque_harmonics(emf, current, SPEED, 30)
    assert expected == pytest.approx(spectrum[:31], abs=1e-12)
    assert np.flatnonzero(np.abs(expected) > 1e-9).tolist() == [0, 6, 12, 18, 24]


def test_sixth_order_by_hand():
    """A fifth and a seventh of the voltage with a sine of current: 3 (E5 + E7) I/(2Ω)."""
    torque = torque_harmonics({1: 100.0, 5: 3.0, 7: -2.0}, {1: 15.0}, SPEED, 12)
    assert torque[0] == pytest.approx(1.5 * 100.0 * 15.0 / SPEED)
    assert torque[6] == pytest.approx(1.5 * (3.0 - 2.0) * 15.0 / SPEED)
    assert np.abs(torque[[1, 2, 3, 4, 5, 7, 8, 9, 10, 11, 12]]).max() == 0.0


def test_orders_of_the_shaft():
    """Six times the pole pairs, and the least common multiple of slots and poles."""
    given = motor(slots=12, pole_pairs=4, cogging_torque_n_m=0.1)
    orders = shaft_orders(given, operating_point(given, SPEED, 10.0), 60)
    assert np.flatnonzero(np.abs(orders) > 1e-9).tolist() == [0, 24, 48]
    quiet = motor(slots=12, fifth_ratio=0.0, seventh_ratio=0.0, eleventh_ratio=0.0,
                  thirteenth_ratio=0.0, dead_time_s=0.0)  # fmt: skip
    orders = shaft_orders(quiet, operating_point(quiet, SPEED, 10.0), 60)
    assert np.flatnonzero(np.abs(orders) > 1e-9).tolist() == [0, 12, 24]  # lcm(12, 6)
    assert np.abs(orders[[12, 24]]) == pytest.approx([0.2, 0.06])
    assert orders[0] == pytest.approx(10.0)


def test_mean_torque_is_carried_with_harmonics():
    given = motor()
    orders = shaft_orders(given, operating_point(given, SPEED, 7.3), 36)
    assert orders[0] == pytest.approx(7.3, rel=1e-12)


def test_dead_time_is_a_square_wave():
    lost = dead_time_voltage_v(motor())
    square = -540.0 * 2e-6 * 4000.0 * np.sign(np.cos(ANGLE + 0.5 * ANGLE[1]))
    spectrum = 2.0 * np.fft.rfft(square) / ANGLE.size
    for harmonic, volts in lost.items():
        assert volts == pytest.approx(spectrum[harmonic].real, abs=1e-4)


def test_voltage_that_the_inverter_lacks_is_refused():
    with pytest.raises(ParameterError, match=r"dc_link_voltage_v = 540 V.*6000 rpm.*needs"):
        operating_point(motor(), 6000.0 * np.pi / 30.0, 10.0)


# --- switching -----------------------------------------------------------------------------------


@pytest.mark.parametrize("carrier", [1, 2, 3])
def test_sine_has_bessels_coefficients(carrier):
    n = np.arange(-BASEBAND, BASEBAND + 1)
    exact = jv(n, 0.4 * np.pi * carrier) * np.sin(0.5 * np.pi * (carrier + n))
    exact *= 4.0 / (carrier * np.pi)
    assert leg_harmonics("sine", 0.8, carrier) == pytest.approx(exact, abs=1e-14)


@pytest.mark.parametrize("modulation", ["sine", "space-vector"])
def test_leg_is_that_of_compared_waves(modulation):
    """A triangle of 61 times the frequency, compared in time: lines are where m and n meet."""
    ratio, fine = 0.9, 1 << 18
    angle = 2.0 * np.pi * (np.arange(fine) + 0.5) / fine
    triangle = 1.0 - 2.0 / np.pi * np.arccos(np.cos(61.0 * angle))  # +1 at the pulse's middle
    pulses = np.where(reference(modulation, ratio, angle) > -triangle, 1.0, -1.0)
    lines = 2.0 * np.fft.rfft(pulses) / fine
    lines *= np.exp(-0.5j * np.arange(lines.size) * 2.0 * np.pi / fine)
    sizes = {m: leg_harmonics(modulation, ratio, m) for m in (1, 2, 3)}
    for line in (57, 59, 61, 65, 117, 121, 123, 127):
        every = sum(
            size[line - 61 * m + BASEBAND]
            for m, size in sizes.items()
            if abs(line - 61 * m) <= BASEBAND
        )
        assert lines[line] == pytest.approx(every, abs=1e-3), line


def test_sidebands_of_torque():
    """f_s ± 3 f_e and 2 f_s lead; every one is an odd or even multiple of three beside."""
    given = motor(modulation="sine", dead_time_s=0.0)
    point = operating_point(given, SPEED, 10.0)
    sides = {(s.carrier, s.electrical): s.torque_n_m for s in sidebands(given, point, 9000.0)}
    assert all(e % 6 == (3 if c % 2 else 0) for c, e in sides if abs(sides[c, e]) > 1e-9)
    leading = sorted(sides, key=lambda side: -abs(sides[side]))[:3]
    assert set(leading) == {(2, 0), (1, 3), (1, -3)}


def test_twice_the_carrier_by_hand():
    """A_21 forwards and A_2,-1 backwards both turn at 2 f_s in the field."""
    given = motor(modulation="sine", phase_resistance_ohm=1e-9, dead_time_s=0.0)
    point = operating_point(given, SPEED, 10.0)
    side = next(s for s in sidebands(given, point, 9000.0) if (s.carrier, s.electrical) == (2, 0))
    size = 0.5 * 540.0 * 2.0 / np.pi * jv(1, np.pi * point.modulation_ratio)
    switching, electrical = 2.0 * np.pi * 4000.0, point.electrical_rad_per_s
    turned = np.angle(point.voltage_v)
    current = size * sum(
        sign
        * np.sin(1.5 * np.pi)
        * np.exp(1j * n * turned)
        / (1j * (2 * switching + n * electrical) * 6e-3)
        for n, sign in ((1, 1.0), (-1, 1.0))
    )
    expected = 1.5 * abs(point.emf_v[1]) * current / SPEED
    assert side.torque_n_m == pytest.approx(expected, rel=1e-6)


# --- the source ----------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def study():
    values = {"operation.speed_rpm": [2900.0], "operation.maximum_order": 40, "sources.keys": None}
    return load_study(PIPELINES / "copeland_inverter.toml").replace(values)


def test_stator_gets_the_reaction_and_the_machine_the_rotor(study):
    """The mean stays inside; by order the stator has minus the motor's torque, and stator and
    load together are what turns the rotor."""
    case = case_of(study)
    loads = loads_of(study, case)
    motor_loads, load = loads["motor"], loads["gas"].shaft_torque_n_m
    on_stator = motor_loads.lines[STATOR][5]
    assert on_stator[0] == pytest.approx(-load[0])
    assert motor_loads.lines[HOUSING][5] == pytest.approx(load + on_stator)
    assert abs(on_stator[18]) > 0.3  # cogging and sixth of the electrical frequency
    assert abs(on_stator[1]) == 0.0
    assert set(motor_loads.lines) == {HOUSING, STATOR}
    current = 2.0 * load[0].real / (3.0 * 3.0 * 0.152)  # of a fundamental without harmonics
    assert motor_loads.figures["motor_phase_current_a"] == pytest.approx(current, rel=2e-3)
    tones = {tone.name: tone for tone in motor_loads.tones}
    lower = tones["1 x switching -3 x electrical"]
    assert lower.frequency_hz == pytest.approx(4000.0 - 3.0 * 3.0 * 2900.0 / 60.0)
    assert lower.loads[HOUSING][5] == pytest.approx(lower.loads[STATOR][5])


def test_supply_follows_the_speed(study):
    cases = {(2900.0, "none"): case_of(study)}
    supplied, _ = loaded_cases(study, cases)
    assert supplied[2900.0, "none"].supply_frequency_hz == pytest.approx(145.0)
    wrong = study.replace({"operation.supply_frequency_hz": [50.0]})
    with pytest.raises(ParameterError, match=r"supply_frequency_hz = 50 Hz.*145 Hz alone"):
        loads_of(wrong, case_of(wrong))


def test_machine_may_lack_the_motor(study, tmp_path):
    assert study.machine.motor is None
    text = (PIPELINES / "copeland_inverter.toml").read_text("utf-8")
    text = text.replace('"copeland_thesis', f'"{PIPELINES}/copeland_thesis')
    path = tmp_path / "study.toml"
    path.write_text(text.replace('"motor"]', '"synchronous_motor"]'))
    with pytest.raises(ParameterError, match="needs the machine's table synchronous_motor"):
        load_study(path)
