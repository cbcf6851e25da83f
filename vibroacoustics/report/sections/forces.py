"""Force over a revolution, and the figures that the options report."""

import xarray as xr

from ...base.registry import register
from ..blocks import Block, Pictures
from ..figures import force_figures
from ..option_facts import facts_table
from ..speeds import chosen_speeds
from ..study import few_speeds
from . import Section


def _blocks(results: xr.Dataset) -> list[Block]:
    facts = facts_table(few_speeds(results))
    figures = Pictures(tuple(force_figures(results)))
    return [figures, *chosen_speeds(results, "results.nc"), facts] if facts else [figures]


register(Section("forces", "Force over a revolution", _blocks, position=50.0))
