"""Files of figures without pixels, for what looks at no picture: they take most of its time."""

import io
from pathlib import Path
from typing import Any

import pytest
from matplotlib.figure import Figure
from PIL import Image


def draw_nothing(patch: pytest.MonkeyPatch) -> None:
    """Let files of matplotlib's figures show one white pixel."""
    pixel = io.BytesIO()
    Image.new("RGB", (1, 1), "white").save(pixel, "png")
    content = pixel.getvalue()

    def savefig(_: Figure, file: Any, **__: object) -> None:
        if hasattr(file, "write"):
            file.write(content)
        else:
            Path(file).write_bytes(content)

    patch.setattr(Figure, "savefig", savefig)
