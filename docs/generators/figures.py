"""Figures of `va.plot` on the pages of the gallery: pyplot does not know them."""

import warnings
from typing import Any
from weakref import WeakSet

from matplotlib.figure import Figure
from sphinx_gallery.scrapers import figure_rst

_shown: WeakSet[Figure] = WeakSet()
_filters: list[Any] = []


def warnings_are_errors(gallery_conf: dict[str, Any], page: str | None, when: str) -> None:
    """Let a warning of Python end a page, and give Sphinx its own filters back after it."""
    if page is None:
        return
    if when == "before":
        _filters[:] = warnings.filters
        warnings.simplefilter("error")
        warnings.simplefilter("ignore", ResourceWarning)
    else:
        warnings.filters[:] = _filters


def scraper(block: Any, block_vars: dict[str, Any], gallery_conf: dict[str, Any]) -> str:
    """Save the figures that the page's variables hold and that pyplot did not make."""
    paths = []
    for value in block_vars["example_globals"].values():
        if isinstance(value, Figure) and not hasattr(value, "number") and value not in _shown:
            _shown.add(value)
            path = next(block_vars["image_path_iterator"])
            value.savefig(path, format="png")
            paths.append(path)
    return str(figure_rst(paths, gallery_conf["src_dir"]))
