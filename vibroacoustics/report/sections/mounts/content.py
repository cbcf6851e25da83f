"""The housing on its mounts."""

import xarray as xr

from ....base.registry import register
from ...blocks import Block, Pictures, Text
from ...figures.radiation import mount_transmissibility
from ...shown_speeds import chosen_speeds, few_speeds
from .. import Section
from .tables import attached_table, block_table, isolation_sentence, modes_table


def _blocks(results: xr.Dataset) -> list[Block]:
    return [
        Text(isolation_sentence(results)),
        *filter(None, (modes_table(results), attached_table(results))),
        *_block(results),
        Pictures((mount_transmissibility(results),)),
    ]


def _block(results: xr.Dataset) -> list[Block]:
    """Displacement of a block on springs, where there is one."""
    table = block_table(few_speeds(results))
    return [*chosen_speeds(results, "results.nc"), table] if table else []


register(Section("mounts", "Mounts", _blocks, position=60.0))
