"""Torque at sidebands of the switching frequency: what the inverter's steps leave in the current.

Holmes & Lipo, Pulse Width Modulation for Power Converters (2003), chapters 3 and 5: double Fourier
series of naturally sampled pulses about a triangular carrier.
"""

from typing import Final, NamedTuple

import numpy as np

from ...base.arrays import Array, ComplexArray
from .harmonics import OperatingPoint, pair_currents
from .parameters import SynchronousMotor

SAMPLES: Final = 1024
"""Samples of the reference; the series is exact to rounding for a sine."""
BASEBAND: Final = 16
"""Multiples of the electrical frequency about those of the carrier that are kept."""


class Sideband(NamedTuple):
    """Torque at carrier times f_s plus electrical times f_e."""

    carrier: int
    electrical: int
    torque_n_m: complex


def reference(modulation: str, ratio: float, angle: Array) -> Array:
    """Return the reference of a leg, over half the voltage of the link; shape of the angle.

    Space-vector modulation centres the three legs: minus half of the largest and the least.
    """
    legs = ratio * np.cos(angle + 2.0 * np.pi / 3.0 * np.array([0, -1, 1])[:, None])
    common = 0.5 * (legs.max(axis=0) + legs.min(axis=0)) if modulation == "space-vector" else 0.0
    return np.asarray(legs[0] - common)


def leg_harmonics(modulation: str, ratio: float, carrier: int) -> ComplexArray:
    """A_mn of Σ A_mn cos(m ω_c t + n y), the leg's voltage over half that of the link.

    (4/(mπ)) times the n-th Fourier coefficient of sin(mπ/2 (1 + r(y))) of the reference r. With
    r = M cos y that is (4/(mπ)) J_n(mπM/2) sin((m + n)π/2) (Holmes & Lipo,
    chapter 3, natural sampling, triangular carrier).

    Parameters
    ----------
    modulation : name of the reference
    ratio : M, of the reference's fundamental
    carrier : m, from one

    Returns
    -------
    shape (2 BASEBAND + 1,), n from -BASEBAND
    """
    angle = 2.0 * np.pi * np.arange(SAMPLES) / SAMPLES
    filled = 0.5 * np.pi * carrier * (1.0 + reference(modulation, ratio, angle))
    coefficients = np.fft.fft(np.sin(filled)) / SAMPLES
    return np.asarray(4.0 / (carrier * np.pi) * coefficients[np.arange(-BASEBAND, BASEBAND + 1)])


def sidebands(
    motor: SynchronousMotor, point: OperatingPoint, highest_hz: float
) -> tuple[Sideband, ...]:
    """Torque of the switched voltages' currents with the magnets' fundamental, by frequency.

    Phases see no multiples of three; n = 3k + 1 turns forwards, 3k - 1 backwards. At ω in space a
    voltage makes the current V/(R + jωL), and this in the field the torque 3 E I/(2Ω) at ω - ω_e:
    f_s ± 3 f_e of the carrier, 2 f_s and 2 f_s ± 6 f_e of twice the carrier are the first. In a
    salient rotor the two that it sees at one frequency drive one another, and make a reluctance
    torque with the fundamental. Below half the switching frequency the control of the current acts
    on them: they are omitted.

    Parameters
    ----------
    motor : link, carrier, circuit
    point : fundamental of voltage, current and magnets
    highest_hz : highest frequency of the torques, Hz
    """
    electrical = point.electrical_rad_per_s
    switching = 2.0 * np.pi * motor.switching_frequency_hz
    reach = 2.0 * np.pi * highest_hz + (BASEBAND + 1) * electrical
    torque: dict[tuple[int, int], complex] = {}
    for carrier in range(1, int(reach / switching) + 1):
        voltages = _voltages(motor, point, carrier)
        for offset in range(-BASEBAND - 1, BASEBAND + 2):
            if offset % 3 == 0:
                waves = [
                    (
                        voltages.get(offset + side, 0.0),
                        carrier * switching + (offset + side) * electrical,
                    )
                    for side in (1, -1)
                ]
                if any(voltage for voltage, _ in waves):
                    currents = pair_currents(motor, waves[0], waves[1])
                    torque[carrier, offset] = _torque(motor, point, currents)
    return tuple(
        Sideband(carrier, offset, complex(value))
        for (carrier, offset), value in torque.items()
        if _kept_hz(carrier, offset, motor, electrical, highest_hz)
    )


def _voltages(motor: SynchronousMotor, point: OperatingPoint, carrier: int) -> dict[int, complex]:
    """Voltages of a phase about a multiple of the carrier, by n, V; those that count."""
    size = leg_harmonics(motor.modulation, point.modulation_ratio, carrier)
    turned, half = float(np.angle(point.voltage_v)), 0.5 * motor.dc_link_voltage_v
    electrical_hz = point.electrical_rad_per_s / (2.0 * np.pi)
    return {
        n: complex(half * size[n + BASEBAND] * np.exp(1j * n * turned))
        for n in range(-BASEBAND, BASEBAND + 1)
        if n % 3 and (carrier - 0.5) * motor.switching_frequency_hz + n * electrical_hz >= 0.0
    }


def _torque(
    motor: SynchronousMotor, point: OperatingPoint, currents: tuple[complex, complex]
) -> complex:
    """Torque of a forward and a backward current with the magnets and, in the salient rotor, with
    the fundamental of the current. The phasor of a backward wave is conjugate in space, and so is
    its torque's."""
    forwards, backwards = currents
    held = point.current_a[1]
    magnets = 1.5 * abs(point.emf_v[1]) / point.speed_rad_per_s * (forwards + backwards)
    across = held * forwards - np.conj(held) * backwards
    return complex(magnets - 3.0j * motor.pole_pairs * motor.saliency_h * across)


def _kept_hz(
    carrier: int, offset: int, motor: SynchronousMotor, electrical: float, highest_hz: float
) -> bool:
    frequency = carrier * motor.switching_frequency_hz + offset * electrical / (2.0 * np.pi)
    return bool(0.0 < frequency <= highest_hz)
