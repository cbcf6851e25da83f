"""What a result is laid out over, and figures that machine, options and sources report."""

from ..registry import register
from ..vocabulary import Coordinate, Variable

for _thing in (
    Coordinate("speed", ("speed",), "rpm", "shaft speed"),
    Coordinate("option", ("option",), "", "balancing option"),
    Coordinate("figure", ("figure",), "", "reported figure, unit in its name"),
    Variable(
        "reported_figure",
        ("speed", "option", "figure"),
        "",
        "figure of machine, option or source, unit in its name",
    ),
):
    register(_thing)
