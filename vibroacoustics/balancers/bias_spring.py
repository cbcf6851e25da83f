"""A spring between an Oldham ring and the housing along the stroke (US 5403172)."""

from typing import ClassVar

import numpy as np
from pydantic import Field

from ..base.registry import register
from ..machine.machine import Machine
from ..machine.option import Option
from ..mechanics.added import Added, RingForce
from ..mechanics.capabilities import Capability, OldhamRing
from ..mechanics.moving_parts import Revolution
from .twin_oldham import TwinRing


@register
class BiasSpring(Option):
    """A spring that pushes the ring along its stroke (US 5403172).

    With preload P, stiffness k, gas moment M and D² = (k - m ω²)² r² + (P r/R)², the keys in the
    orbiting part keep contact while P > M/R + D or M/R > P + D; in between they lose it.
    """

    kind: ClassVar[str] = "bias-spring"
    needs: ClassVar[type[Capability]] = OldhamRing
    preload_n: float = Field(ge=0.0, le=1e5)
    """Force at half stroke."""
    stiffness_n_per_m: float = Field(ge=0.0, le=1e8)
    twin: TwinRing | None = None
    """Second ring, on which the spring acts; without it, the machine's ring."""

    def added(self, machine: Machine, revolution: Revolution) -> Added:
        """The spring's force on the ring; its reaction is on the housing."""
        stroke = machine.require(OldhamRing).stroke_m
        stroke *= 1.0 if self.twin is None else self.twin.stroke_ratio
        along = stroke * np.cos(revolution.rotation.crank_angle)
        force = RingForce(-self.preload_n - self.stiffness_n_per_m * along, True, inertial=False)
        if self.twin is not None:
            return self.twin.beside(machine, revolution, on_ring=force)
        return Added(figures={"added_mass_kg": 0.0}, on_ring=force)

    def leaves_out(self, inner_sources: bool) -> tuple[str, ...]:
        """Mass and resonances of the spring."""
        return ("The bias spring has no mass and no resonances of its own.",)
