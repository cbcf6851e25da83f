"""All kinds of machine that a file can describe."""

from typing import Annotated, Final

from pydantic import Field

from .hermetic import HermeticCompressor
from .machine import CommonMachine
from .oldham_scroll import OldhamScroll
from .reciprocating import ReciprocatingMachine

Machine = Annotated[
    OldhamScroll | ReciprocatingMachine | HermeticCompressor, Field(discriminator="kind")
]

MACHINES: Final[dict[str, type[CommonMachine]]] = {
    "oldham-scroll": OldhamScroll,
    "reciprocating": ReciprocatingMachine,
    "hermetic-reciprocating": HermeticCompressor,
}
"""Parameters of each kind of machine, by the kind that its file names."""
