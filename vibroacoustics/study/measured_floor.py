"""Hammer tests of the floor under the feet: files, and where their nodes are."""

from collections import Counter

from pydantic import Field

from ..base.parameters import Contradictions, Parameters
from .measured_shell import Hit


class FloorPoint(Hit):
    """A point of the floor under a foot; along z, or along x or y for both."""

    foot: str
    """Its name."""

    @property
    def is_vertical(self) -> bool:
        """Whether it is hit up or down."""
        return self.direction[1] == "z"


class MeasuredFloor(Parameters):
    """Driving-point frequency responses under the feet, in place of a rigid floor."""

    frequency_responses: tuple[str, ...] = Field(min_length=1)
    units: dict[str, str] = Field(default_factory=dict)
    points: dict[str, FloorPoint] = Field(min_length=1)

    def contradictions(self) -> Contradictions:
        counted = Counter((point.foot, point.is_vertical) for point in self.points.values())
        for (foot, is_vertical), count in counted.items():
            if count > 1:
                along = "up and down" if is_vertical else "sideways"
                yield f"points: {count} points {along} under {foot}, must be one"
        for foot, is_vertical in counted:
            if not is_vertical and (foot, True) not in counted:
                yield f"points: {foot} has a point sideways and none up and down"
