"""Force over a revolution, and the figures that the options report."""

import xarray as xr

from ....base.registry import register
from ...blocks import Block, Pictures, Text
from ...drawing import section_picture
from ...figures.forces import force_over_revolution
from ...shown_speeds import chosen_speeds, few_speeds
from .. import Section
from .tables import facts_table


def _blocks(results: xr.Dataset) -> list[Block]:
    facts = facts_table(few_speeds(results))
    section = section_picture(results)
    shown = [_figure(results), *([Pictures((section,))] if section else [])]
    return [*shown, *chosen_speeds(results, "results.nc"), facts] if facts else shown


def _figure(results: xr.Dataset) -> Block:
    """The force, where the run kept it over time."""
    if "force" not in results:
        return Text("Forces over crank angle are not in these results: operation.keep_time_series.")
    return Pictures((force_over_revolution(results),))


register(Section("forces", "Force over a revolution", _blocks, position=50.0))
