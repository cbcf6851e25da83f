"""Voltages, currents and torque of the motor by harmonics of the electrical frequency.

Phasors are complex peaks of phase a over the electrical angle, which is zero where the magnets'
voltage has its maximum.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ...base.arrays import ComplexArray
from ...base.errors import ParameterError
from .parameters import SynchronousMotor

LARGEST_MODULATION = {"sine": 1.0, "space-vector": 2.0 / np.sqrt(3.0)}
"""Largest part of a carrier period that the reference may fill."""


@dataclass(frozen=True)
class OperatingPoint:
    """The motor at constant speed under its mean load.

    Attributes
    ----------
    speed_rad_per_s : speed of the shaft
    electrical_rad_per_s : angular frequency of the voltages, pole pairs times the speed
    emf_v, current_a : by harmonic
    voltage_v : fundamental at the terminals
    modulation_ratio : its size over half the voltage of the link
    """

    speed_rad_per_s: float
    electrical_rad_per_s: float
    emf_v: Mapping[int, complex]
    current_a: Mapping[int, complex]
    voltage_v: complex
    modulation_ratio: float


def operating_point(
    motor: SynchronousMotor, speed_rad_per_s: float, torque_n_m: float
) -> OperatingPoint:
    """Currents that carry a mean torque.

    Those of a harmonic k > 1 are (V_k - E_k)/(R + jkωL), in pairs where the rotor is salient, with
    V_k the voltage of the dead time; the fundamental makes what is left of the mean torque.

    Raises
    ------
    ParameterError
        The inverter has not the voltage, or the motor not the torque.
    """
    electrical = motor.pole_pairs * speed_rad_per_s
    emf = {
        k: complex(ratio * electrical * motor.flux_linkage_vs)
        for k, ratio in motor.emf_ratios.items()
    }
    lost = dead_time_voltage_v(motor)
    current: dict[int, complex] = {}
    for k in (7, 13):
        waves = [(lost[m] - emf[m], m * electrical) for m in (k, k - 2)]
        current[k], current[k - 2] = pair_currents(motor, *waves)
    by_harmonics = torque_harmonics(emf, current, speed_rad_per_s, 0)[0].real
    by_harmonics += reluctance_torque(motor, _rotor_frame(current), 0)[0].real
    per_ampere = 1.5 * emf[1].real / speed_rad_per_s
    try:
        held = held_current_a(motor, per_ampere, torque_n_m - by_harmonics)
    except ValueError as error:
        raise ParameterError(
            f"synchronous_motor.current_advance_deg = {np.degrees(motor.current_advance_rad):g}°: "
            f"{error}, at {torque_n_m:.4g} N m"
        ) from None
    current = {1: held, **current}
    voltage = emf[1] + fundamental_voltage_v(motor, electrical, held)
    modulation = 2.0 * abs(voltage) / motor.dc_link_voltage_v
    if modulation > LARGEST_MODULATION[motor.modulation]:
        most = 0.5 * LARGEST_MODULATION[motor.modulation] * motor.dc_link_voltage_v
        raise ParameterError(
            f"synchronous_motor.dc_link_voltage_v = {motor.dc_link_voltage_v:g} V: gives phases "
            f"{most:.4g} V peak; at {30.0 / np.pi * speed_rad_per_s:.4g} rpm and "
            f"{torque_n_m:.4g} N m the motor needs {abs(voltage):.4g} V"
        )
    return OperatingPoint(speed_rad_per_s, electrical, emf, current, voltage, modulation)


def dead_time_voltage_v(motor: SynchronousMotor) -> dict[int, float]:
    """Harmonics of -V_dc t_d f_s sgn i, V: 4/(πk) of it, in turn with and against cos kθ.

    Jeong & Park, "The analysis and compensation of dead-time effects in PWM inverters", IEEE Trans.
    Ind. Electron. 38 (1991): a leg lacks t_d of each switching period, against its current.
    """
    size = motor.dc_link_voltage_v * motor.dead_time_s * motor.switching_frequency_hz
    return {k: -4.0 / np.pi * size * (-1.0) ** ((k - 1) // 2) / k for k in motor.emf_ratios}


def torque_harmonics(
    emf_v: Mapping[int, complex],
    current_a: Mapping[int, complex],
    speed_rad_per_s: float,
    highest: int,
) -> ComplexArray:
    """Torque (e_a i_a + e_b i_b + e_c i_c)/Ω by harmonic of the electrical frequency, N m.

    With space vectors, 3/(2Ω) Re Σ e_k i_m* e^{j(k-m)θ}, where harmonics 5, 11, … turn backwards:
    only multiples of six are left (Krause, Wasynczuk & Sudhoff, Analysis of Electric Machinery,
    2nd ed., 3.3: power in turning variables).

    Parameters
    ----------
    emf_v, current_a : by harmonic, none a multiple of two or three
    speed_rad_per_s : Ω of the shaft
    highest : harmonic of the result

    Returns
    -------
    mean and complex peaks, shape (highest + 1,)
    """
    torque = np.zeros(highest + 1, dtype=complex)
    for k, emf in _space_vectors(emf_v).items():
        for m, current in _space_vectors(current_a).items():
            product = 1.5 / speed_rad_per_s * emf * np.conj(current)
            if abs(k - m) <= highest:
                torque[abs(k - m)] += product if k >= m else np.conj(product)
    torque[0] = torque[0].real
    return torque


def _rotor_frame(phasors: Mapping[int, complex]) -> dict[int, complex]:
    """Space vectors by harmonic in the rotor's frame, one less than that at the terminals."""
    return {k - 1: value for k, value in _space_vectors(phasors).items()}


