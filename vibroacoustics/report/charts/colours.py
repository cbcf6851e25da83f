"""Colours of values, and numbers of marks."""

from typing import Any, Final

import numpy as np

from ...base.arrays import Array

_ANCHORS: Final = (
    "440154481a6c472f7d41448739568c31688e2a788e23888e"
    "1f988b22a88435b77954c5687ad151a5db36d2e21bfde725"
)
"""Viridis (S. van der Walt, N. Smith, 2015; CC0) at sixteen even steps."""
BLANK: Final = "e6e6e6"


def _palette() -> bytes:
    anchors = np.frombuffer(bytes.fromhex(_ANCHORS), np.uint8).reshape(-1, 3).astype(float)
    along = np.linspace(0.0, len(anchors) - 1.0, 255)
    colours = [np.interp(along, np.arange(len(anchors)), channel) for channel in anchors.T]
    return np.stack(colours, axis=1).round().astype(np.uint8).tobytes() + bytes.fromhex(BLANK)


PALETTE: Final = _palette()
"""255 colours from the lowest value to the highest, and that of no value; three bytes each."""


def numbers(values: Any) -> Array:
    """Return values as an array of floating-point numbers."""
    return np.asarray(values, dtype=float)
