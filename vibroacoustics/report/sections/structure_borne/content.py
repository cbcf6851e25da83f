"""By air or by the feet: sound of a plate under the machine beside that of the machine."""

import xarray as xr

from ....base.registry import register
from ....results.stored_study import catalogue_receiver, other_receivers
from ...blocks import Block, Details, Text
from .. import Section
from .tables import has_plate, plate_lines_table, way_sentence, ways_table


def _blocks(results: xr.Dataset) -> list[Block]:
    receiver = catalogue_receiver(results)
    return [
        Text(way_sentence(results, receiver), "strong"),
        Text(
            "The feet push on a plate; its near field and its bending waves radiate. Levels by the "
            "plate are those of its mean power; the span holds 90 % of plates of the same size and "
            "make, whose modes lie elsewhere, and what such predictions err by otherwise. They are "
            "no part of the levels by air, of shares or of ranks. Forces along the plate, moments "
            "and what goes on from the plate into the building are left out.",
            "note",
        ),
        ways_table(results, receiver),
        plate_lines_table(results, receiver),
        *(
            Details(
                f"By air and by the plate at {other}",
                (ways_table(results, other), plate_lines_table(results, other)),
            )
            for other in other_receivers(results)
        ),
    ]


register(Section("structure-borne", "By air or by the feet", _blocks, has_plate, 33.0))
