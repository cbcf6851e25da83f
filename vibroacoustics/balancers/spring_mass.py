"""A mass between springs on the Oldham ring (thesis 7.2), tuned rightly and as printed."""

import numpy as np

from ..errors import ParameterError
from ..moving_parts import Array, Balancing, MovingPart, path
from ..parameters.oldham_scroll import OldhamScroll
from ..parameters.options import SpringMass, SpringMassPrinted, SprungMass
from ..units import shaft_frequency_hz


def spring_mass(
    option: SpringMass, machine: OldhamScroll, speed_rpm: float, crank_angle: Array
) -> Balancing:
    """Sprung mass tuned so that its momentum cancels the ring's at one speed.

    The mass follows from m2 ẍ2 = 2K (x1 - x2), which corrects the sign of thesis (7.15):
    see `tuned_mass`.
    """
    mass = tuned_mass(
        option.stiffness_n_per_m, machine.oldham.mass_kg, _angular_frequency(option.tuned_speed_rpm)
    )
    return _sprung_mass(option, mass, machine, speed_rpm, crank_angle)


def spring_mass_printed(
    option: SpringMassPrinted, machine: OldhamScroll, speed_rpm: float, crank_angle: Array
) -> Balancing:
    """The mass of equation (7.20) as printed, moved as the springs really move it."""
    mass = printed_mass(
        option.stiffness_n_per_m, machine.oldham.mass_kg, _angular_frequency(option.tuned_speed_rpm)
    )
    return _sprung_mass(option, mass, machine, speed_rpm, crank_angle)


def tuned_mass(stiffness_n_per_m: float, ring_mass_kg: float, angular_frequency: float) -> float:
    """Mass that cancels the ring's momentum: m2 = 2K m1 / (m1 ω² - 2K), kg.

    Raises
    ------
    ParameterError
        The springs are too stiff: 2K must be below m1 ω².
    """
    inertia = ring_mass_kg * angular_frequency**2
    if 2.0 * stiffness_n_per_m >= inertia:
        raise ParameterError(
            f"stiffness_n_per_mm = {stiffness_n_per_m / 1e3:g} N/mm: no mass balances "
            f"the ring; allowed below {inertia / 2e3:.4g} N/mm at the tuned speed"
        )
    return 2.0 * stiffness_n_per_m * ring_mass_kg / (inertia - 2.0 * stiffness_n_per_m)


def printed_mass(stiffness_n_per_m: float, ring_mass_kg: float, angular_frequency: float) -> float:
    """Equation (7.20) as printed: m2 = 2K m1 / (2K - m1 ω²), kg. The sign is wrong.

    Raises
    ------
    ParameterError
        The springs are too soft: the printed mass is negative up to 2K = m1 ω².
    """
    inertia = ring_mass_kg * angular_frequency**2
    if 2.0 * stiffness_n_per_m <= inertia:
        raise ParameterError(
            f"stiffness_n_per_mm = {stiffness_n_per_m / 1e3:g} N/mm: equation "
            f"(7.20) gives no positive mass; allowed above {inertia / 2e3:.4g} N/mm"
        )
    return 2.0 * stiffness_n_per_m * ring_mass_kg / (2.0 * stiffness_n_per_m - inertia)


def sprung_mass_response(
    mass_kg: float, stiffness_n_per_m: float, damping_ratio: float, angular_frequency: float
) -> complex:
    """Motion of the mass per motion of the ring, X2/X1, complex.

    Spring 2K and damper c = 2 ζ √(2K m2) both act between ring and mass:
    X2/X1 = (2K + jωc) / (2K + jωc - m2 ω²).

    Raises
    ------
    ParameterError
        No damping at resonance.
    """
    spring = 2.0 * stiffness_n_per_m
    damper = damping_coefficient(mass_kg, stiffness_n_per_m, damping_ratio)
    coupling = spring + 1j * angular_frequency * damper
    remainder = coupling - mass_kg * angular_frequency**2
    if abs(remainder) < 1e-9 * spring:
        raise ParameterError(
            "damping_ratio = 0: the undamped mass is at resonance at "
            f"{angular_frequency * 30 / np.pi:.4g} rpm"
        )
    return complex(coupling / remainder)


def damping_coefficient(mass_kg: float, stiffness_n_per_m: float, damping_ratio: float) -> float:
    """Damper of the mass on both springs: c = 2 ζ √(2K m2), N s/m."""
    return 2.0 * damping_ratio * float(np.sqrt(2.0 * stiffness_n_per_m * mass_kg))


def _sprung_mass(
    option: SprungMass,
    mass_kg: float,
    machine: OldhamScroll,
    speed_rpm: float,
    crank_angle: Array,
) -> Balancing:
    angular_frequency = _angular_frequency(speed_rpm)
    ratio = sprung_mass_response(
        mass_kg, option.stiffness_n_per_m, option.damping_ratio, angular_frequency
    )
    amplitude = machine.kinematics.orbit_radius_m * ratio
    position = np.real(amplitude * np.exp(1j * crank_angle))
    height = machine.oldham.height_m - option.height_below_ring_m
    damper = damping_coefficient(mass_kg, option.stiffness_n_per_m, option.damping_ratio)
    resonance = np.sqrt(2.0 * option.stiffness_n_per_m / mass_kg)
    slip = angular_frequency * machine.kinematics.orbit_radius_m * abs(ratio - 1.0)
    return Balancing(
        (MovingPart("balancer", mass_kg, path(position, 0.0, height)),),
        {
            "added_mass_kg": mass_kg,
            "stroke_amplitude_mm": 1e3 * abs(amplitude),
            "resonance_speed_rpm": float(resonance) * 30.0 / np.pi,
            "dissipated_power_w": float(0.5 * damper * slip**2),
        },
    )


def _angular_frequency(speed_rpm: float) -> float:
    return 2.0 * np.pi * shaft_frequency_hz(speed_rpm)
