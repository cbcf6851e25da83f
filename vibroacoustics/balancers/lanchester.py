"""Lanchester's balancer: two weights that turn in opposite senses at the shaft's speed."""

from typing import ClassVar

from pydantic import Field

from ..base.registry import register
from ..machine.machine import Machine
from ..machine.option import Option
from ..mechanics.added import Added
from ..mechanics.capabilities import Capability, Slider
from ..mechanics.moving_parts import Revolution, circling


@register
class Lanchester(Option):
    """Two weights that turn in opposite senses at the shaft's speed."""

    kind: ClassVar[str] = "lanchester"
    needs: ClassVar[type[Capability]] = Slider
    share_ratio: float = Field(ge=0.0, le=2.0)
    """Share of the oscillating mass moment that both balance together."""
    radius_m: float | None = Field(default=None, gt=0.0, le=1.0)
    """Distance of the centre of mass of each weight from its shaft; that of the machine's
    counterweights where it is none."""

    def added(self, machine: Machine, revolution: Revolution) -> Added:
        """First-order balancer: together the weights make a force along the stroke only.

        Each has half of the mass moment to balance (Lanchester 1914; Taylor, The
        Internal-Combustion Engine in Theory and Practice, vol. 2, chapter 8). They turn about the
        shaft's axis in the plane of the oscillating mass, as two shafts on either side of it would
        in the mean: no moment is left. The change of their own spin is small beside the shaft's
        and left out.
        """
        slider = machine.require(Slider)
        radius_m = slider.planes.radius_m if self.radius_m is None else self.radius_m
        mass = 0.5 * self.share_ratio * slider.mass_kg * slider.amplitude_m / radius_m
        crank_angle = revolution.rotation.crank_angle
        parts = tuple(
            circling("balancer", mass, -radius_m, slider.height_m, angle, slider.frame)
            for angle in (crank_angle, -crank_angle)
        )
        return Added(parts, {"added_mass_kg": 2.0 * mass})
