"""Figures without pixels or layout, for what looks at no picture: they take most of its time."""

import io
from pathlib import Path
from typing import Any

import pytest
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from PIL import Image

_SAVEFIG, _EXECUTE = Figure.savefig, ConstrainedLayoutEngine.execute


def draw_nothing(patch: pytest.MonkeyPatch) -> None:
    """Paint figures without layout; let their files show one white pixel."""
    pixel = io.BytesIO()
    Image.new("RGB", (1, 1), "white").save(pixel, "png")
    content = pixel.getvalue()

    def savefig(_: Figure, file: Any, **__: object) -> None:
        if hasattr(file, "write"):
            file.write(content)
        else:
            Path(file).write_bytes(content)

    patch.setattr(Figure, "savefig", savefig)
    patch.setattr(ConstrainedLayoutEngine, "execute", lambda *_: None)


def lay_out(patch: pytest.MonkeyPatch) -> None:
    """Let texts of figures find their room again."""
    patch.setattr(ConstrainedLayoutEngine, "execute", _EXECUTE)


def draw_pixels(patch: pytest.MonkeyPatch) -> None:
    """Draw and lay out figures as a user's are."""
    patch.setattr(Figure, "savefig", _SAVEFIG)
    lay_out(patch)
