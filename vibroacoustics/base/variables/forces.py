"""Forces and moments of the moving parts on the housing over a revolution."""

from typing import Final

from ..registry import register
from ..vocabulary import Coordinate, Variable

_FORCES: Final = ("speed", "option", "source", "axis")

for _thing in (
    Coordinate("source", ("source",), "", "moving part that makes the force"),
    Coordinate("axis", ("axis",), "", "axis of the machine"),
    Coordinate("crank_angle", ("crank_angle",), "rad", "crank angle"),
    Coordinate("crank_time", ("speed", "option", "crank_angle"), "s", "time from crank angle zero"),
    Variable("force", (*_FORCES, "crank_angle"), "N", "force of the moving parts on the housing"),
    Variable(
        "moment", (*_FORCES, "crank_angle"), "N m", "moment on the housing about its centre of mass"
    ),
):
    register(_thing)
