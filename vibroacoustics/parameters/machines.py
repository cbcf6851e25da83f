"""All kinds of machine that a file can describe."""

from typing import Annotated, Final

from pydantic import Field

from .hermetic import HermeticCompressor
from .machine import CommonMachine
from .minicrank import MiniCrankMachine
from .oldham_scroll import OldhamScroll
from .reciprocating import ReciprocatingMachine
from .slider_link import SliderLinkMachine

Machine = Annotated[
    HermeticCompressor | MiniCrankMachine | OldhamScroll | ReciprocatingMachine | SliderLinkMachine,
    Field(discriminator="kind"),
]

MACHINES: Final[dict[str, type[CommonMachine]]] = {
    "minicrank-scroll": MiniCrankMachine,
    "oldham-scroll": OldhamScroll,
    "reciprocating": ReciprocatingMachine,
    "slider-link": SliderLinkMachine,
    "hermetic-reciprocating": HermeticCompressor,
}
"""Parameters of each kind of machine, by the kind that its file names."""
