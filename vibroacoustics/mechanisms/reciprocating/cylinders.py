"""Banks of cylinders on the throws of one crankshaft, and where each cylinder stands."""

from math import cos, pi, sin
from typing import Final, NamedTuple

import numpy as np
from pydantic import Field

from ...base.arrays import Array
from ...base.parameters import Contradictions, Parameters
from ...mechanics.capabilities import CrankFrame
from ...mechanics.crankshaft import acceleration_of
from ...mechanics.moving_parts import Wrench
from ...mechanics.rotation import Rotation


class Cylinder(NamedTuple):
    """Position of one cylinder on its crankshaft.

    Attributes
    ----------
    bank_rad : angle of its axis from the crank frame's stroke, in the sense of rotation
    throw : index of its crank throw
    throw_rad : by which its crank pin runs ahead of the crank angle
    position_m : along the shaft
    """

    bank_rad: float
    throw: int
    throw_rad: float
    position_m: float

    @property
    def lead_rad(self) -> float:
        """Angle by which its crank angle from top dead centre runs ahead of the shaft's."""
        return self.throw_rad - self.bank_rad

    def frame(self, shaft: CrankFrame) -> CrankFrame:
        """Its own axes: the shaft's turned about the shaft and moved along it."""
        c, s = cos(self.bank_rad), sin(self.bank_rad)
        stroke, across = np.array(shaft.stroke), np.array(shaft.across)
        origin = np.array(shaft.origin_m) + self.position_m * np.array(shaft.shaft)
        return CrankFrame(
            stroke=tuple(c * stroke + s * across),
            across=tuple(c * across - s * stroke),
            shaft=shaft.shaft,
            origin_m=tuple(origin),
        )


class CylinderBanks(Parameters):
    """Each throw carries one rod of every bank, side by side on its pin.

    The banks of a W or a fan stand at more than two angles. Angles count in the sense of rotation.
    """

    bank_angles_rad: tuple[float, ...] = Field(min_length=1, max_length=8)
    """Angles of the cylinders' axes from upright."""
    throw_angles_rad: tuple[float, ...] = Field(min_length=1, max_length=12)
    """Angles of the crank pins from the first one's place."""
    throw_positions_m: tuple[float, ...]
    """Middle of each crank pin along the shaft."""
    rod_pitch_m: float = Field(ge=0.0, le=1.0)
    """Distance between the rods of neighbouring banks on one pin."""
    counterweight_kg_m: float = Field(default=0.0, ge=0.0, le=1e3)
    """Mass moment of the weights opposite each crank pin, in its plane."""

    def contradictions(self) -> Contradictions:
        for name, angles in (
            ("bank_angles_deg", self.bank_angles_rad),
            ("throw_angles_deg", self.throw_angles_rad),
        ):
            if any(abs(angle) > 2.0 * pi for angle in angles):
                yield f"{name}: must be from -360 ° to 360 °"
        if len(self.throw_positions_m) != len(self.throw_angles_rad):
            yield (
                f"throw_positions_mm: {len(self.throw_positions_m)} values: must be as many as "
                f"throw_angles_deg, {len(self.throw_angles_rad)}"
            )

    @property
    def cylinders(self) -> tuple[Cylinder, ...]:
        """Throw by throw, on each the banks in their order."""
        middle = 0.5 * (len(self.bank_angles_rad) - 1)
        throws = zip(self.throw_angles_rad, self.throw_positions_m, strict=True)
        return tuple(
            Cylinder(bank_rad, throw, angle, position + self.rod_pitch_m * (number - middle))
            for throw, (angle, position) in enumerate(throws)
            for number, bank_rad in enumerate(self.bank_angles_rad)
        )

    def counterweight_pulls_n(self, rotation: Rotation) -> Array:
        """Force of each throw's counterweights in the crank frame, shape (throw, 2, samples)."""
        turned = rotation.crank_angle + np.array(self.throw_angles_rad)[:, None]
        c, s = np.cos(turned), np.sin(turned)
        along, across = (
            acceleration_of(np.stack(path), rotation) for path in ((c, -s, -c), (s, c, -s))
        )
        return self.counterweight_kg_m * np.stack([along, across], axis=1)

    def counterweight_wrench(self, rotation: Rotation) -> Wrench:
        """Force of all counterweights and its moment in the crank frame, about its origin.

        Their spin is in the crankshaft's inertia.
        """
        pulls = self.counterweight_pulls_n(rotation)
        along, across = pulls.sum(axis=0)
        about = np.einsum("t,tcs->cs", np.array(self.throw_positions_m), pulls)
        still = np.zeros_like(along)
        return Wrench(np.stack([along, across, still]), np.stack([-about[1], about[0], still]))


ONE_CYLINDER: Final = CylinderBanks(
    bank_angles_rad=(0.0,), throw_angles_rad=(0.0,), throw_positions_m=(0.0,), rod_pitch_m=0.0
)
"""Cylinders of a machine whose file has no banks."""
