"""Planks that one-way springs couple to the Oldham ring (thesis 7.2, figures 30 and 31)."""

from collections.abc import Mapping
from typing import ClassVar

import numpy as np
from pydantic import Field

from ..base import rounding
from ..base.registry import register
from ..base.units import shaft_frequency_hz
from ..machine.machine import Machine
from ..machine.option import Figures, Option
from ..mechanics.added import Added, RingForce
from ..mechanics.bilinear import Bilinear, stretch
from ..mechanics.capabilities import Capability, OldhamRing
from ..mechanics.moving_parts import MovingPart, Revolution, path, wrench


@register
class OneWaySprings(Option):
    """Two planks in slots along the stroke, one on each side of the ring (thesis 7.2).

    The ring pulls each inwards by a stiff spring and pushes it outwards by a soft one: "almost no
    strength when stressed in one direction and lots of strength when moving in the opposite one".
    The thesis gives no value.
    """

    kind: ClassVar[str] = "one-way-springs"
    needs: ClassVar[type[Capability]] = OldhamRing
    labels: ClassVar[Mapping[str, str]] = {
        "plank_amplitude_mm": "Half the way of each plank on its one-way spring",
        "one_way_resonance_rpm": "Speed at which a plank resonates on its one-way spring",
    }
    mass_kg: float = Field(gt=0.0, le=10.0)
    """Mass of both planks together."""
    stiffness_n_per_m: float = Field(gt=0.0, le=1e7)
    """Stiffness of each spring when it pulls its plank inwards."""
    pushing_ratio: float = Field(ge=1e-4, le=1.0)
    """Stiffness when it pushes outwards over that when it pulls."""
    damping_ratio: float = Field(ge=1e-4, le=1.0)
    """Damping of the plank against the ring, as a fraction of critical on the stiff side."""
    height_below_ring_m: float = Field(ge=-1.0, le=1.0)

    def oscillator(self, speed_rpm: float) -> Bilinear:
        """One plank on its spring, over the crank angle."""
        inertia = 0.5 * self.mass_kg * (2.0 * np.pi * shaft_frequency_hz(speed_rpm)) ** 2
        pulled = self.stiffness_n_per_m / inertia
        damping = self.damping_ratio * float(np.sqrt(pulled))
        return Bilinear(pulled, self.pushing_ratio * pulled, damping)

    def added(self, machine: Machine, revolution: Revolution) -> Added:
        """The planks as the ring moves them at the revolution's speed.

        The one on the left does half a turn later what that on the right does, mirrored.
        """
        ring, rotation = machine.require(OldhamRing), revolution.rotation
        oscillator, samples = self.oscillator(revolution.speed_rpm), rotation.crank_angle.size
        wide, rates = stretch(oscillator, 2 * samples)
        along = ring.stroke_m * (np.cos(np.pi * np.arange(2 * samples) / samples) + wide)
        right, returning = along[::2], -np.roll(along, -samples)[::2]
        height = ring.height_m - self.height_below_ring_m
        parts = tuple(
            MovingPart("balancer", 0.5 * self.mass_kg, path(x, 0.0, height))
            for x in (right, returning)
        )
        angular = 2.0 * np.pi * shaft_frequency_hz(revolution.speed_rpm)
        slip = ring.stroke_m * angular * rates
        damper = self.mass_kg * angular * oscillator.damping
        return Added(
            parts,
            {
                "added_mass_kg": self.mass_kg,
                "plank_amplitude_mm": 500.0 * float(np.ptp(along)),
                "one_way_resonance_rpm": oscillator.natural_ratio * revolution.speed_rpm,
                "dissipated_power_w": 2.0 * damper * float(np.mean(slip**2)),
            },
            RingForce(wrench(parts, rotation).force_n[0], inertial=False),
        )

    def leaves_out(self, inner_sources: bool) -> tuple[str, ...]:
        """Slots and stops."""
        return ("Planks on one-way springs meet no stops; their slots have no friction.",)

    def sentences(self, figures: Figures) -> tuple[str, ...]:
        """Their way, their resonance and what they cost."""
        size = rounding.span(figures["plank_amplitude_mm"], rounding.significant)
        speed = rounding.span(figures["one_way_resonance_rpm"], lambda rpm: rounding.fixed(rpm, 0))
        cost = rounding.span(figures["dissipated_power_w"], rounding.significant)
        return (
            f"Its planks move by ±{size} mm.",
            f"They resonate at {speed} rpm, also during run-up.",
            f"It dissipates {cost} W.",
        )
