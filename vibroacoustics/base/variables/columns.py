"""Further columns of the comparison of the options."""

from ..registry import register
from ..vocabulary import Coordinate, Variable

for _thing in (
    Coordinate("column", ("column",), "", "further column of the comparison, unit in its name"),
    Variable(
        "column_value",
        ("column", "option", "speed", "receiver"),
        "",
        "further column of the comparison",
    ),
):
    register(_thing)
