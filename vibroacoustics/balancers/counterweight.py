"""A free weight on the shaft: mass, radius, angle and height."""

from math import pi
from typing import ClassVar

from pydantic import Field

from ..base.registry import register
from ..machine.machine import Machine
from ..machine.option import Option
from ..mechanics.added import Added
from ..mechanics.capabilities import HEIGHT
from ..mechanics.moving_parts import Revolution, circling


@register
class Counterweight(Option):
    """A weight anywhere on the shaft of any machine."""

    kind: ClassVar[str] = "counterweight"
    mass_kg: float = Field(gt=0.0, le=100.0)
    radius_m: float = Field(gt=0.0, le=0.5)
    """Radius of its centre of mass from the shaft's axis."""
    angle_rad: float = Field(ge=-2.0 * pi, le=2.0 * pi)
    """Angle by which it leads the crank pin; 180° is opposite."""
    height_m: float = HEIGHT
    """Height along the shaft from the origin of the machine's crank frame."""

    def added(self, machine: Machine, revolution: Revolution) -> Added:
        """One mass that circles the shaft's axis with the crank."""
        weight = circling(
            "balancer",
            self.mass_kg,
            self.radius_m,
            self.height_m,
            revolution.rotation.crank_angle + self.angle_rad,
            machine.crank_frame,
        )
        return Added((weight,), {"added_mass_kg": self.mass_kg})
