"""Errors in the document that the machine's values come from."""

import xarray as xr

from ...base.registry import register
from ..assumptions import errata_table
from ..blocks import Block
from . import Section


def _blocks(results: xr.Dataset) -> list[Block]:
    table = errata_table(results)
    return [table] if table else []


def _applies(results: xr.Dataset) -> bool:
    return errata_table(results) is not None


register(Section("errata", "Errata of the source", _blocks, _applies, 110.0))
