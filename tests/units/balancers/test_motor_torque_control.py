"""Torque control of a rolling piston's motor: ideal, with a current limit, refused."""

import numpy as np
import pytest
from support import ROOT

import vibroacoustics as va
from vibroacoustics.balancers.motor_torque_control import MotorTorqueControl
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.mechanics.torque_control import ControlledMotor
from vibroacoustics.mechanisms.rolling_piston.cycle import steady_cycle
from vibroacoustics.mechanisms.rolling_piston.machine import RollingPistonMachine

SAMPLES = 720


@pytest.fixture(scope="module")
def machine() -> RollingPistonMachine:
    machine = va.load_machine(ROOT / "data" / "machines" / "rolling_piston.toml")
    assert isinstance(machine, RollingPistonMachine)
    return machine


def residual_orders(machine, option: MotorTorqueControl | None, speed_rpm: float = 3000.0):
    """Orders 1 to 8 of motor torque less load, N m, and the cycle."""
    controlled = machine if option is None else option.applied_to(machine)
    cycle = steady_cycle(controlled, speed_rpm, SAMPLES)
    torque = cycle.rotation.motor_torque_n_m - cycle.load_n_m
    return 2.0 * np.abs(np.fft.rfft(torque)[1:9]) / SAMPLES, cycle


@pytest.mark.parametrize("speed_rpm", [1800.0, 3000.0, 5400.0])
@pytest.mark.parametrize("highest", [1, 2, 3])
def test_ideal_drive_removes_the_controlled_orders(machine, highest: int, speed_rpm: float):
    before, _ = residual_orders(machine, None, speed_rpm)
    after, _ = residual_orders(machine, MotorTorqueControl(highest_order=highest), speed_rpm)
    assert np.max(after[:highest]) < 1e-9 * before[0]
    assert np.all(after[:highest] < 0.01 * before[:highest])
    assert np.all(after[highest:3] > 0.5 * before[highest:3])


def test_swing_and_roll_follow_the_residual_torque(machine) -> None:
    _, free = residual_orders(machine, None)
    _, controlled = residual_orders(machine, MotorTorqueControl(highest_order=3))
    ratio = controlled.rotation.fluctuation_ratio / free.rotation.fluctuation_ratio
    assert ratio < 0.05
    mean = [np.mean(each.rotation.motor_torque_n_m) for each in (free, controlled)]
    assert mean[1] == pytest.approx(mean[0], rel=0.02)


def test_current_limit_leaves_a_part_that_follows_from_it(machine) -> None:
    """All orders shrink by one factor, so that mean and control just reach the limit."""
    limit = 14.0
    before, free = residual_orders(machine, None)
    option = MotorTorqueControl(highest_order=3, current_limit_a=limit)
    after, cycle = residual_orders(machine, option)
    motor = cycle.rotation.motor_torque_n_m
    assert np.max(motor) == pytest.approx(0.4 * limit, rel=1e-9)
    load = cycle.load_n_m
    spectrum = np.fft.rfft(load)
    spectrum[0], spectrum[4:] = 0.0, 0.0
    wave = np.fft.irfft(spectrum, SAMPLES)
    share = (0.4 * limit - np.mean(load)) / np.max(wave)
    of_load = 2.0 * np.abs(np.fft.rfft(load)[1:4]) / SAMPLES
    assert 0.0 < share < 1.0
    assert after[:3] == pytest.approx((1.0 - share) * of_load, rel=1e-6)
    assert np.all(after[:3] < before[:3])
    assert free.rotation.fluctuation_ratio > cycle.rotation.fluctuation_ratio


def test_machine_reports_what_is_left(machine) -> None:
    option = MotorTorqueControl(highest_order=3, current_limit_a=14.0)
    figures = option.applied_to(machine).revolution(3000.0, 144).figures
    assert figures["motor_peak_current_a"] == pytest.approx(14.0, rel=1e-9)
    assert 0.5 < figures["residual_torque_1x_n_m"] < 4.4
    words = option.sentences({name: np.array([value]) for name, value in figures.items()})
    assert "residual torque at order 1" in words[0]


def test_motor_on_the_mains_has_no_control(machine) -> None:
    drive = machine.drive.model_copy(update={"supply": "mains", "motor_slope_ratio": -3.0})
    mains = machine.model_copy(update={"drive": drive})
    assert mains.capability(ControlledMotor) is None
    with pytest.raises(ParameterError, match="needs a motor whose torque an inverter sets"):
        MotorTorqueControl(highest_order=1).applied_to(mains)


def test_slope_of_a_motor_on_the_mains_damps_the_swing(machine) -> None:
    drive = machine.drive.model_copy(update={"supply": "mains", "motor_slope_ratio": -3.0})
    mains = steady_cycle(machine.model_copy(update={"drive": drive}), 3000.0, SAMPLES)
    free = steady_cycle(machine, 3000.0, SAMPLES)
    assert mains.rotation.fluctuation_ratio < free.rotation.fluctuation_ratio
