"""Every option beside every other: forces, levels and their changes."""

import xarray as xr

from ....base.registry import register
from ...blocks import Block, Text
from ...kept_columns import columns_of
from ...remainder import total_sentence
from ...tables import DataTable
from .. import Section
from .tables import bands_sentence, comparison_data, comparison_table


def _blocks(results: xr.Dataset) -> list[Block]:
    return [
        Text(
            "1× is once per shaft revolution. Forces and moments (about the centre of mass) are "
            "peak values, the foot force is the largest over the feet. Levels are in dB re 20 µPa. "
            f"{total_sentence(results)} {bands_sentence(results)} Δ is the change against none.",
            "note",
            (("assumptions", "assumptions"),),
        ),
        *(Text(line, "note") for line in columns_of(results).left_out),
        comparison_table(results),
        Text("Other microphones, speeds and columns are in comparison.csv.", "note"),
    ]


def _data(results: xr.Dataset) -> dict[str, DataTable]:
    return {"comparison.csv": comparison_data(results)}


register(Section("comparison", "Comparison", _blocks, position=20.0, tables=_data))
