"""What happens when the machine is switched off."""

import xarray as xr

from ....base.registry import register
from ...blocks import Block, Pictures, Text
from ...figures.stopping import stopping, stopping_order_map
from ...shown_speeds import chosen_speeds, few_speeds
from .. import Section, hold
from .tables import forces_table, sentences, stopping_data


def _blocks(results: xr.Dataset) -> list[Block]:
    shown = few_speeds(results)
    maps = [stopping_order_map(shown)] if "stopping_order_map" in shown else []
    return [
        *(Text(sentence) for sentence in sentences(results)),
        *chosen_speeds(results, "results.nc"),
        forces_table(shown),
        Text("Levels at all microphones are in stopping.csv.", "note"),
        Pictures((stopping(shown), *maps)),
    ]


_applies = hold("stopping_force")
register(Section("stopping", "Stopping", _blocks, _applies, 80.0, tables=stopping_data))
