"""Pendulums hung from the Oldham ring (thesis 7.1): the driven nonlinear pendulum."""

from collections.abc import Mapping
from typing import ClassVar

import numpy as np
from pydantic import Field

from ..base import rounding
from ..base.errors import ParameterError
from ..base.registry import register
from ..base.units import shaft_frequency_hz
from ..machine.machine import Machine
from ..machine.option import Figures, Option
from ..mechanics.added import Added, RingForce
from ..mechanics.capabilities import Capability, OldhamRing
from ..mechanics.moving_parts import MovingPart, Revolution, path, wrench
from ..mechanics.pendulum import Drive, multiplier, periodic_state, settle, swing


@register
class Pendulum(Option):
    """Two equal pendulums hung from the Oldham ring (thesis 7.1).

    The masses follow from (7.5): all of the ring's momentum is to be taken by bobs that swing out
    by `horizontal_reach_m` at the end of the stroke.
    """

    kind: ClassVar[str] = "pendulum"
    needs: ClassVar[type[Capability]] = OldhamRing
    labels: ClassVar[Mapping[str, str]] = {
        "settled_angle_deg": "Mean angle in which the pendulum settles, from hanging (to either "
        "side)",
        "hanging_multiplier": "Growth per revolution when hanging (Floquet multiplier)",
        "settled_multiplier": "Growth per revolution when settled (Floquet multiplier)",
    }
    length_m: float = Field(ge=1e-3, le=1.0)
    horizontal_reach_m: float = Field(ge=1e-3, le=1.0)
    damping_ratio: float = Field(ge=1e-4, le=1.0)
    """Damping of the bearing, as a fraction of critical of the hanging pendulum."""

    def added(self, machine: Machine, revolution: Revolution) -> Added:
        """Two equal pendulums on the ring, in the periodic state that they settle in.

        Both bobs are taken on the same side, so that their vertical forces add. Their arms to
        either side of the ring are equal: one bob of the total mass in the middle makes the same
        force and moment.
        """
        ring, rotation = machine.require(OldhamRing), revolution.rotation
        stroke = ring.stroke_m
        mass = pendulum_mass(stroke, ring.mass_kg, self.horizontal_reach_m)
        frequency = shaft_frequency_hz(revolution.speed_rpm)
        drive = Drive(self.length_m, self.damping_ratio, stroke, frequency)
        settled = settle(drive)
        hanging = periodic_state(drive, (-stroke / self.length_m, 0.0))
        angle = swing(drive, settled, rotation.crank_angle)
        bob = path(
            stroke * np.cos(rotation.crank_angle) + self.length_m * np.sin(angle),
            0.0,
            ring.height_m - self.length_m * np.cos(angle),
        )
        part = MovingPart("balancer", mass, bob)
        return Added(
            (part,),
            {
                "added_mass_kg": mass,
                "settled_angle_deg": float(np.rad2deg(abs(np.mean(angle)))),
                "hanging_multiplier": multiplier(drive, hanging),
                "settled_multiplier": multiplier(drive, settled),
            },
            RingForce(wrench((part,), rotation).force_n[0]),
        )

    def leaves_out(self, inner_sources: bool) -> tuple[str, ...]:
        """Say where the bobs hang, and what they would hit."""
        return (
            "Both bobs of a pendulum option are on the same side, so that their vertical forces "
            "add. On opposite sides the vertical 1× force would cancel. Stops are neglected.",
        )

    def sentences(self, figures: Figures) -> tuple[str, ...]:
        """Whether hanging is stable, and where the pendulum settles."""
        growth = figures["hanging_multiplier"]
        size = rounding.span(growth, lambda value: rounding.fixed(value, 2))
        state = "stable" if growth.max() < 1.0 else "stable at some of the speeds only"
        if growth.min() > 1.0:
            state = "unstable"
        where = rounding.span(abs(figures["settled_angle_deg"]), rounding.fixed)
        return (
            f"Hanging is {state} (Floquet multiplier {size}).",
            f"It settles {where}° from hanging on average.",
        )


def pendulum_mass(stroke_m: float, ring_mass_kg: float, horizontal_reach_m: float) -> float:
    """Total bob mass of thesis (7.5) and (7.10): m = x_b M / (l_h - x_b), kg.

    Raises
    ------
    ParameterError
        The bobs cannot swing farther out than the ring moves.
    """
    if horizontal_reach_m <= stroke_m:
        raise ParameterError(
            f"horizontal_reach_mm = {1e3 * horizontal_reach_m:g} mm: must exceed the "
            f"ring's stroke amplitude of {1e3 * stroke_m:g} mm"
        )
    return stroke_m * ring_mass_kg / (horizontal_reach_m - stroke_m)
