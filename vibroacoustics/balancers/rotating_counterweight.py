"""A share of the oscillating mass moment on the shaft, opposite the crank pin."""

from typing import ClassVar

from pydantic import Field

from ..base.registry import register
from ..machine.machine import Machine
from ..machine.option import Option
from ..mechanics.added import Added
from ..mechanics.capabilities import Capability, Slider
from ..mechanics.moving_parts import Revolution, circling


@register
class RotatingCounterweight(Option):
    """A share of the oscillating mass moment on the shaft, in the machine's two balance planes."""

    kind: ClassVar[str] = "rotating-counterweight"
    needs: ClassVar[type[Capability]] = Slider
    share_ratio: float = Field(ge=0.0, le=2.0)

    def added(self, machine: Machine, revolution: Revolution) -> Added:
        """Rotating mass moment opposite the crank pin, made by weights in two planes of the shaft.

        A linear oscillation F cos ωt is two counter-rotating forces F/2. One half on the shaft
        cancels the forward one: the peak force halves in every direction (-6 dB). The two planes
        act as one at the height of the oscillating mass, so that the moment halves with the force.
        The option that the thesis missed; for a piston the classical counterweight.
        """
        slider = machine.require(Slider)
        planes = slider.planes
        moment = self.share_ratio * slider.mass_kg * slider.amplitude_m
        span = planes.upper_height_m - planes.lower_height_m
        upper_share = (slider.height_m - planes.lower_height_m) / span
        shares = {planes.upper_height_m: upper_share, planes.lower_height_m: 1.0 - upper_share}
        parts = tuple(
            circling(
                "balancer",
                abs(share) * moment / planes.radius_m,
                -planes.radius_m if share > 0.0 else planes.radius_m,
                height,
                revolution.rotation.crank_angle,
                slider.frame,
            )
            for height, share in shares.items()
        )
        return Added(parts, {"added_mass_kg": sum(part.mass_kg for part in parts)})
