"""All kinds of machine that a file can describe."""

from typing import Annotated, Final

from pydantic import Field

from .machine import CommonMachine
from .minicrank import MiniCrankMachine
from .oldham_scroll import OldhamScroll
from .reciprocating import ReciprocatingMachine

Machine = Annotated[
    MiniCrankMachine | OldhamScroll | ReciprocatingMachine, Field(discriminator="kind")
]

MACHINES: Final[dict[str, type[CommonMachine]]] = {
    "minicrank-scroll": MiniCrankMachine,
    "oldham-scroll": OldhamScroll,
    "reciprocating": ReciprocatingMachine,
}
"""Parameters of each kind of machine, by the kind that its file names."""
