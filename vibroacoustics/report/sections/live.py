"""Sliders, spectrum and sound of the page, where a browser runs its script."""

import xarray as xr

from ...base.registry import register
from ..blocks import Block, Live, Text
from ..live.data import MOST_MICROPHONES, live_data
from ..speeds import chosen_speeds
from . import Section


def _blocks(results: xr.Dataset) -> list[Block]:
    return [
        Text(
            "In report.html, where a browser runs its script, levels, spectrum and sound follow "
            "sliders. They are those of the pipeline with the values as given, without samples, at "
            f"computed speeds and at {MOST_MICROPHONES} microphones at most.",
            "note",
        ),
        *chosen_speeds(results, "comparison.csv"),
        Live(live_data(results)),
    ]


def _applies(results: xr.Dataset) -> bool:
    """Only results that hold what is no tone, too."""
    return "noise_band_level" in results and "pressure_line" in results


register(Section("live", "Try it", _blocks, _applies, position=25.0))
