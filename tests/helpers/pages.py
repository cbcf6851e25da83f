"""Pages and terminal texts of made-up sections."""

import xarray as xr

from vibroacoustics.report.analysis import Analysis
from vibroacoustics.report.blocks import Part
from vibroacoustics.report.sections.comparison import terminal_blocks


def page_of(*parts: Part) -> Analysis:
    """An analysis of some sections."""
    return Analysis("page", "Title", "Machine", "now", "About.", parts, figures="figures/")


def comparison_text(results: xr.Dataset) -> str:
    """Tables of a run in the terminal."""
    return Analysis("page", "", "", "", "", (), shown=terminal_blocks(results)).text()
