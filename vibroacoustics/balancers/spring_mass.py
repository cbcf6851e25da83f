"""A mass between springs on the Oldham ring (thesis 7.2), tuned rightly and as printed."""

from collections.abc import Mapping
from typing import ClassVar

import numpy as np
from pydantic import Field

from ..base import rounding
from ..base.errors import ParameterError
from ..base.registry import register
from ..base.units import shaft_frequency_hz
from ..machine.machine import Machine
from ..machine.option import Figures, Option
from ..mechanics.added import Added, RingForce
from ..mechanics.capabilities import Capability, OldhamRing
from ..mechanics.moving_parts import MovingPart, Revolution, path, wrench


class SprungMass(Option):
    """A mass between two springs on the Oldham ring (thesis 7.2)."""

    needs: ClassVar[type[Capability]] = OldhamRing
    labels: ClassVar[Mapping[str, str]] = {
        "stroke_amplitude_mm": "Stroke amplitude of the sprung mass",
        "resonance_speed_rpm": "Speed at which the sprung mass resonates",
    }
    stiffness_n_per_m: float = Field(gt=0.0, le=1e7)
    """Stiffness K of each of the two springs."""
    tuned_speed_rpm: float = Field(ge=60.0, le=60000.0)
    damping_ratio: float = Field(ge=0.0, le=1.0)
    """Damping of the mass on both springs, as a fraction of critical."""
    height_below_ring_m: float = Field(ge=-1.0, le=1.0)

    def mass_kg(self, ring_mass_kg: float) -> float:
        """Mass that the tuning asks for."""
        raise NotImplementedError

    def added(self, machine: Machine, revolution: Revolution) -> Added:
        """The sprung mass as the springs move it at the revolution's speed."""
        ring, rotation = machine.require(OldhamRing), revolution.rotation
        mass, angular_frequency = self.mass_kg(ring.mass_kg), _angular(revolution.speed_rpm)
        ratio = sprung_mass_response(
            mass, self.stiffness_n_per_m, self.damping_ratio, angular_frequency
        )
        amplitude = ring.stroke_m * ratio
        position = np.real(amplitude * np.exp(1j * rotation.crank_angle))
        height = ring.height_m - self.height_below_ring_m
        part = MovingPart("balancer", mass, path(position, 0.0, height))
        damper = damping_coefficient(mass, self.stiffness_n_per_m, self.damping_ratio)
        resonance = np.sqrt(2.0 * self.stiffness_n_per_m / mass)
        slip = angular_frequency * ring.stroke_m * abs(ratio - 1.0)
        return Added(
            (part,),
            {
                "added_mass_kg": mass,
                "stroke_amplitude_mm": 1e3 * abs(amplitude),
                "resonance_speed_rpm": float(resonance) * 30.0 / np.pi,
                "dissipated_power_w": float(0.5 * damper * slip**2),
            },
            RingForce(wrench((part,), rotation).force_n[0], inertial=False),
        )

    def leaves_out(self, inner_sources: bool) -> tuple[str, ...]:
        """Its narrow tuning."""
        return ("A sprung mass is tuned to one speed.",)

    def sentences(self, figures: Figures) -> tuple[str, ...]:
        """Its stroke, its resonance and what it costs."""
        stroke = rounding.span(figures["stroke_amplitude_mm"], rounding.significant)
        speed = rounding.span(figures["resonance_speed_rpm"], lambda rpm: rounding.fixed(rpm, 0))
        cost = rounding.span(figures["dissipated_power_w"], rounding.significant)
        return (
            f"Its mass moves with an amplitude of {stroke} mm.",
            f"Its mass resonates at {speed} rpm, also during run-up.",
            f"It dissipates {cost} W.",
        )


@register
class SpringMass(SprungMass):
    """The sprung mass as dynamics tune it."""

    kind: ClassVar[str] = "spring-mass"

    def mass_kg(self, ring_mass_kg: float) -> float:
        """Mass whose momentum cancels the ring's at one speed; see `tuned_mass`."""
        return tuned_mass(self.stiffness_n_per_m, ring_mass_kg, _angular(self.tuned_speed_rpm))


@register
class SpringMassPrinted(SprungMass):
    """The sprung mass of equation (7.20) as printed, which has a sign error."""

    kind: ClassVar[str] = "spring-mass-printed"
    to_be_built: ClassVar[bool] = False

    def mass_kg(self, ring_mass_kg: float) -> float:
        """The mass as printed, which the springs move as they really do; see `printed_mass`."""
        return printed_mass(self.stiffness_n_per_m, ring_mass_kg, _angular(self.tuned_speed_rpm))


def tuned_mass(stiffness_n_per_m: float, ring_mass_kg: float, angular_frequency: float) -> float:
    """Mass that cancels the ring's momentum: m2 = 2K m1 / (m1 ω² - 2K), kg.

    It follows from m2 ẍ2 = 2K (x1 - x2), which corrects the sign of thesis (7.15).

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
    detuning = coupling - mass_kg * angular_frequency**2
    if abs(detuning) < 1e-9 * spring:
        raise ParameterError(
            "damping_ratio = 0: the undamped mass is at resonance at "
            f"{angular_frequency * 30 / np.pi:.4g} rpm"
        )
    return complex(coupling / detuning)


def damping_coefficient(mass_kg: float, stiffness_n_per_m: float, damping_ratio: float) -> float:
    """Damper of the mass on both springs: c = 2 ζ √(2K m2), N s/m."""
    return 2.0 * damping_ratio * float(np.sqrt(2.0 * stiffness_n_per_m * mass_kg))


def _angular(speed_rpm: float) -> float:
    """Angular frequency of the shaft, rad/s."""
    return 2.0 * np.pi * shaft_frequency_hz(speed_rpm)
