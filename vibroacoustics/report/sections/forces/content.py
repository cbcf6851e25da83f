"""Force over a revolution, and the figures that the options report."""

import xarray as xr

from ....base.registry import register
from ...blocks import Block, Pictures, Text
from ...drawing import section_picture
from ...figures.orders import force_over_revolution
from .. import Section
from .tables import figures_data


def _blocks(results: xr.Dataset) -> list[Block]:
    note = "Figures of machine, sources and options at all speeds are in figures.csv."
    section = section_picture(results)
    pictures = [Pictures((section,))] if section else []
    return [_figure(results), *pictures, Text(note, "note")]


def _figure(results: xr.Dataset) -> Block:
    """The force, where the run kept it over time."""
    if "force" not in results:
        return Text("Forces over crank angle are not in these results: operation.keep_time_series.")
    return Pictures((force_over_revolution(results),))


register(Section("forces", "Force over a revolution", _blocks, position=50.0, tables=figures_data))
