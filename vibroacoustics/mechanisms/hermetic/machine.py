"""A hermetic reciprocating compressor: its kind and what it does."""

from collections.abc import Iterable
from typing import ClassVar, Final

from ...base.curves import Curve
from ...base.registry import register
from ...machine.gas_in_shell import GAS_PATH_PARTLY
from ...machine.speed_growth import RECIPROCATING, Growth
from ...mechanics.capabilities import Capability, Slider
from ...mechanics.moving_parts import Revolution
from .parameters import HermeticTables


@register
class HermeticCompressor(HermeticTables):
    """The cylinder lies along x, the shaft stands upright with the motor below the crank."""

    kind: ClassVar[str] = "hermetic-reciprocating"
    template: ClassVar[str] = "estupinan_hermetic.toml"
    template_with_sources: ClassVar[str] = "estupinan_sources.toml"
    runs_up: ClassVar[bool] = False
    speed_growth: ClassVar[Growth] = RECIPROCATING

    @property
    def capabilities(self) -> tuple[Capability, ...]:
        """Piston and the part of the rod that goes with it, by its two eyes; cylinder."""
        from .gas import valved_cylinder

        rod, planes = self.rod, self.counterweights.counted_down
        share = rod.mass_kg * (1.0 - rod.centre_of_mass_m / rod.length_m)
        slider = Slider(
            self.piston.mass_kg + share,
            self.crank.radius_m,
            -self.crank.pin_offset_m,
            planes,
            self.crank_frame,
        )
        return slider, valved_cylinder(self)

    def revolution(self, speed_rpm: float, samples: int) -> Revolution:
        """Steady revolution of the moving parts; see `hermetic_revolution`."""
        from .revolution import hermetic_revolution

        return hermetic_revolution(self, speed_rpm, samples)

    def curves(self, speed_rpm: float) -> Iterable[Curve]:
        """Forces, orbits and films over the crank angle; see `hermetic_curves`."""
        from .curves import hermetic_curves

        return hermetic_curves(self, speed_rpm)

    def leaves_out(self, inner_sources: bool) -> tuple[str, ...]:
        """Effects that the model neglects."""
        return *_LEAVES_OUT, GAS_PATH_PARTLY if inner_sources else _GAS_PATH


_GAS_PATH: Final = (
    "The gas in the shell, which carries sound from the block to the shell, is not modelled."
)
_LEAVES_OUT: Final = (
    "Friction of the piston and drag of the oil films are neglected, as in the paper: the shaft "
    "power is that of the gas and of the films that are squeezed.",
    "The springs of the block are linear and meet no stops; the weight of the block, start and "
    "stop are not modelled. The tube has no mass, hence no resonance of its own.",
    "The valves open without loss.",
    "An option that puts weights on the shaft leaves the films as they are; a redesign of the "
    "crank has its own.",
)
