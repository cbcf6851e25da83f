"""A scroll compressor with an Oldham coupling: masses and places of its moving parts."""

from typing import Annotated, Final

from pydantic import Field

from ...base.parameters import Contradictions, Held, Parameters
from ...machine.cavities import DischargeDome, DischargeMuffler, SuctionAnnulus
from ...machine.frame import Frame
from ...machine.machine import PART_MASS, Machine
from ...machine.shell_structure import ShellStructure, ShellVariation
from ...machine.stator_yoke import StatorYoke
from ...machine.stopping import CheckValve, Stopping, TurningBack
from ...mechanics.capabilities import HEIGHT, BalancePlanes
from ...mechanics.scroll_shaft import ScrollShaft
from ...sources.air_gap.parameters import AirGap
from ...sources.induction_motor.revolving_fields import CapacitorMotor, TurningRotor
from ...sources.oldham_keys.contact import OldhamKeys
from ...sources.scroll_gas.parameters import (
    ScrollGas,
    ScrollLeakage,
    ScrollOpening,
    ScrollWraps,
    SuctionPockets,
)
from ...sources.synchronous_motor.parameters import SynchronousMotor

MOST_INNER_SHARE: Final = 0.95
"""Largest share of the mass that internal parts have; wall, feet and oil are the rest."""
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


class OldhamScrollTables(Machine):
    """Values of the machine."""

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
    """Opening of a pocket with inertia."""
    leakage: ScrollLeakage | None = None
    """Leakage between the pockets then; none where they are tight."""
    suction_pockets: SuctionPockets | None = None
    """Whose pressure then acts on the scrolls; none where it is that of the suction."""
    keys: OldhamKeys | None = None
    motor: CapacitorMotor | None = None
    """Motor at its own line frequency; a study names those of its speeds."""
    synchronous_motor: SynchronousMotor | None = None
    """Motor in the other motor's place, on an inverter; a study names one of them."""
    air_gap: AirGap | None = None
    """Air gap of either motor."""
    stator_yoke: StatorYoke | None = None
    rotor: TurningRotor | None = None
    structure: ShellStructure | None = None
    """Structure of the shell, where it may bend."""
    variation: ShellVariation | None = None
    stopping: Stopping | None = None
    discharge_dome: DischargeDome | None = None
    """Gas under the top cap; none where it is silent."""
    suction_annulus: SuctionAnnulus | None = None
    """Gas around the parts, out of which the pockets fill; none where it is silent."""
    discharge_muffler: DischargeMuffler | None = None
    """Muffler in the discharge tube; its curves alone need it."""
    turning_back: TurningBack | None = None
    """Turning back after a stop, where a study asks for it."""
    check_valve: CheckValve | None = None
    shaft: ScrollShaft | None = None
    frame: Frame | None = None
    """Bodies through which the sources drive the shell; none where they do so as they are."""

    def contradictions(self) -> Contradictions:
        if self.frame is not None:
            yield from self._of_frame(self.frame)
        if self.turning_back is not None and self.brake is None:
            yield "turning_back: needs the table brake; give both or none"
        for name, table in (
            ("discharge_dome", self.discharge_dome),
            ("suction_annulus", self.suction_annulus),
        ):
            reason = table and table.why_not_in(self.shell)
            if reason:
                yield f"{name}.{reason}"

    def _of_frame(self, frame: Frame) -> Contradictions:
        if self.shaft is None:
            yield "frame: needs the table shaft"
            return
        inner_kg = frame.mass_kg + self.shaft.mass_kg
        if inner_kg > MOST_INNER_SHARE * self.housing.mass_kg:
            yield (
                f"housing.mass_kg = {self.housing.mass_kg:g} kg: frame, stator and shaft weigh "
                f"{inner_kg:.4g} kg; {100.0 * MOST_INNER_SHARE:g} % of all is the most in a shell"
            )
