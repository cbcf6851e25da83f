"""A single-acting reciprocating compressor: its kind and what it does."""

from collections.abc import Iterable
from math import pi
from typing import ClassVar, Final

from ...base.curves import Curve
from ...base.registry import register
from ...machine.machine import Machine
from ...machine.speed_growth import RECIPROCATING, Growth
from ...mechanics.capabilities import Capability, Slider
from ...mechanics.moving_parts import Revolution
from .parameters import ReciprocatingTables


@register
class ReciprocatingMachine(ReciprocatingTables):
    """One upright cylinder, or banks of them; the shaft lies along y under the centre of mass."""

    kind: ClassVar[str] = "reciprocating"
    template: ClassVar[str] = "mayekawa_wbhe.toml"
    speed_growth: ClassVar[Growth] = RECIPROCATING
    axes: ClassVar[str] = "across the shaft (x), along it (y) and upright (z)"
    orders: ClassVar[str] = (
        "The tilt of the connecting rod makes the even orders, the swing of the shaft's speed "
        "under the gas load the others. Orders are multiples of the mean shaft frequency in "
        "time."
    )
    reads: ClassVar[frozenset[str]] = Machine.reads | {"cylinders"}

    @property
    def capabilities(self) -> tuple[Capability, ...]:
        """Piston and the part of the rod that goes with it, by its two eyes, of one cylinder."""
        if self.cylinders is not None:
            return ()
        part = self.piston_and_rod
        radius = 2.0 * part.displacement_m3 / (pi * part.bore_m**2)
        rod_mass = part.rod_mass_kg * radius / part.crank_to_rod_ratio / part.rod_length_m
        share = rod_mass * part.big_end_to_centre_m / part.rod_length_m
        slider = Slider(
            part.piston_mass_kg + share,
            radius,
            0.0,
            self.counterweights,
            self.crank_frame,
        )
        return (slider,)

    def revolution(self, speed_rpm: float, samples: int) -> Revolution:
        """Steady revolution of the moving parts; see `reciprocating_revolution`."""
        from .revolution import reciprocating_revolution

        return reciprocating_revolution(self, speed_rpm, samples)

    def curves(self, speed_rpm: float) -> Iterable[Curve]:
        """Torques, friction, losses and efficiency; see `reciprocating_curves`."""
        from .curves import reciprocating_curves

        return reciprocating_curves(self, speed_rpm)

    def leaves_out(self, inner_sources: bool) -> tuple[str, ...]:
        """Effects that the model neglects."""
        return _LEAVES_OUT if self.cylinders is None else _LEAVES_OUT_OF_BANKS


_LEAVES_OUT_OF_BANKS: Final = (
    "All cylinders have the same gas and dimensions. But for the counterweights of its throws the "
    "crankshaft is balanced about its axis; it is rigid, in bending and in torsion.",
)
_LEAVES_OUT: Final = (
    "One cylinder stands for the machine. The crankshaft is balanced about its axis, the big end "
    "of the rod is not; the paper gives no counterweight. Lanchester's weights are in the plane "
    "of the cylinder's axis, without the moment of their gears.",
)
