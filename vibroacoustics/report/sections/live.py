"""Sliders, spectrum and sound of the page, where a browser runs its script."""

import xarray as xr

from ...base.registry import register
from ..blocks import Block, Live, Text
from ..live.data import MOST_MICROPHONES, live_data
from ..live.sliders import has_sliders
from ..shown_speeds import chosen_speeds
from . import Section


def _blocks(results: xr.Dataset) -> list[Block]:
    return [
        Text(
            "In report.html, where a browser runs its script, levels, spectrum and sound follow "
            f"sliders, at computed speeds and at {MOST_MICROPHONES} microphones at most. "
            f"{_values_words(results)}",
            "note",
        ),
        *chosen_speeds(results, "comparison.csv"),
        Live(live_data(results)),
    ]


def _values_words(results: xr.Dataset) -> str:
    if not has_sliders(results):
        return "They are those of the pipeline with the nominal values."
    return (
        "Levels begin at the median of the samples. Sliders add the change that they make to the "
        f"representative sample at {float(results['slider_speed']):g} rpm."
    )


def _applies(results: xr.Dataset) -> bool:
    """Only results that hold what is no tone, too."""
    return "noise_band_level" in results and "pressure_line" in results


register(Section("live", "Try it", _blocks, _applies, position=25.0))
