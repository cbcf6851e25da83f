"""A slider-link compressor: its kind and what it does."""

from collections.abc import Iterable
from math import inf
from typing import Any, ClassVar, Final

from ...base.curves import Curve
from ...base.registry import register
from ...machine.gas_in_shell import GAS_PATH_PARTLY
from ...machine.limits import Limit
from ...machine.machine import Machine
from ...machine.speed_growth import RECIPROCATING, Growth
from ...mechanics.capabilities import Capability, Slider
from ...mechanics.moving_parts import Revolution
from .parameters import SliderLinkTables

THINNEST_RING: Final = 0.999
"""Inner over outer radius of the thrust bearing."""


def _piston_length_m(machine: Any) -> tuple[float, float]:
    """Longer than the cylinder by half the slider, or the link would hit it."""
    sizes = machine.mechanism
    return sizes.cylinder_length_m + 0.5 * sizes.slider_diameter_m, inf


def _inner_radius_m(machine: Any) -> tuple[float, float]:
    return 0.0, THINNEST_RING * machine.bearings.thrust.outer_radius_m


SIZES: Final = (
    Limit("mechanism.piston_length_m", _piston_length_m),
    Limit("bearings.thrust.inner_radius_m", _inner_radius_m),
)


@register
class SliderLinkMachine(SliderLinkTables):
    """The shaft is upright, the cylinder lies along x over the block's centre of mass.

    The origin is the block's centre of mass [G_c], not the shell's.
    """

    kind: ClassVar[str] = "slider-link"
    template: ClassVar[str] = "dagilis_slider_link.toml"
    template_with_sources: ClassVar[str] = "dagilis_sources.toml"
    runs_up: ClassVar[bool] = False
    speed_growth: ClassVar[Growth] = RECIPROCATING
    axes: ClassVar[str] = "along the cylinder (x), across (y) and along the shaft (z)"
    orders: ClassVar[str] = (
        "Link and slider move the piston by a pure cosine of the crank angle. Orders above the "
        "first are due to the variation of the shaft's speed under the gas load. Orders are "
        "multiples of the mean shaft frequency in time."
    )
    limits: ClassVar[tuple[Limit, ...]] = (*Machine.limits, *SIZES)

    @property
    def capabilities(self) -> tuple[Capability, ...]:
        """Piston and link, as the slider goes round with the crank pin; cylinder."""
        from .piston import valved_cylinder

        slider = Slider(
            self.masses.piston_mass_kg,
            self.mechanism.crank_radius_m,
            -self.heights.piston_axis_m,
            self.counterweights.counted_down,
            self.crank_frame,
        )
        return slider, valved_cylinder(self.mechanism, self.gas)

    def revolution(self, speed_rpm: float, samples: int) -> Revolution:
        """Steady revolution of the moving parts; see `slider_link_revolution`."""
        from .revolution import slider_link_revolution

        return slider_link_revolution(self, speed_rpm, samples)

    def curves(self, speed_rpm: float) -> Iterable[Curve]:
        """Forces and friction over the crank angle; see `slider_link_curves`."""
        from .curves import slider_link_curves

        return slider_link_curves(self, speed_rpm)

    def leaves_out(self, inner_sources: bool) -> tuple[str, ...]:
        """Effects that the model neglects."""
        return *_LEAVES_OUT, GAS_PATH_PARTLY if inner_sources else _GAS_PATH


_GAS_PATH: Final = (
    "Sound and force from the block to the shell through gas and oil are neglected. "
    "Above some hundred hertz they can exceed those through the springs."
)


_LEAVES_OUT: Final = (
    "Start and stop, in which the block swings widely on its springs, are not modelled, nor are "
    "impacts of the block on the shell. Springs and discharge tube are linear and without mass: "
    "their own resonances are missing.",
    "A weight on the shaft turns: it lowers the force along the stroke and makes one across it. "
    "It adds to the shaft's own counterweight, which holds the slider and a part of the piston "
    "already. The couple of an option's weights about the block's centre of mass is included, "
    "their share in its mass and inertia is not.",
    "The motor's torque falls linearly with the speed; its pulsation at twice the line frequency "
    "is not modelled.",
)
