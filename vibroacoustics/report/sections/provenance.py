"""Where the results come from."""

import xarray as xr

from ...base.registry import register
from ..blocks import Block
from ..provenance import provenance_table
from . import Section


def _blocks(results: xr.Dataset) -> list[Block]:
    return [provenance_table(results)]


register(Section("provenance", "Provenance", _blocks, position=120.0))
