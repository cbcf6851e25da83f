"""Torque of a capacitor motor and its load as lines: shaft orders and line frequency kept apart."""

from collections.abc import Hashable, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from ...base.arrays import Array, ComplexArray
from .revolving_fields import CapacitorMotor, OperatingPoint, point_at_torque


@dataclass(frozen=True)
class TwoAxisMotor:
    """ẋ = (A + Ω B) x + b v and T = xᵀ Q x of the states x at speed Ω in rad/s.

    Attributes
    ----------
    at_rest, per_speed : A and B, shape (5, 5)
    input_vector : b per volt of the line, shape (5,)
    torque_form : Q, symmetric, shape (5, 5), N m
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


@dataclass(frozen=True)
class SpeedResponse:
    """Motor torque per complex peak of a swing of the speed at ν, N m s, shape (...) of ν.

    Attributes
    ----------
    direct : at ν
    upper : at twice the line frequency plus ν
    lower : at twice the line frequency minus ν, per conjugate of the swing's peak
    """

    direct: ComplexArray
    upper: ComplexArray
    lower: ComplexArray


class TorqueLine(NamedTuple):
    """One frequency of the balance J Ω̇ = T_motor - T_load; complex peaks.

    Attributes
    ----------
    name : order of the shaft, multiple of the line frequency, or both
    frequency_hz : above zero
    motor_torque_n_m : on the rotor; the stator, and with it the housing, gets the opposite
    roll_moment_n_m : on the housing about z by change of the rotor's momentum, -J Ω̇: reaction of
        the motor and of the load together
    speed_swing_rad_per_s : swing of the speed of the rotor
    """

    name: str
    frequency_hz: float
    motor_torque_n_m: complex
    roll_moment_n_m: complex
    speed_swing_rad_per_s: complex


@dataclass(frozen=True)
class TorqueLines:
    """All lines of a motor under load, one list a phase reference.

    Attributes
    ----------
    operating_point : operating point of the motor at the mean load
    speed_rad_per_s : mean speed
    shaft : orders of the load, phases against crank angle zero
    line : twice and four times the line frequency, against the maximum of the line voltage
    sidebands : twice the line frequency plus and minus an order, with both references at time zero
    """

    operating_point: OperatingPoint
    speed_rad_per_s: float
    shaft: tuple[TorqueLine, ...]
    line: tuple[TorqueLine, ...]
    sidebands: tuple[TorqueLine, ...]


@dataclass(frozen=True)
class RotorInMotor:
    """The rotor with all that turns with it, in the field of the motor, under its mean load.

    Attributes
    ----------
    operating_point : operating point of the motor
    motor : its two-axis equations
    twice_line_hz : twice the line frequency
    speed_rad_per_s : mean
    inertia_kg_m2 : J of all that turns with the shaft
    """

    operating_point: OperatingPoint
    motor: TwoAxisMotor
    twice_line_hz: float
    speed_rad_per_s: float
    inertia_kg_m2: float
    _responses: dict[Hashable, SpeedResponse] = field(default_factory=dict, repr=False)

    def response(self, frequency_hz: Array | float) -> SpeedResponse:
        """Kept, as all ripples have the same frequencies."""
        swing = 2.0 * np.pi * np.asarray(frequency_hz)
        key = swing.shape, swing.tobytes()
        if key not in self._responses:
            self._responses[key] = speed_response(self.motor, self.speed_rad_per_s, swing)
        return self._responses[key]

    def lines(
        self,
        names: Sequence[str],
        frequency_hz: Array,
        motor_torque: ComplexArray,
        load_torque: ComplexArray | float = 0.0,
    ) -> tuple[TorqueLine, ...]:
        """Lines of torques at constant speed; the motor's answer to the swings is added."""
        inertia = 2.0j * np.pi * frequency_hz * self.inertia_kg_m2
        response = self.response(frequency_hz).direct
        swing = (motor_torque - load_torque) / (inertia - response)
        columns = (frequency_hz, motor_torque + response * swing, -inertia * swing, swing)
        rows = zip(*(column.tolist() for column in columns), strict=True)
        return tuple(TorqueLine(name, *row) for name, row in zip(names, rows, strict=True))


def rotor_in_motor(motor: CapacitorMotor, inertia_kg_m2: float, mean_n_m: float) -> RotorInMotor:
    """The rotor at the speed at which the motor carries a mean load.

    Parameters
    ----------
    motor : the motor's circuit
    inertia_kg_m2 : J of all that turns with the shaft
    mean_n_m : load torque against the rotation
    """
    point = point_at_torque(motor, mean_n_m)
    speed = motor.synchronous_speed_rad_per_s * (1.0 - point.slip)
    twice_line_hz = 2.0 * motor.line_frequency_hz
    return RotorInMotor(point, two_axis_motor(motor), twice_line_hz, speed, inertia_kg_m2)


def torque_lines(rotor: RotorInMotor, ripple_n_m: ComplexArray) -> TorqueLines:
    """Torque balance of the rotor, linear in the swings of its speed.

    The twice-line-frequency torque is no shaft order. A swing of the speed modulates it, which
    makes the sidebands and four times the line frequency. Left out as smaller: what the swings
    at twice the line frequency change in the load's crank angle, and sidebands of sidebands.

    Parameters
    ----------
    rotor : under the mean load
    ripple_n_m : load torque against the rotation, complex peak of orders 1, 2, …, shape (order,)
    """
    point, speed, twice = rotor.operating_point, rotor.speed_rad_per_s, rotor.twice_line_hz
    orders = np.arange(1, ripple_n_m.size + 1)
    names = [f"order {order}" for order in orders.tolist()]
    frequency = np.asarray(orders * speed / (2.0 * np.pi))
    shaft = rotor.lines(names, frequency, np.zeros_like(ripple_n_m), ripple_n_m)
    pulse = np.array([point.pulsating_torque_n_m])
    (pulsating,) = rotor.lines(["2 x line"], np.array([twice]), pulse)
    fourth = rotor.response(twice).upper * pulsating.speed_swing_rad_per_s
    (double,) = rotor.lines(["4 x line"], np.array([2.0 * twice]), fourth[None])
    return TorqueLines(point, speed, shaft, (pulsating, double), _sidebands(rotor, shaft))


def _sidebands(rotor: RotorInMotor, shaft: Sequence[TorqueLine]) -> tuple[TorqueLine, ...]:
    """Twice the line frequency plus and minus those of the shaft's orders, by order."""
    frequency = np.array([line.frequency_hz for line in shaft])
    swing = np.array([line.speed_swing_rad_per_s for line in shaft])
    response, difference = rotor.response(frequency), rotor.twice_line_hz - frequency
    lower = response.lower * swing.conj()
    above = rotor.lines(
        [f"2 x line + {line.name}" for line in shaft],
        rotor.twice_line_hz + frequency,
        response.upper * swing,
    )
    below = rotor.lines(
        [f"2 x line - {line.name}" for line in shaft],
        np.abs(difference),
        np.where(difference > 0.0, lower, lower.conj()),
    )
    return tuple(line for pair in zip(above, below, strict=True) for line in pair)


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
