"""A torsion spring that presses the keys of an Oldham ring."""

from typing import ClassVar

from pydantic import Field

from ..base.registry import register
from ..machine.machine import Machine
from ..machine.option import Option
from ..mechanics.added import Added
from ..mechanics.capabilities import Capability, OldhamRing
from ..mechanics.moving_parts import Revolution
from .twin_oldham import TwinRing


@register
class TorsionSpring(Option):
    """A spring between the part that a ring keeps from turning and the housing.

    The part orbits without turning, so the torque is the preload. Both pairs of keys stay in
    contact while it and the gas exceed m r ω² R/(1 - µ), some 7 % more at µ = 0.1.
    """

    kind: ClassVar[str] = "torsion-spring"
    needs: ClassVar[type[Capability]] = OldhamRing
    preload_n_m: float = Field(gt=0.0, le=1e3)
    twin: TwinRing | None = None
    """Second ring, whose driven piece the spring turns; without it, the orbiting scroll."""

    def added(self, machine: Machine, revolution: Revolution) -> Added:
        """The preload, in the sense of the gas torque."""
        if self.twin is not None:
            return self.twin.beside(machine, revolution, self.preload_n_m)
        return Added(figures={"added_mass_kg": 0.0}, on_scroll_n_m=self.preload_n_m)

    def leaves_out(self, inner_sources: bool) -> tuple[str, ...]:
        """Mass and friction of the spring."""
        return ("The torsion spring has no mass, and its sideways force is neglected.",)
