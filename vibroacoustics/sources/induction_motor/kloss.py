"""Balanced induction motor by Kloss's torque curve."""

import numpy as np

from ...base.arrays import Array
from ...base.errors import ParameterError
from .parameters import KlossMotor


def torque(motor: KlossMotor, slip: Array) -> Array:
    """Torque over slip, T = 2 T_k/(s/s_k + s_k/s), N m (Kloss 1909; stator resistance left out).

    Parameters
    ----------
    motor : T_k and s_k at the top of the curve
    slip : any shape; negative where the machine generates
    """
    ratio = np.asarray(slip) / motor.breakdown_slip_ratio
    return np.asarray(2.0 * motor.breakdown_torque_n_m * ratio / (1.0 + ratio**2))


def slip_at_torque(motor: KlossMotor, torque_n_m: float) -> float:
    """Slip on the running part of the curve, s = s_k (u - √(u² - 1)) with u = T_k/T.

    Raises
    ------
    ParameterError
        The torque is beyond the motor's breakdown torque.
    """
    share = torque_n_m / motor.breakdown_torque_n_m
    if not abs(share) <= 1.0:
        raise ParameterError(
            f"torque = {torque_n_m:.4g} N m: exceeds breakdown_torque_n_m = "
            f"{motor.breakdown_torque_n_m:.4g} N m, the motor stalls"
        )
    return float(motor.breakdown_slip_ratio * share / (1.0 + np.sqrt(1.0 - share**2)))


def slope_ratio(motor: KlossMotor, slip: float) -> float:
    """Relative change of torque per relative change of speed, (Ω/T) dT/dΩ.

    `crankshaft.steady_rotation` takes it. The torque is that of steady speed: it holds for changes
    slower than the rotor's flux, below about s_k times the line frequency.
    """
    square = (slip / motor.breakdown_slip_ratio) ** 2
    return float(-(1.0 - slip) / slip * (1.0 - square) / (1.0 + square))
