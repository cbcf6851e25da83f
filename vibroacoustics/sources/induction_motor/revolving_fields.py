"""Capacitor motor at steady speed by its circuit and its two revolving fields."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np
from pydantic import Field
from scipy.optimize import brentq, minimize_scalar

from ...base.errors import ParameterError
from ...base.parameters import Parameters
from ...base.units import shaft_frequency_hz

OHM = Field(gt=0.0, le=1e5)


class CapacitorMotor(Parameters):
    """A single-phase motor with a capacitor before its auxiliary winding.

    Resistances and reactances are per phase at line frequency, those of the rotor and of
    magnetising referred to the main winding; core loss is neglected.
    """

    line_voltage_v: float = Field(gt=0.0, le=1e5)
    """Root mean square."""
    line_frequency_hz: float = Field(ge=1.0, le=1e3)
    pole_pairs: int = Field(ge=1, le=50)
    main_resistance_ohm: float = OHM
    main_leakage_ohm: float = OHM
    auxiliary_resistance_ohm: float = OHM
    auxiliary_leakage_ohm: float = OHM
    magnetising_ohm: float = OHM
    rotor_resistance_ohm: float = OHM
    rotor_leakage_ohm: float = OHM
    turns_ratio: float = Field(gt=0.0, le=10.0)
    """Effective turns of the auxiliary winding over those of the main winding."""
    capacitance_f: float = Field(gt=0.0, le=1.0)

    @property
    def line_rad_per_s(self) -> float:
        return 2.0 * math.pi * self.line_frequency_hz

    @property
    def synchronous_speed_rad_per_s(self) -> float:
        return self.line_rad_per_s / self.pole_pairs


class TurningRotor(Parameters):
    inertia_kg_m2: float = Field(gt=0.0, le=1e3)
    """Inertia about the shaft's axis, of all that turns with it."""


LARGEST_RUNNING_SLIP: Final = 0.5
"""The breakdown torque of a running compressor motor lies below this slip."""
_GROW_WITH_FREQUENCY: Final = (
    "line_voltage_v",
    "main_leakage_ohm",
    "auxiliary_leakage_ohm",
    "magnetising_ohm",
    "rotor_leakage_ohm",
)


@dataclass(frozen=True)
class OperatingPoint:
    """A capacitor motor at constant speed.

    Attributes
    ----------
    slip : slip of the forward field
    main_current_a, auxiliary_current_a : complex peaks
    forward_current_a, backward_current_a : currents of the two fields, in turns of the main winding
    torque_n_m : mean, in the air gap
    pulsating_torque_n_m : complex peak at twice the line frequency
    input_power_w : from the line
    """

    slip: float
    main_current_a: complex
    auxiliary_current_a: complex
    forward_current_a: complex
    backward_current_a: complex
    torque_n_m: float
    pulsating_torque_n_m: complex
    input_power_w: float


def field_impedance(motor: CapacitorMotor, slip: float) -> complex:
    """Z = jX_m ‖ (R_2/s + jX_2) of a field in which the rotor slips by s (Fitzgerald, eq. 9.4).

    For the backward field s is 2 - s.
    """
    magnetising, leakage = 1j * motor.magnetising_ohm, 1j * motor.rotor_leakage_ohm
    rotor = motor.rotor_resistance_ohm + slip * leakage  # times slip, so that slip may be zero
    return complex(magnetising * rotor / (rotor + slip * magnetising))


def air_gap_voltages(motor: CapacitorMotor, point: OperatingPoint) -> tuple[complex, complex]:
    """Voltages E = Z I of the forward and the backward field, in proportion to their flux.

    Parameters
    ----------
    motor : impedances
    point : currents and slip
    """
    forward = field_impedance(motor, point.slip) * point.forward_current_a
    return forward, field_impedance(motor, 2.0 - point.slip) * point.backward_current_a


