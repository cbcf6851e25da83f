"""Balanced induction motor by Kloss's torque curve (1909; stator resistance left out)."""

from typing import NamedTuple

import numpy as np


class KlossMotor(NamedTuple):
    """A balanced motor by the top of its torque curve."""

    synchronous_speed_rad_per_s: float
    breakdown_torque_n_m: float
    breakdown_slip_ratio: float


def torque(motor: KlossMotor, slip):
    """T = 2 T_k/(s/s_k + s_k/s), N m, over slip of any shape."""
    ratio = np.asarray(slip) / motor.breakdown_slip_ratio
    return 2.0 * motor.breakdown_torque_n_m * ratio / (1.0 + ratio**2)


def slip_at_torque(motor: KlossMotor, torque_n_m: float) -> float:
    """Slip on the running part of the curve, s = s_k (u - √(u² - 1)) with u = T_k/T."""
    share = torque_n_m / motor.breakdown_torque_n_m
    return motor.breakdown_slip_ratio * share / (1.0 + np.sqrt(1.0 - share**2))


def slope_ratio(motor: KlossMotor, slip: float) -> float:
    """Relative change of torque per relative change of speed, (Ω/T) dT/dΩ."""
    square = (slip / motor.breakdown_slip_ratio) ** 2
    return -(1.0 - slip) / slip * (1.0 - square) / (1.0 + square)