def _space_vectors(phasors: Mapping[int, complex]) -> dict[int, complex]:
    """Space vectors by signed harmonic: those that turn backwards are conjugate, at minus their
    number."""
    return {
        k if k % 3 == 1 else -k: value if k % 3 == 1 else np.conj(value)
        for k, value in phasors.items()
    }


def shaft_orders(motor: SynchronousMotor, point: OperatingPoint, highest: int) -> ComplexArray:
    """Torque of the motor at constant speed by order of the shaft, mean first, N m.

    The products of voltages and currents lie at multiples of six times the pole pairs, the cogging
    at multiples of the least common multiple of slots and poles (Zhu & Howe, "Influence of design
    parameters on cogging torque in permanent magnet machines", IEEE Trans. Energy Conv. 15 (2000)).

    Parameters
    ----------
    motor : pole pairs, slots, cogging
    point : voltages and currents
    highest : order

    Returns
    -------
    shape (highest + 1,), complex peaks; the electrical angle is zero at crank angle zero
    """
    orders = np.zeros(highest + 1, dtype=complex)
    harmonics = highest // motor.pole_pairs
    electrical = torque_harmonics(point.emf_v, point.current_a, point.speed_rad_per_s, harmonics)
    electrical += reluctance_torque(motor, _rotor_frame(point.current_a), harmonics)
    orders[:: motor.pole_pairs][: electrical.size] = electrical
    for number, ratio in ((1, 1.0), (2, motor.cogging_second_ratio)):
        order = number * motor.cogging_order
        if order <= highest:
            orders[order] += 1j * ratio * motor.cogging_torque_n_m
    return orders


def pair_currents(
    motor: SynchronousMotor,
    forwards: tuple[complex, float],
    backwards: tuple[complex, float],
) -> tuple[complex, complex]:
    """Currents of a wave that turns forwards and one that turns backwards, as the rotor sees both
    at one frequency: (R + jω L) i + jω D i' = v of each, with the other's i'.

    Parameters
    ----------
    motor : circuit
    forwards, backwards : phasor of the voltage, and its angular frequency at the terminals
    """
    (first, fast), (second, slow) = forwards, backwards
    mean, half = motor.phase_inductance_h, motor.saliency_h
    forward = motor.phase_resistance_ohm + 1j * fast * mean
    backward = motor.phase_resistance_ohm + 1j * slow * mean
    to_forward, to_backward = 1j * fast * half, 1j * slow * half
    determinant = forward * backward - to_forward * to_backward
    forward_current = (backward * first - to_forward * second) / determinant
    return forward_current, (forward * second - to_backward * first) / determinant


def fundamental_voltage_v(motor: SynchronousMotor, omega: float, current_a: complex) -> complex:
    """R I + jω (L I + D I*), without that of the magnets, V."""
    flux = motor.phase_inductance_h * current_a + motor.saliency_h * np.conj(current_a)
    return complex(motor.phase_resistance_ohm * current_a + 1j * omega * flux)


def reluctance_torque(
    motor: SynchronousMotor, rotor_frame_a: Mapping[int, complex], highest: int
) -> ComplexArray:
    """3/2 p (L_d - L_q) i_d i_q = 3/2 p D Im i² by harmonic of the electrical frequency, N m.

    Parameters
    ----------
    motor : pole pairs and saliency
    rotor_frame_a : the current's space vector i_h e^{jhθ} in the rotor's frame, by h
    highest : harmonic of the result

    Returns
    -------
    mean and complex peaks, shape (highest + 1,)
    """
    torque = np.zeros(highest + 1, dtype=complex)
    for h, current in rotor_frame_a.items():
        for m, other in rotor_frame_a.items():
            product = -1.5j * motor.pole_pairs * motor.saliency_h * current * other
            if abs(h + m) <= highest:
                torque[abs(h + m)] += product if h + m >= 0 else np.conj(product)
    torque[0] = torque[0].real
    return torque


def held_current_a(motor: SynchronousMotor, per_ampere: float, torque_n_m: float) -> complex:
    """Fundamental, at its advance, that makes a torque with magnets and saliency.

    b I cos β + a I² = T with b the magnets' torque per ampere and a = 3/2 p D sin 2β.

    Raises
    ------
    ValueError
        No current does.
    """
    advance = motor.current_advance_rad
    square = 1.5 * motor.pole_pairs * motor.saliency_h * np.sin(2.0 * advance)
    linear = per_ampere * np.cos(advance)
    discriminant = linear**2 + 4.0 * square * torque_n_m
    if discriminant < 0.0:
        raise ValueError("the reluctance torque takes more than the magnets give")
    size = 2.0 * torque_n_m / (linear + np.sqrt(discriminant))
    return complex(size * np.exp(1j * advance))
