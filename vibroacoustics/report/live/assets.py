"""Scripts and style of the part of the page that moves."""

from functools import cache
from importlib import resources
from typing import Final

CHARTS: Final = "uPlot.iife.min.js"
"""uPlot 1.6.32 by Leon Sorokin, under the MIT licence that stands beside it."""
SCRIPTS: Final = (
    "levels.js", "sound.js", "abx.js", "charts.js", "panel.js", "listening.js",
)  # fmt: skip


@cache
def live_scripts() -> tuple[str, ...]:
    """uPlot with its licence, and the package's script as one function."""
    licence = _read("uPlot.LICENSE")
    parts = "\n".join(map(_read, SCRIPTS))
    return f"/*\n{licence}*/\n{_read(CHARTS)}", f'(() => {{\n"use strict";\n{parts}}})();\n'


@cache
def live_style() -> str:
    """Of uPlot and of the panel."""
    return _read("uPlot.min.css") + "\n" + _read("live.css")


def _read(name: str) -> str:
    return resources.files(__package__).joinpath("script", name).read_text("utf-8")
