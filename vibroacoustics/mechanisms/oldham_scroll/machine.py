"""A scroll compressor with an Oldham coupling: its kind and what it does."""

from collections.abc import Iterable
from typing import ClassVar, Final

from ...base.arrays import Array
from ...base.curves import Curve
from ...base.registry import register
from ...machine.derived import ROUND_INERTIAS, Derived, in_proportion
from ...machine.machine import Machine
from ...machine.speed_growth import SCROLL_OR_SCREW, Growth
from ...mechanics.capabilities import UPRIGHT, Capability, OldhamRing, Slider
from ...mechanics.moving_parts import MovingPart, Revolution
from .parameters import OldhamScrollTables


@register
class OldhamScroll(OldhamScrollTables):
    """The shaft stands upright, the ring slides along x."""

    kind: ClassVar[str] = "oldham-scroll"
    template: ClassVar[str] = "copeland_derived.toml"
    template_with_sources: ClassVar[str] = "copeland_sources.toml"
    speed_growth: ClassVar[Growth] = SCROLL_OR_SCREW
    axes: ClassVar[str] = "the Oldham stroke (x), across (y) and along the shaft (z)"
    orders: ClassVar[str] = (
        "The stroke of the ring is a pure cosine of the crank angle, so order 2 of the ring "
        "alone is zero. Higher orders come from options."
    )
    derived: ClassVar[tuple[Derived, ...]] = (
        *ROUND_INERTIAS,
        Derived(
            "kinematics.orbit_radius_m",
            ("wraps.base_radius_m", "wraps.thickness_m"),
            lambda machine: machine.wraps and machine.wraps.orbit_radius_m,
        ),
        in_proportion("keys.ring_inertia_kg_m2", "oldham.mass_kg"),
        in_proportion("keys.scroll_inertia_kg_m2", "orbiting_scroll.mass_kg"),
        in_proportion("frame.orbiting_scroll.mass_kg", "orbiting_scroll.mass_kg"),
        in_proportion("frame.orbiting_scroll.height_m", "orbiting_scroll.height_m"),
        in_proportion("frame.keys_radius_m", "keys.radius_m"),
        in_proportion("discharge_dome.tube_diameter_m", "opening.tube_diameter_m"),
        in_proportion("suction_pockets.sound_speed_m_per_s", "suction_annulus.sound_speed_m_per_s"),
    )
    reads: ClassVar[frozenset[str]] = Machine.reads | {"brake"}

    @property
    def capabilities(self) -> tuple[Capability, ...]:
        """The Oldham ring, also as a mass that slides to and fro."""
        ring = self.oldham
        stroke = self.kinematics.orbit_radius_m
        return (
            Slider(ring.mass_kg, stroke, ring.height_m, self.counterweights, UPRIGHT),
            OldhamRing(ring.mass_kg, stroke, ring.height_m),
        )

    def revolution(self, speed_rpm: float, samples: int) -> Revolution:
        """Steady revolution of the moving parts; see `oldham_scroll`."""
        from .revolution import oldham_scroll

        return oldham_scroll(self, speed_rpm, samples)

    def moving_parts(self, crank_angle: Array) -> tuple[MovingPart, ...]:
        """Ring, orbiting scroll, pin, a brake where there is one, and counterweights."""
        from .revolution import scroll_parts

        return scroll_parts(self, crank_angle)

    def curves(self, speed_rpm: float) -> Iterable[Curve]:
        """Force of the ring, critical speeds of the shaft; see `oldham_scroll_curves`."""
        from .curves import oldham_scroll_curves

        return oldham_scroll_curves(self, speed_rpm)

    def leaves_out(self, inner_sources: bool) -> tuple[str, ...]:
        """Effects that the model neglects, without and with gas, keys and motor."""
        return (*_LEAVES_OUT, *(_WITH_SOURCES if inner_sources else _WITHOUT_SOURCES))


_LEAVES_OUT: Final = (
    "A weight on the shaft turns: it lowers the force along the stroke of the ring and makes one "
    "across it. The machine's own counterweights may already hold part of it; they are taken to "
    "balance scroll, pin and brake only.",
)
_WITHOUT_SOURCES: Final = (
    "The shaft turns at constant speed; torque ripple, twice-line torque of the motor and key "
    "slap are not modelled.",
)
_WITH_SOURCES: Final = (
    "Forces of the moving parts and keys are those at constant speed; torque ripple and the "
    "motor's torque act on stator and machine only. The ring's keys have impacts along a clearance "
    "and its bodies are rigid; all four have the same clearance, friction and stiffness.",
)
