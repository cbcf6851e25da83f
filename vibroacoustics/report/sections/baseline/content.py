"""The measured baseline: what options make of it, and what it cannot tell."""

import xarray as xr

from ....base.registry import register
from ...blocks import Block, Bullets, Pictures, Text
from ...figures.sources import baseline_third_octaves
from ...shown_speeds import chosen_speeds
from .. import Section
from . import tables as baseline
from .tables import order_tables


def _blocks(results: xr.Dataset) -> list[Block]:
    drawn = results["baseline_band_level"].notnull().any()
    return [
        Text(baseline.summary(results)),
        Bullets(baseline.limits(results)),
        *chosen_speeds(results, "results.nc"),
        *order_tables(results),
        *([Pictures((baseline_third_octaves(results),))] if drawn else []),
    ]


def _applies(results: xr.Dataset) -> bool:
    return "baseline_share" in results and baseline.baseline_of(results) is not None


register(Section("baseline", "Measured baseline", _blocks, _applies, 25.0))
