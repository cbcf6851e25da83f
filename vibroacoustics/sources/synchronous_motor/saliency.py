"""A rotor whose two axes have different inductances: currents and reluctance torque.

In the rotor's frame, real along the voltage of the magnets (q) and -j along their flux (d), the
flux of a current i is L i + D i*, with the mean L and half the difference D of L_q and L_d (Park's
equations; Krause, Wasynczuk & Sudhoff, Analysis of Electric Machinery, 2nd ed., 3.3 and 5.5).
"""

from collections.abc import Mapping

import numpy as np

from ...base.arrays import ComplexArray
from .parameters import SynchronousMotor


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
    one = (backward * first - to_forward * second) / determinant
    return one, (forward * second - to_backward * first) / determinant


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
    for h, one in rotor_frame_a.items():
        for m, other in rotor_frame_a.items():
            product = -1.5j * motor.pole_pairs * motor.saliency_h * one * other
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
