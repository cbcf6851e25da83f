"""Capacitor motor whose speed swings: two-axis equations, linear in the swing.

Krause, Wasynczuk & Sudhoff, Analysis of Electric Machinery, 2nd ed., chapter 10 (unsymmetrical
two-phase machine), stationary axes, the auxiliary winding referred to the main one. States are the
flux linkages of main, auxiliary, rotor d and rotor q, and the capacitor's voltage.
"""

from dataclasses import dataclass

import numpy as np

from ...base.arrays import Array, ComplexArray
from .parameters import CapacitorMotor


@dataclass(frozen=True)
class TwoAxisMotor:
    """ẋ = (A + Ω B) x + b v and T = xᵀ Q x of the states x at speed Ω in rad/s.

    Attributes
    ----------
    at_rest, per_speed : A and B, shape (5, 5)
    input_vector : b per volt of the line, shape (5,)
    torque_form : Q, symmetric, N m
    line_rad_per_s : angular frequency of the line
    voltage_v : peak of the line voltage
    """

    at_rest: Array
    per_speed: Array
    input_vector: Array
    torque_form: Array
    line_rad_per_s: float
    voltage_v: float

    def forced(
        self, speed_rad_per_s: float, angular_frequency: Array | float, force: Array | ComplexArray
    ) -> ComplexArray:
        """States under a force at angular frequencies (...), (jω - A - ΩB)⁻¹ f, shape (..., 5)."""
        system = self.at_rest + speed_rad_per_s * self.per_speed
        turning = 1j * np.asarray(angular_frequency)[..., None, None] * np.eye(5)
        return np.asarray(np.linalg.solve(turning - system, force))

    def steady_states(self, speed_rad_per_s: float) -> ComplexArray:
        """Complex peaks of the states at line frequency and constant speed, shape (5,)."""
        force = self.voltage_v * self.input_vector
        return np.asarray(self.forced(speed_rad_per_s, self.line_rad_per_s, force))


def two_axis_motor(motor: CapacitorMotor) -> TwoAxisMotor:
    """Two-axis equations of the circuit; the auxiliary axis lies a quarter turn behind."""
    line, ratio = motor.line_rad_per_s, motor.turns_ratio
    leakage = np.array(
        [motor.main_leakage_ohm, motor.auxiliary_leakage_ohm / ratio**2]
        + 2 * [motor.rotor_leakage_ohm]
    )
    resistance = np.array(
        [motor.main_resistance_ohm, motor.auxiliary_resistance_ohm / ratio**2]
        + 2 * [motor.rotor_resistance_ohm]
    )
    coupling = np.eye(4) + np.eye(4, k=2) + np.eye(4, k=-2)  # d with d, q with q
    currents = np.linalg.inv((np.diag(leakage) + motor.magnetising_ohm * coupling) / line)
    at_rest, per_speed = np.zeros((5, 5)), np.zeros((5, 5))
    at_rest[:4, :4] = -resistance[:, None] * currents
    at_rest[1, 4] = 1.0 / ratio
    at_rest[4, :4] = -currents[1] / (ratio * motor.capacitance_f)
    per_speed[2, 3], per_speed[3, 2] = -motor.pole_pairs, motor.pole_pairs
    product = np.zeros((5, 5))  # T = p (ψ_q i_d - ψ_d i_q) of the rotor
    product[3, :4], product[2, :4] = currents[2], -currents[3]
    return TwoAxisMotor(
        at_rest=at_rest,
        per_speed=per_speed,
        input_vector=np.array([1.0, -1.0 / ratio, 0.0, 0.0, 0.0]),
        torque_form=0.5 * motor.pole_pairs * (product + product.T),
        line_rad_per_s=line,
        voltage_v=float(np.sqrt(2.0) * motor.line_voltage_v),
    )


@dataclass(frozen=True)
class SpeedResponse:
    """Motor torque per complex peak of a swing of the speed at ν, N m s, in the shape of ν.

    Attributes
    ----------
    direct : at ν
    upper : at twice the line frequency plus ν
    lower : at twice the line frequency minus ν, per conjugate of the swing's peak
    """

    direct: ComplexArray
    upper: ComplexArray
    lower: ComplexArray


def speed_response(
    motor: TwoAxisMotor, speed_rad_per_s: float, swing_rad_per_s: Array | float
) -> SpeedResponse:
    """Torque that a small swing δ of the speed makes: x1 from B δ x0, torque 2 x0ᵀ Q x1.

    Exact in the limit of small swings, the flux's delay and both fields included. At ν = 0 the
    direct part is the slope dT/dΩ of the torque curve.

    Parameters
    ----------
    motor : two-axis equations
    speed_rad_per_s : mean speed of the rotor
    swing_rad_per_s : ν, angular frequency of the swing, mechanical, any shape
    """
    steady, line = motor.steady_states(speed_rad_per_s), motor.line_rad_per_s
    push = 0.5 * motor.per_speed @ steady
    above = motor.forced(speed_rad_per_s, line + swing_rad_per_s, push)
    below = motor.forced(speed_rad_per_s, line - swing_rad_per_s, push)
    forward = motor.torque_form @ steady
    return SpeedResponse(
        direct=above @ forward.conj() + (below @ forward.conj()).conj(),
        upper=above @ forward,
        lower=below @ forward,
    )
