"""Scripts and style of the part of the page that moves."""

from functools import cache
from importlib import resources
from typing import Final

CHARTS: Final = "uPlot.iife.min.js"
"""uPlot 1.6.32 by Leon Sorokin, under the MIT licence that stands beside it."""
SCRIPTS: Final = (
    "levels.js", "sound.js", "abx.js", "charts.js", "panel.js", "sliders.js", "listening.js",
)  # fmt: skip


@cache
def unpacking_script() -> str:
    """What unpacks and runs the other script of the page, with the licence of what is in there."""
    return f"/*\nuPlot, which this unpacks:\n{_read('uPlot.LICENSE')}*/\n{_read('unpack.js')}"


@cache
def live_script() -> str:
    """uPlot, and the package's script as one function."""
    parts = "\n".join(map(_read, SCRIPTS))
    return f'{_read(CHARTS)}\n(() => {{\n"use strict";\n{parts}}})();\n'


@cache
def live_style() -> str:
    """Of uPlot and of the panel."""
    return _read("uPlot.min.css") + "\n" + _read("live.css")


def _read(name: str) -> str:
    return resources.files(__package__).joinpath("script", name).read_text("utf-8")
