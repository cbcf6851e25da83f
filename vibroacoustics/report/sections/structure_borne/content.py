"""Structure-borne sound: a plate under the machine beside the airborne sound."""

import xarray as xr

from ....base.registry import register
from ....results.stored_study import catalogue_receiver
from ...blocks import Block, Text
from ...tables import DataTable, long_table
from .. import Section
from .tables import has_plate, plate_lines_table, way_sentence, ways_table


def _blocks(results: xr.Dataset) -> list[Block]:
    receiver = catalogue_receiver(results)
    return [
        Text(way_sentence(results, receiver), "strong"),
        Text(
            "The feet excite a plate, whose near field and bending waves radiate. Levels of the "
            "plate are those of its mean power, with the interval of 90 % of such plates. They are "
            "not in airborne levels, shares and ranks. Neglected: forces along the plate, moments, "
            "transmission into the building.",
            "note",
        ),
        ways_table(results, receiver),
        plate_lines_table(results, receiver),
        Text("Other microphones and speeds are in structure_borne.csv.", "note"),
    ]


def _data(results: xr.Dataset) -> dict[str, DataTable]:
    names = [name for name in map(str, results.data_vars) if name.startswith("structure_borne_")]
    table = long_table(results, [*names, "level_both_ways"], weighting="A")
    return {"structure_borne.csv": table}


register(
    Section("structure-borne", "Structure-borne sound", _blocks, has_plate, 33.0, tables=_data)
)
