"""Scripts and style of the interactive part of a page, and texts that its script unpacks."""

import zlib
from functools import cache
from importlib import resources
from typing import Final

import numpy as np

CHARTS: Final = "uPlot.iife.min.js"
"""uPlot 1.6.32 by Leon Sorokin, under the MIT licence beside it."""
SCRIPTS: Final = {
    "sliders": (
        "weighting.js", "levels.js", "sound.js", "abx.js", "charts.js", "panel.js", "sliders.js",
        "listening.js",
    ),
    "run_up": ("weighting.js", "charts.js", "run_up_map.js", "run_up_cuts.js", "run_up.js",
               "run_up_line.js", "run_up_sound.js", "run_up_start.js"),
}  # fmt: skip
"""Scripts by the name of the panel."""
_STYLES: Final = {"sliders": (), "run_up": ("run_up.css",)}
_LEFT_OUT: Final = b"<\\"
"""Letters from ( to ~ that are not used, so that 85 remain that mean nothing in HTML and in
JSON."""
_LETTERS: Final = np.array(
    [code for code in range(ord("("), ord("~") + 1) if code not in _LEFT_OUT]
)


@cache
def unpacking_script() -> str:
    """Return the script that unpacks and runs the other script of the page, with its licences."""
    return f"/*\nuPlot, which this unpacks:\n{_read('uPlot.LICENSE')}*/\n{_read('unpack.js')}"


@cache
def live_script(panel: str = "sliders") -> str:
    """uPlot, and the script of a panel as one function."""
    parts = "\n".join(map(_read, SCRIPTS[panel]))
    return f'{_read(CHARTS)}\n(() => {{\n"use strict";\n{parts}}})();\n'


@cache
def blind_script() -> str:
    """Script of the blind tests of a page's sounds, as one function."""
    parts = "\n".join(map(_read, ("abx.js", "blind_sounds.js")))
    return f'(() => {{\n"use strict";\n{parts}}})();\n'


@cache
def live_style(panel: str = "sliders") -> str:
    """Style of uPlot and of a panel."""
    return "\n".join(map(_read, ("uPlot.min.css", "live.css", *_STYLES[panel])))


def packed(content: bytes) -> str:
    """Deflated bytes in letters, of which none means anything in HTML and in JSON.

    Four bytes, the highest first, are five digits of base 85; fewer at the end are one digit more
    than bytes.
    """
    deflated = zlib.compress(content, 9)
    missing = -len(deflated) % 4
    words = np.frombuffer(deflated + bytes(missing), dtype=">u4").astype(np.int64)
    digits = words[:, None] // 85 ** np.arange(4, -1, -1) % 85
    letters: str = _LETTERS[digits].astype(np.uint8).tobytes().decode()
    return letters[: len(letters) - missing]


def _read(name: str) -> str:
    return resources.files(__package__).joinpath("script", name).read_text("utf-8")
