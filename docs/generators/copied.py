"""Pages that stand at the root of the project, with their links made those of the site."""

import re
from pathlib import Path
from typing import Final

ROOT: Final = Path(__file__).resolve().parents[2]


def page(name: str) -> str:
    """Markdown of a page of the root, as it stands in `generated`."""
    text = (ROOT / name).read_text(encoding="utf-8")
    text = re.sub(r"\]\(docs/", "](../", text)
    return re.sub(r"\[([^\]]*)\]\((?!\.\./)([^):]*)\)", r"\1", text)
