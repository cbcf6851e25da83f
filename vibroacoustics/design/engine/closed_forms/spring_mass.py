"""The sprung mass on an Oldham ring: its momentum by order is linear in a complex amplitude."""

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from ....balancers.spring_mass import (
    damping_coefficient,
    printed_mass,
    sprung_mass_response,
    tuned_mass,
)
from ....base.arrays import Array
from ....base.registry import register
from ....base.units import shaft_frequency_hz
from ....machine.machine import Machine
from ....mechanics.capabilities import OldhamRing
from ..closed_form import ClosedForm


@register
class OfSpringMass(ClosedForm):
    """Mass, momentum, stroke, resonance and loss; see `balancers.spring_mass`."""

    kind: ClassVar[str] = "spring-mass"
    fields: ClassVar[tuple[str, ...]] = ("stiffness_n_per_m", "tuned_speed_rpm", "damping_ratio")
    size: ClassVar[int] = 6
    mass: ClassVar = staticmethod(tuned_mass)

    def functions(self, values: Mapping[str, float], machine: Machine, speed_rpm: float) -> Array:
        """m, m X2/X1 as two numbers, |X2/X1|, √(2K/m) and c |X2/X1 - 1|²."""
        stiffness, tuned_rpm, damping = (values[name] for name in self.fields)
        tuned, turning = (2.0 * np.pi * shaft_frequency_hz(rpm) for rpm in (tuned_rpm, speed_rpm))
        mass = self.mass(stiffness, machine.require(OldhamRing).mass_kg, tuned)
        ratio = sprung_mass_response(mass, stiffness, damping, turning)
        loss = damping_coefficient(mass, stiffness, damping) * abs(ratio - 1.0) ** 2
        momentum = mass * ratio
        return np.array([
            mass, momentum.real, momentum.imag, abs(ratio), np.sqrt(2.0 * stiffness / mass), loss
        ])  # fmt: skip


@register
class OfSpringMassPrinted(OfSpringMass):
    """Spring and mass with the mass as printed."""

    kind: ClassVar[str] = "spring-mass-printed"
    mass: ClassVar = staticmethod(printed_mass)
