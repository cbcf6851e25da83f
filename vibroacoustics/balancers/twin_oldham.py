"""A twin Oldham ring in opposite phase (thesis 7.3)."""

from collections.abc import Mapping
from typing import ClassVar

import numpy as np
from pydantic import Field

from ..base.registry import register
from ..machine.machine import Machine
from ..machine.option import Option
from ..mechanics.added import Added, FurtherRing
from ..mechanics.capabilities import Capability, OldhamRing
from ..mechanics.moving_parts import MovingPart, Revolution, path


@register
class TwinOldham(Option):
    """A second Oldham ring in opposite phase at the other end of the shaft (thesis 7.3)."""

    kind: ClassVar[str] = "twin-oldham"
    needs: ClassVar[type[Capability]] = OldhamRing
    labels: ClassVar[Mapping[str, str]] = {
        "twin_key_impacts_per_revolution": "Impacts of the second ring's keys per revolution",
        "twin_key_force_peak_n": "Largest force on a key of the second ring",
    }
    mass_kg: float = Field(gt=0.0, le=100.0)
    stroke_ratio: float = Field(gt=0.0, le=10.0)
    """Stroke amplitude of the twin over that of the ring."""
    distance_below_ring_m: float = Field(ge=-2.0, le=2.0)

    def added(self, machine: Machine, revolution: Revolution) -> Added:
        """Second ring, 180° out of phase, at the other end of the shaft (thesis eq. 7.21).

        The force cancels; force times the distance of the two rings remains as a couple. The piece
        that drives the twin is taken as balanced on the shaft.
        """
        ring = machine.require(OldhamRing)
        amplitude = self.stroke_ratio * ring.stroke_m
        height_m = ring.height_m - self.distance_below_ring_m
        course = path(-amplitude * np.cos(revolution.rotation.crank_angle), 0.0, height_m)
        return Added(
            (MovingPart("balancer", self.mass_kg, course),),
            {"added_mass_kg": self.mass_kg},
            rings=(FurtherRing(self.mass_kg, amplitude, height_m),),
        )

    def leaves_out(self, inner_sources: bool) -> tuple[str, ...]:
        """Keys without gas load, where they are not simulated."""
        if inner_sources:
            return ()
        return (
            "A second ring has no gas force that presses its keys: they are likely to rattle, "
            "which can be louder than the 1× line that it removes.",
        )
