"""Sections of the report: blocks of the page, tables beside it.

A file, or `content.py` of a folder, registers the section.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Final, Literal

import xarray as xr

from ...base.registry import LAST, Registry
from ..blocks import Block, Text
from ..tables import DataTable


def _always(results: xr.Dataset) -> bool:
    return True


def _no_tables(results: xr.Dataset) -> Mapping[str, DataTable]:
    return {}


@dataclass(frozen=True)
class Section:
    """A section of the report.

    Attributes
    ----------
    name : name in its address within the page
    title : heading, and entry in the contents
    blocks : makes what stands in it from the results, its pictures too
    applies : whether results have such a section
    position : from top to bottom; those of third parties are the last
    folded : below its heading, to be opened by the reader
    tables : columns of numbers beside the page, by the name of their file

    Examples
    --------
    >>> def remark(results):
    ...     return [va.blocks.Text(f"Made of {results.attrs['title']}.")]
    >>> section = va.Section("remark", "A remark", remark)
    >>> section.title
    'A remark'
    """

    name: str
    title: str
    blocks: Callable[[xr.Dataset], Sequence[Block]]
    applies: Callable[[xr.Dataset], bool] = _always
    position: float = LAST
    folded: bool = True
    tables: Callable[[xr.Dataset], Mapping[str, DataTable]] = _no_tables


def hold(*names: str) -> Callable[[xr.Dataset], bool]:
    """Return what says whether results hold some variables."""

    def applies(results: xr.Dataset) -> bool:
        return all(name in results for name in names)

    return applies


def text(words: str, kind: Literal["plain", "strong", "note"] = "plain") -> list[Text]:
    """Return a paragraph; none without words."""
    return [Text(words, kind)] if words else []


SECTIONS: Final[Registry[Section]] = Registry(
    "section", Section, "name", "report.sections", "vibroacoustics.sections", "live"
)
