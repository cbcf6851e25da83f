"""Damping between the Oldham ring and the frame (thesis 7.4)."""

from typing import ClassVar

import numpy as np
from pydantic import Field

from ..base import rounding
from ..base.registry import register
from ..base.units import shaft_frequency_hz
from ..machine.machine import Machine
from ..machine.option import Figures, Option
from ..mechanics.added import Added, RingForce
from ..mechanics.capabilities import Capability, OldhamRing
from ..mechanics.moving_parts import Revolution


@register
class RingDamping(Option):
    """Rubber or springs between ring and frame (thesis 7.4)."""

    kind: ClassVar[str] = "ring-damping"
    needs: ClassVar[type[Capability]] = OldhamRing
    damping_ns_per_m: float = Field(ge=0.0, le=1e6)

    def added(self, machine: Machine, revolution: Revolution) -> Added:
        """Viscous damping of the ring against the frame.

        The damping force is an internal pair and the crank prescribes the ring's motion: no
        momentum changes, so no force on the housing does. It costs the power c (ω r)² / 2.
        """
        ring = machine.require(OldhamRing)
        velocity = 2.0 * np.pi * shaft_frequency_hz(revolution.speed_rpm) * ring.stroke_m
        power = 0.5 * self.damping_ns_per_m * velocity**2
        force = self.damping_ns_per_m * velocity * np.sin(revolution.rotation.crank_angle)
        return Added(
            figures={"added_mass_kg": 0.0, "dissipated_power_w": power},
            on_ring=RingForce(force, from_housing=True),
        )

    def sentences(self, figures: Figures) -> tuple[str, ...]:
        """Say what the damping costs."""
        cost = rounding.span(figures["dissipated_power_w"], rounding.significant)
        return (f"It dissipates {cost} W.",)
