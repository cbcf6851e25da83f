"""Pendulums in the horizontal plane on the Oldham ring (thesis 7.1)."""

from collections.abc import Mapping
from typing import ClassVar, Literal

import numpy as np
from pydantic import Field

from ..base import rounding
from ..base.registry import register
from ..base.units import shaft_frequency_hz
from ..machine.machine import Machine
from ..machine.option import Figures, Option
from ..mechanics.added import Added, RingForce
from ..mechanics.capabilities import Capability, OldhamRing
from ..mechanics.moving_parts import MovingPart, Revolution, path, wrench
from ..mechanics.pendulum import Drive, multiplier, periodic_state, settle, swing
from .pendulum import pendulum_mass


@register
class HorizontalPendulum(Option):
    """Arms across the stroke that swing in the plane of the ring (thesis 7.1).

    "The right placing would be to set them in the horizontal plane but there is no physical space
    to make them symmetrical": two on both sides of the ring, or one on one side. No weight turns
    them back; the arms settle along the stroke (P. L. Kapitza, Sov. Phys. JETP 21 (1951) 588).
    """

    kind: ClassVar[str] = "horizontal-pendulum"
    needs: ClassVar[type[Capability]] = OldhamRing
    labels: ClassVar[Mapping[str, str]] = {
        "settled_from_across_deg": "Mean angle in which the arms settle, from across the stroke",
        "across_multiplier": "Growth per revolution across the stroke (Floquet multiplier)",
        "along_multiplier": "Growth per revolution as settled (Floquet multiplier)",
    }
    length_m: float = Field(ge=1e-3, le=1.0)
    horizontal_reach_m: float = Field(ge=1e-3, le=1.0)
    """Reach of (7.5), from which the mass follows."""
    arms: Literal[1, 2]
    """2 are mirror images across the stroke; 1 has the mass of both, on the side of y."""
    pivot_m: float = Field(ge=0.0, le=1.0)
    """Distance of the pivots from the centre of the ring, across the stroke."""
    damping_ratio: float = Field(ge=1e-5, le=1.0)
    """Damping of the bearing, over twice the bob's inertia and the shaft's angular frequency."""

    def added(self, machine: Machine, revolution: Revolution) -> Added:
        """Bobs in the periodic state that they settle in."""
        ring, rotation = machine.require(OldhamRing), revolution.rotation
        mass = pendulum_mass(ring.stroke_m, ring.mass_kg, self.horizontal_reach_m)
        frequency = shaft_frequency_hz(revolution.speed_rpm)
        drive = Drive(self.length_m, self.damping_ratio, ring.stroke_m, frequency, level=True)
        settled = settle(drive)
        across = periodic_state(drive, (-ring.stroke_m / self.length_m, 0.0))
        angle = swing(drive, settled, rotation.crank_angle)
        along = ring.stroke_m * np.cos(rotation.crank_angle) + self.length_m * np.sin(angle)
        aside = self.pivot_m + self.length_m * np.cos(angle)
        sides = (1.0, -1.0)[: self.arms]
        parts = tuple(
            MovingPart("balancer", mass / self.arms, path(along, side * aside, ring.height_m))
            for side in sides
        )
        return Added(
            parts,
            {
                "added_mass_kg": mass,
                "settled_from_across_deg": float(np.rad2deg(abs(np.mean(angle)))),
                "across_multiplier": multiplier(drive, across),
                "along_multiplier": multiplier(drive, settled),
            },
            RingForce(wrench(parts, rotation).force_n[0]),
        )

    def leaves_out(self, inner_sources: bool) -> tuple[str, ...]:
        """Say what the arms would hit."""
        return ("Arms in the horizontal plane meet no stops, and the ring is taken as guided.",)

    def sentences(self, figures: Figures) -> tuple[str, ...]:
        """Say where the arms settle."""
        where = rounding.span(abs(figures["settled_from_across_deg"]), rounding.fixed)
        return (f"The arms settle {where}° from across the stroke; stops are not modelled.",)
