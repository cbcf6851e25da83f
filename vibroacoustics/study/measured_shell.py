"""Hammer tests of the shell: files, where their nodes are, how well samples must agree."""

from math import pi
from typing import Literal

from pydantic import Field

from ..base.parameters import Contradictions, Parameters
from ..machine.frame import PARTS

DirectionCode = Literal["+x", "-x", "+y", "-y", "+z", "-z"]
COMPONENTS = ("fx", "fy", "fz")
"""Forces on a part that a hammer can make."""


class Hit(Parameters):
    """A node of the measured functions and the direction that counts as positive."""

    node: int = Field(ge=0, le=999_999_999)
    direction: DirectionCode


class WallPoint(Hit):
    """A point of the wall; its direction is that of the outward normal, as the file calls it."""

    angle_rad: float = Field(ge=-2.0 * pi, le=2.0 * pi)
    """Angle from x towards y."""
    height_m: float = Field(ge=-2.0, le=2.0)
    """Height from the centre of mass."""


class PartPoint(Hit):
    """A part that is fixed to the wall, hit along an axis of the machine."""

    part: str
    component: Literal["fx", "fy", "fz"]

    def contradictions(self) -> Contradictions:
        parts = [part.name for part in PARTS]
        if self.part not in parts:
            yield f"part = {self.part}: must be one of {', '.join(parts)}"


class MeasuredShell(Parameters):
    """Frequency responses between points of the shell, which weigh the samples."""

    frequency_responses: tuple[str, ...] = Field(min_length=1)
    units: dict[str, str] = Field(default_factory=dict)
    lowest_frequency_hz: float = Field(default=0.0, ge=0.0, le=1e6)
    highest_frequency_hz: float = Field(default=1e6, gt=0.0, le=1e6)
    gain_tolerance_db: float = Field(default=3.0, ge=0.1, le=20.0)
    """Standard deviation of the mean level of mobilities in a third octave, of the model itself."""
    frequency_tolerance_ratio: float = Field(default=0.02, ge=0.001, le=0.5)
    """Standard deviation of a natural frequency, relative."""
    loss_tolerance_ratio: float = Field(default=0.3, ge=0.01, le=3.0)
    """Standard deviation of a loss factor, relative."""
    wall: dict[str, WallPoint] = Field(min_length=1)
    parts: dict[str, PartPoint] = Field(default_factory=dict)

    def contradictions(self) -> Contradictions:
        name_of_key: dict[tuple[int, str], str] = {}
        for kind, points in (("wall", self.wall), ("parts", self.parts)):
            for name, point in points.items():
                key = (point.node, point.direction[1])
                if key in name_of_key:
                    yield f"{kind}.{name}: has node and direction of {name_of_key[key]}"
                name_of_key[key] = f"{kind}.{name}"
        if self.highest_frequency_hz <= self.lowest_frequency_hz:
            yield "highest_frequency_hz: must be above lowest_frequency_hz"