def operating_point(motor: CapacitorMotor, slip: float) -> OperatingPoint:
    """Currents and torque at a slip.

    I_f,b = (I_m ∓ ja I_a)/2. The torque is the product of each field's flux with both currents:
    mean (R_f |I_f|² - R_b |I_b|²)/Ω_s, and (Z_f - Z_b) I_f I_b/Ω_s at twice the line frequency,
    which vanishes where there is no backward field.
    """
    forward, backward = field_impedance(motor, slip), field_impedance(motor, 2.0 - slip)
    main = motor.main_resistance_ohm + 1j * motor.main_leakage_ohm
    auxiliary = motor.auxiliary_resistance_ohm + 1j * motor.auxiliary_leakage_ohm
    auxiliary += 1.0 / (1j * motor.line_rad_per_s * motor.capacitance_f)
    ratio = motor.turns_ratio
    self_impedance, mutual = 0.5 * (forward + backward), 0.5j * ratio * (forward - backward)
    circuit = np.array(
        [[main + self_impedance, -mutual], [mutual, auxiliary + ratio**2 * self_impedance]]
    )
    voltage = np.sqrt(2.0) * motor.line_voltage_v
    i_main, i_auxiliary = np.linalg.solve(circuit, np.full(2, voltage, dtype=complex))
    i_forward = 0.5 * (i_main - 1j * ratio * i_auxiliary)
    i_backward = 0.5 * (i_main + 1j * ratio * i_auxiliary)
    power = forward.real * abs(i_forward) ** 2 - backward.real * abs(i_backward) ** 2
    pulsating = (forward - backward) * i_forward * i_backward
    speed = motor.synchronous_speed_rad_per_s
    return OperatingPoint(
        slip=slip,
        main_current_a=complex(i_main),
        auxiliary_current_a=complex(i_auxiliary),
        forward_current_a=complex(i_forward),
        backward_current_a=complex(i_backward),
        torque_n_m=float(power / speed),
        pulsating_torque_n_m=complex(pulsating / speed),
        input_power_w=float(0.5 * voltage * (i_main + i_auxiliary).real),
    )


def breakdown_slip(motor: CapacitorMotor) -> float:
    """Slip of the largest mean torque on the running part of the curve."""
    return _slip_of_largest(lambda slip: operating_point(motor, slip).torque_n_m)


def point_at_torque(motor: CapacitorMotor, torque_n_m: float) -> OperatingPoint:
    """Operating point at which the mean torque carries a load."""
    slip = _slip_at(lambda slip: operating_point(motor, slip).torque_n_m, torque_n_m)
    return operating_point(motor, float(slip))


def on_supply(rated: CapacitorMotor, frequency_hz: float) -> CapacitorMotor:
    """The motor at the same flux: reactances and voltage in proportion to the frequency."""
    ratio = frequency_hz / rated.line_frequency_hz
    grown = {name: ratio * getattr(rated, name) for name in _GROW_WITH_FREQUENCY}
    return rated.model_copy(update={"line_frequency_hz": frequency_hz, **grown})


def supply_frequency_hz(rated: CapacitorMotor, speed_rpm: float, torque_n_m: float) -> float:
    """Supply on which the motor carries a load at a speed, f = p n/(60 (1 - s)).

    By definition the slip is s = (n_s - n)/n_s, the speed n against the synchronous n_s = 60 f/p,
    at which the field turns. It is that at which the motor on this supply, at the same flux, gives
    the torque; the curve is that of its circuit (`operating_point`).

    Parameters
    ----------
    rated : with the values of its line frequency
    speed_rpm : speed of the shaft
    torque_n_m : mean load against the rotation
    """

    def frequency(slip: float) -> float:
        return rated.pole_pairs * shaft_frequency_hz(speed_rpm) / (1.0 - slip)

    def torque(slip: float) -> float:
        return operating_point(on_supply(rated, frequency(slip)), slip).torque_n_m

    hint = ": give operation.supply_frequency_hz, or change the motor's table"
    return frequency(_slip_at(torque, torque_n_m, f"at {speed_rpm:g} rpm ", hint))


def _slip_of_largest(torque: Callable[[float], float]) -> float:
    largest = minimize_scalar(
        lambda slip: -torque(slip),
        bounds=(0.0, LARGEST_RUNNING_SLIP),
        method="bounded",
        options={"xatol": 1e-9},
    )
    return float(largest.x)


def _slip_at(
    torque: Callable[[float], float], wanted_n_m: float, speed: str = "", hint: str = ""
) -> float:
    """Slip of the running part at which a mean torque over the slip carries a load."""
    top = _slip_of_largest(torque)
    least, most = torque(0.0), torque(top)
    if not least <= wanted_n_m <= most:
        raise ParameterError(
            f"torque = {wanted_n_m:.4g} N m: the motor gives {least:.4g} to {most:.4g} N m {speed}"
            f"between synchronous speed and breakdown{hint}"
        )
    return float(brentq(lambda slip: torque(slip) - wanted_n_m, 0.0, top, xtol=1e-14))
