"""Outcome of a job as data: sections, numbers, charts and tables, and the files made of them."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import chain
from typing import Any

import xarray as xr

from ..base.folder import Content
from ..results.number import Number
from .blocks import Block, Bullets, Part, Text, charts, pictures, tables
from .charts.svg import picture_file
from .html import html
from .markdown import markdown
from .tables import DataTable, Table, to_ascii, to_csv, to_text


@dataclass(frozen=True)
class Analysis:
    """Outcome of a job.

    Attributes
    ----------
    name : name of its page, without ending
    title : heading of the page
    kind : analysed thing, a machine or a recording
    created : time of the results, UTC; empty where it is not recorded
    about : sentence below the heading
    parts : sections of the page
    summary : sentences that head the page and the terminal
    shown : blocks that the terminal shows below the summary
    tables : columns of data by the name of their file, .csv
    numbers : that sentences state; those of tables are found there
    further : content of other files by name
    figures : folder of the pictures, ending in `/`; empty for that of the page
    in_markdown : name of a file with the page as Markdown; empty for none
    """

    name: str
    title: str
    kind: str
    created: str
    about: str
    parts: tuple[Part, ...]
    summary: tuple[str, ...] = ()
    shown: tuple[Block, ...] = ()
    tables: Mapping[str, DataTable] = field(default_factory=dict)
    numbers: tuple[Number, ...] = ()
    further: Mapping[str, Content] = field(default_factory=dict)
    figures: str = ""
    in_markdown: str = ""

    @property
    def page(self) -> str:
        """Name of the page's file."""
        return f"{self.name}.html"

    def text(self) -> str:
        """Return summary and tables for a terminal."""
        return "\n".join([*map(to_ascii, self.summary), *map(_in_terminal, self.shown)])

    def html(self, results_sha256: str = "") -> bytes:
        """Return the page, with the hash of its results."""
        return html(self.title, self._about(), self._headed(), results_sha256)

    def markdown(self) -> bytes:
        """Return the page as Markdown; its pictures are files."""
        return markdown(self.title, self._about(), self._headed(), self.figures)

    def json(self) -> dict[str, Any]:
        """Return tables, numbers and charts as plain values."""
        blocks = [*self._blocks(), *self.shown]
        cells = (cell for table in tables(blocks) for row in table.rows for cell in row)
        numbers = chain(self.numbers, (cell for cell in cells if isinstance(cell, Number)))
        by_selection = {(each.variable, *each.selection.items()): each for each in numbers}
        return {
            "tables": {
                name.removesuffix(".csv"): {head: list(map(_cell, values)) for head, values in
                                            table.items()}
                for name, table in self.tables.items()
            },
            "numbers": [each.data() for each in by_selection.values()],
            "charts": [chart.data() for chart in charts(self._blocks())],
        }  # fmt: skip

    def files(self, results_sha256: str = "") -> dict[str, Content]:
        """Return page, tables, pictures and further files by name."""
        pictures_of_file = {picture_file(each): each.content for each in pictures(self._blocks())}
        return {
            self.page: self.html(results_sha256),
            **{name: to_csv(table) for name, table in self.tables.items()},
            **({self.in_markdown: self.markdown()} if self.in_markdown else {}),
            **self.further,
            **{f"{self.figures}{name}": content for name, content in pictures_of_file.items()},
        }

    def _about(self) -> str:
        computed = f" Computed {self.created}." if self.created else ""
        return f"{self.kind}. {self.about}{computed}"

    def _blocks(self) -> list[Block]:
        return [block for part in self.parts for block in part.blocks]

    def _headed(self) -> tuple[Part, ...]:
        """Sections, the first that is not folded begins with the summary."""
        if not self.summary:
            return self.parts
        first, *others = self.summary
        head = (Text(first, "headline"), *map(Text, others))
        unfolded = next(
            (unfolded for unfolded, part in enumerate(self.parts) if not part.folded), 0
        )
        part = self.parts[unfolded]
        headed = part._replace(blocks=(*head, *part.blocks))
        return (*self.parts[:unfolded], headed, *self.parts[unfolded + 1 :])


def origin(results: xr.Dataset, kind: str) -> dict[str, Any]:
    """Return title, kind and time of an analysis from the attributes of its dataset."""
    title, created = (str(results.attrs.get(name, "")) for name in ("title", "created_utc"))
    return {"title": title or kind, "kind": kind, "created": created}


def _in_terminal(block: Block) -> str:
    if isinstance(block, Table):
        return to_text(block)
    if isinstance(block, Bullets):
        return "\n".join(map(to_ascii, block.items))
    return to_ascii(block.words) if isinstance(block, Text) else ""


def _cell(value: str | float) -> str | float | None:
    return value if value != "" else None
