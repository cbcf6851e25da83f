"""A twin Oldham ring in opposite phase (thesis 7.3)."""

from collections.abc import Mapping
from typing import ClassVar

import numpy as np
from pydantic import Field

from ..base.errors import ParameterError
from ..base.parameters import Parameters
from ..base.registry import register
from ..machine.machine import Machine
from ..machine.option import Option
from ..mechanics.added import Added, FurtherRing, RingForce
from ..mechanics.capabilities import Capability, OldhamRing, Slider
from ..mechanics.moving_parts import MovingPart, Revolution, path


class TwinRing(Parameters):
    """A second ring with the piece that it keeps from turning."""

    mass_kg: float | None = Field(default=None, gt=0.0, le=100.0)
    """Mass of the machine's ring where it is none."""
    stroke_ratio: float = Field(default=1.0, gt=0.0, le=10.0)
    """Stroke amplitude of the twin over that of the ring."""
    distance_below_ring_m: float | None = Field(default=None, ge=-2.0, le=2.0)
    """Down to the machine's lower counterweight where it is none."""
    driven_inertia_kg_m2: float | None = Field(default=None, gt=0.0, le=10.0)
    """Piece on the eccentric about its centre; as the orbiting scroll where it is none."""
    drag_n_m: float = Field(default=0.0, ge=0.0, le=100.0)
    """Torque of the eccentric's oil film on the piece."""

    def beside(
        self,
        machine: Machine,
        revolution: Revolution,
        moment_n_m: float = 0.0,
        on_ring: RingForce | None = None,
    ) -> Added:
        """Second ring, 180° out of phase, at the other end of the shaft (thesis eq. 7.21).

        The force cancels; force times the distance of the two rings remains as a couple. The piece
        that drives the twin is taken as balanced on the shaft.

        Parameters
        ----------
        machine : with a ring
        revolution : revolution of the machine
        moment_n_m : moment of a spring on the driven piece
        on_ring : force of a spring on the twin
        """
        ring = machine.require(OldhamRing)
        mass_kg = ring.mass_kg if self.mass_kg is None else self.mass_kg
        amplitude = self.stroke_ratio * ring.stroke_m
        height_m = self._height_m(machine, ring)
        history = path(-amplitude * np.cos(revolution.rotation.crank_angle), 0.0, height_m)
        twin = FurtherRing(
            mass_kg,
            amplitude,
            height_m,
            self.driven_inertia_kg_m2,
            self.drag_n_m + moment_n_m,
            on_ring,
        )
        return Added(
            (MovingPart("balancer", mass_kg, history),),
            {"added_mass_kg": mass_kg},
            rings=(twin,),
        )

    def _height_m(self, machine: Machine, ring: OldhamRing) -> float:
        """Height of the twin above the centre of mass at rest."""
        if self.distance_below_ring_m is not None:
            return ring.height_m - self.distance_below_ring_m
        slider = machine.capability(Slider)
        if slider is None:
            raise ParameterError(
                "distance_below_ring_mm: is missing; the machine has no counterweights to place "
                "the second ring by"
            )
        return slider.planes.lower_height_m


@register
class TwinOldham(TwinRing, Option):
    """A second Oldham ring in opposite phase at the other end of the shaft (thesis 7.3)."""

    kind: ClassVar[str] = "twin-oldham"
    needs: ClassVar[type[Capability]] = OldhamRing
    labels: ClassVar[Mapping[str, str]] = {
        "twin_key_impacts_per_revolution": "Impacts of the second ring's keys per revolution",
        "twin_key_force_peak_n": "Largest force on a key of the second ring",
    }

    def added(self, machine: Machine, revolution: Revolution) -> Added:
        """The second ring without a spring; see `TwinRing.beside`."""
        return self.beside(machine, revolution)

    def leaves_out(self, inner_sources: bool) -> tuple[str, ...]:
        """Keys without gas load, where they are not simulated."""
        if inner_sources:
            return ()
        return (
            "No gas force presses the keys of a second ring: they are likely to rattle. Rattle can "
            "be louder than the 1× line that the ring removes.",
        )
