"""How sphinx builds the site: `make docs`. Nothing is fetched; a warning is an error there."""

import os
import re
import sys
import tomllib
from importlib import import_module
from pathlib import Path

from sphinx.util import logging

DOCS = Path(__file__).resolve().parent
ROOT = DOCS.parent
sys.path[:0] = [str(ROOT), str(DOCS)]
os.environ.setdefault("MPLBACKEND", "Agg")
os.environ["PYTHONPATH"] = os.pathsep.join([str(ROOT), os.environ.get("PYTHONPATH", "")])

with (ROOT / "pyproject.toml").open("rb") as _file:
    _about = tomllib.load(_file)["project"]

project = _about["name"]
author = copyright = _about["authors"][0]["name"]  # noqa: A001 - sphinx's word
version = release = _about["version"]

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.napoleon",
    "sphinx_gallery.gen_gallery",
]
exclude_patterns = ["_build", "gallery"]
nitpicky = False
default_role = "code"
suppress_warnings = ["config.cache"]  # sphinx-gallery's settings hold a function's name

myst_heading_anchors = 3
myst_enable_extensions = ["html_image"]
autodoc_member_order = "bysource"
autodoc_typehints = "description"
autosummary_generate = False
napoleon_google_docstring = False

html_theme = "pydata_sphinx_theme"
html_title = f"vibroacoustics {version}"
html_show_sphinx = False
html_static_path = ["static"]
html_css_files = ["site.css"]
html_theme_options = {
    "navbar_end": ["theme-switcher"],
    "footer_start": ["copyright"],
    "footer_end": [],
    "show_toc_level": 2,
    "navigation_with_keys": False,
}

sphinx_gallery_conf = {
    "examples_dirs": "gallery",
    "gallery_dirs": "examples",
    "filename_pattern": r"\.py$",
    "ignore_pattern": r"(rough_radiation|__init__)\.py$",
    "within_subsection_order": "FileNameSortKey",
    "matplotlib_animations": False,
    "image_scrapers": ("matplotlib", "generators.figures.scraper"),
    "reset_modules": ("matplotlib", "generators.figures.warnings_are_errors"),
    "reset_modules_order": "both",
    "download_all_examples": False,
    "show_signature": False,
    "show_memory": False,
    "capture_repr": (),
    "write_computation_times": False,
    "min_reported_time": 1e6,
    "abort_on_example_error": True,
    "remove_config_comments": True,
    "plot_gallery": True,
}

GENERATED = ("vocabulary", "command_line", "claims", "errors", "registered", "evidence")
COPIED = {"changelog": "CHANGELOG.md", "contributing": "CONTRIBUTING.md"}


def _write_generated(app) -> None:
    """Write the pages that come from the code."""
    folder = DOCS / "generated"
    folder.mkdir(exist_ok=True)
    for name in GENERATED:
        text = import_module(f"generators.{name}").page()
        (folder / f"{name}.md").write_text(text, encoding="utf-8")
    for name, page in COPIED.items():
        text = import_module("generators.copied").page(page)
        (folder / f"{name}.md").write_text(text, encoding="utf-8")
    (folder / "api.inc").write_text(import_module("generators.api").page(), encoding="utf-8")
    picture = import_module("generators.layers").picture()
    (folder / "layers.svg").write_text(picture, encoding="utf-8")


def _without_links_out(app, docname: str, source: list[str]) -> None:
    """Links from Markdown to files outside the site become their words: there is no address."""

    def words(link: re.Match[str]) -> str:
        target = (DOCS / docname).parent / link[2].partition("#")[0]
        return link[0] if target.resolve().is_relative_to(DOCS) else link[1]

    source[0] = re.sub(r"(?<!!)\[([^\]]*)\]\((\.\.[^)\s]*)\)", words, source[0])


def _readable_docstring(app, what, name, thing, options, lines: list[str]) -> None:
    lines[:] = import_module("generators.docstrings").readable(lines)


def _warn_of_missing_pictures(app, exception) -> None:
    if exception is None and app.builder.format == "html":
        pictures = import_module("generators.pictures")
        for line in [*pictures.missing(Path(app.outdir)), *pictures.without_any(DOCS / "examples")]:
            logging.getLogger(__name__).warning(line)


def setup(app) -> None:
    """Called by sphinx."""
    app.connect("autodoc-process-docstring", _readable_docstring, priority=100)
    app.connect("builder-inited", _write_generated, priority=100)
    app.connect("source-read", _without_links_out)
    app.connect("build-finished", _warn_of_missing_pictures)
