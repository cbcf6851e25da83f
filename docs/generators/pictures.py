"""Pictures that a built page asks for and that are not there."""

import re
from pathlib import Path
from urllib.parse import unquote

_SOURCE = re.compile(r'<img\b[^>]*?\bsrc="([^":]+)"')  # an address with a scheme is not local


def missing(folder: Path) -> list[str]:
    """A line for each."""
    return [
        f"{page.relative_to(folder)}: no picture {source}"
        for page in sorted(folder.rglob("*.html"))
        for source in _SOURCE.findall(page.read_text(encoding="utf-8"))
        if not (page.parent / unquote(source)).is_file()
    ]


def without_any(gallery: Path) -> list[str]:
    """A line for each page of the gallery that draws nothing."""
    return [
        f"{page.name}: draws no figure"
        for page in sorted(gallery.glob("*.py"))
        if not (gallery / "images" / f"sphx_glr_{page.stem}_001.png").is_file()
    ]
