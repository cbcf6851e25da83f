"""A scroll compressor with an Oldham coupling: masses and places of its moving parts."""

from collections.abc import Iterable
from typing import Annotated, ClassVar, Final

from pydantic import Field, model_validator

from ...base.arrays import Array
from ...base.curves import Curve
from ...base.parameters import Held, Parameters
from ...base.registry import register
from ...machine.cavities import DischargeDome, DischargeMuffler, SuctionAnnulus
from ...machine.derived import ROUND_INERTIAS, Derived, in_proportion
from ...machine.frame import Frame
from ...machine.machine import PART_MASS, Machine
from ...machine.shell_structure import ShellStructure, ShellVariation
from ...machine.stator_yoke import StatorYoke
from ...machine.stopping import Stopping
from ...machine.turning_back import CheckValve, TurningBack
from ...mechanics.capabilities import (
    HEIGHT,
    UPRIGHT,
    BalancePlanes,
    Capability,
    OldhamRing,
    Slider,
)
from ...mechanics.moving_parts import MovingPart, Revolution
from ...mechanics.scroll_shaft import ScrollShaft
from ...sources.air_gap.parameters import AirGap
from ...sources.induction_motor.parameters import CapacitorMotor, TurningRotor
from ...sources.oldham_keys.parameters import OldhamKeys
from ...sources.scroll_gas.parameters import (
    ScrollGas,
    ScrollLeakage,
    ScrollOpening,
    ScrollWraps,
    SuctionPockets,
)
from ...sources.synchronous_motor.parameters import SynchronousMotor

MOST_INNER_SHARE: Final = 0.95
"""Of the mass; wall, feet and oil are the rest."""
STROKES: Final = Held("may be printed or derived: two studies, no range")


class Kinematics(Parameters):
    orbit_radius_m: Annotated[float, STROKES] = Field(ge=1e-4, le=0.05)
    """Radius of the orbit of the scroll; the Oldham ring's stroke amplitude equals it."""


class Ring(Parameters):
    mass_kg: float = PART_MASS
    height_m: float = HEIGHT


class OrbitingPart(Parameters):
    """A part whose centre of mass circles the shaft axis, in phase with the crank pin."""

    mass_kg: float = PART_MASS
    radius_m: float | None = Field(default=None, gt=0.0, le=0.5)
    """Radius of its circle; the orbit radius where none is given."""
    height_m: float = HEIGHT


@register
class OldhamScroll(Machine):
    """The shaft stands upright, the ring slides along x."""

    kind: ClassVar[str] = "oldham-scroll"
    axes: ClassVar[str] = "the Oldham stroke (x), across (y) and along the shaft (z)"
    orders: ClassVar[str] = (
        "The stroke of the ring is a pure cosine of the crank angle, so order 2 of the ring "
        "alone is zero; higher orders come from what an option adds."
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
    kinematics: Kinematics
    oldham: Ring
    orbiting_scroll: OrbitingPart
    crank_pin: OrbitingPart
    brake: OrbitingPart | None = None
    """Against turning back; none where a valve or nothing does that."""
    counterweights: BalancePlanes
    """The mass moments follow from two-plane balance of the orbiting parts."""
    wraps: ScrollWraps | None = None
    gas: ScrollGas | None = None
    opening: ScrollOpening | None = None
    """Where a pocket opens with inertia."""
    leakage: ScrollLeakage | None = None
    """Between the pockets then; none where they are tight."""
    suction_pockets: SuctionPockets | None = None
    """Whose pressure then acts on the scrolls; none where it is that of the suction."""
    keys: OldhamKeys | None = None
    motor: CapacitorMotor | None = None
    """At its own line frequency; a study names those of its speeds."""
    synchronous_motor: SynchronousMotor | None = None
    """In the other motor's place, on an inverter; a study names one of them."""
    air_gap: AirGap | None = None
    """Of either motor."""
    stator_yoke: StatorYoke | None = None
    rotor: TurningRotor | None = None
    structure: ShellStructure | None = None
    """Of the shell, where it may bend."""
    variation: ShellVariation | None = None
    stopping: Stopping | None = None
    discharge_dome: DischargeDome | None = None
    """Gas under the top cap; none where it is silent."""
    suction_annulus: SuctionAnnulus | None = None
    """Gas around the parts, out of which the pockets fill; none where it is silent."""
    discharge_muffler: DischargeMuffler | None = None
    """In the discharge tube; its curves alone need it."""
    turning_back: TurningBack | None = None
    """After a stop, where a study asks for it."""
    check_valve: CheckValve | None = None
    shaft: ScrollShaft | None = None
    frame: Frame | None = None
    """Bodies through which the sources drive the shell; none where they do so as they are."""

    @model_validator(mode="after")
    def _frame_fits(self) -> "OldhamScroll":
        if self.frame is None:
            return self
        if self.shaft is None:
            raise ValueError("frame: needs the table shaft")
        inner_kg = self.frame.mass_kg + self.shaft.mass_kg
        if inner_kg > MOST_INNER_SHARE * self.housing.mass_kg:
            raise ValueError(
                f"housing.mass_kg = {self.housing.mass_kg:g} kg: frame, stator and shaft weigh "
                f"{inner_kg:.4g} kg; {100.0 * MOST_INNER_SHARE:g} % of all is the most in a shell"
            )
        return self

    @model_validator(mode="after")
    def _brake_jams(self) -> "OldhamScroll":
        if self.turning_back is not None and self.brake is None:
            raise ValueError("turning_back: needs the table brake; leave out both or none")
        return self

    @model_validator(mode="after")
    def _gas_fits(self) -> "OldhamScroll":
        for name, table in (
            ("discharge_dome", self.discharge_dome),
            ("suction_annulus", self.suction_annulus),
        ):
            reason = table and table.why_not_in(self.shell)
            if reason:
                raise ValueError(f"{name}.{reason}")
        return self

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
        """What the model leaves out, without and with gas, keys and motor."""
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
    "motor's torque act on stator and machine only. The ring's keys strike along a clearance and "
    "its bodies are rigid; all four have the same clearance, friction and stiffness.",
)
