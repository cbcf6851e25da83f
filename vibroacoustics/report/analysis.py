"""Outcome of a job as data and as Markdown: sections, numbers, charts and tables."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import chain
from typing import Any
from urllib.parse import quote

import xarray as xr

from ..base.folder import Content
from ..results.conditional import COLUMNS, ConditionalClaim, condition_table, named
from ..results.number import Number
from .blocks import (
    Beside,
    Block,
    Bullets,
    Definitions,
    Details,
    Heading,
    Intervals,
    Lights,
    Live,
    Part,
    Pictures,
    Sounds,
    Text,
    charts,
    pictures,
    rendered,
    tables,
)
from .charts.svg import picture_file
from .html import html
from .tables import DataTable, Table, escape_markdown, to_ascii, to_csv, to_markdown, to_text


def markdown(title: str, about: str, parts: Sequence[Part], folder: str = "") -> bytes:
    """Return the sections of a page, each under its heading; figures are in the folder."""
    texts = [f"# {escape_markdown(title)}", escape_markdown(about)]
    for part in parts:
        texts.append(f"## {escape_markdown(part.title)}")
        texts += [_block(block, folder) for block in rendered(part.blocks)]
    return ("\n\n".join(filter(None, texts)) + "\n").encode()


def _block(block: Block, folder: str) -> str:
    match block:
        case Text():
            words = escape_markdown(block.words)
            text = f"**{words}**" if block.kind in {"headline", "strong"} else words
        case Heading():
            text = f"### {escape_markdown(block.words)}"
        case Bullets():
            text = "\n".join(f"- {escape_markdown(item)}" for item in block.items)
        case Definitions():
            entries = (map(escape_markdown, (e.term, e.tag, e.words)) for e in block.entries)
            text = "\n".join(f"- **{term}** ({tag}): {words}" for term, tag, words in entries)
        case Table():
            text = to_markdown(block)
        case Pictures():
            text = "\n\n".join(
                f"![{escape_markdown(picture.alt)}]({folder}{picture_file(picture)})\n"
                f"{escape_markdown(picture.caption)}"
                for picture in pictures([block])
            )
        case Live():
            text = ""
        case Lights() | Intervals():
            text = f"{to_markdown(_chart_table(block))}\n\n{block.note}"
        case Sounds():
            text = "\n".join(
                f"- [{escape_markdown(sound.name)}]({quote(sound.file)})" for sound in block.sounds
            )
        case Beside():
            text = f"{_block(block.narrow, folder)}\n\n{_block(block.wide, folder)}"
        case Details():
            blocks = (_block(inner, folder) for inner in block.blocks)
            text = "\n\n".join([f"### {escape_markdown(block.summary)}", *blocks])
        case _:
            raise TypeError(f"{block!r}: is no block")
    return text


def _chart_table(block: Lights | Intervals) -> Table:
    if isinstance(block, Intervals):
        values = tuple((row.name, row.text, row.word) for row in block.rows)
        return Table(block.caption, (*block.head, ""), values, frozenset({0, 2}))
    rows = tuple(
        (f"{row.name}: {row.word}", *(f"{light.word} ({light.change})" for light in row.lights))
        for row in block.rows
    )
    return Table(block.caption, block.head, rows, frozenset(range(len(block.head))))


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
    claims : claims that summary, shown blocks and tables state, with their conditions
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
    claims: tuple[ConditionalClaim, ...] = ()

    @property
    def page(self) -> str:
        """Name of the page's file."""
        return f"{self.name}.html"

    def text(self) -> str:
        """Return summary and tables for a terminal, and what claims lack that these do not say."""
        text = "\n".join([*map(to_ascii, self.summary), *map(_in_terminal, self.shown)])
        lines = [
            to_ascii(f"{claim.subject}: {named(claim)}".removeprefix(": "))
            for claim in self.claims
            if any(to_ascii(reason) not in text for reason in claim.reasons)
        ]
        return "\n".join([text, *lines]) if lines else text

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
                for name, table in self.every_table().items()
            },
            "numbers": [each.data() for each in by_selection.values()],
            "charts": [chart.data() for chart in charts(self._blocks())],
        }  # fmt: skip

    def files(self, results_sha256: str = "") -> dict[str, Content]:
        """Return page, tables, pictures and further files by name."""
        pictures_of_file = {picture_file(each): each.content for each in pictures(self._blocks())}
        return {
            self.page: self.html(results_sha256),
            **{name: to_csv(table) for name, table in self.every_table().items()},
            **({self.in_markdown: self.markdown()} if self.in_markdown else {}),
            **self.further,
            **{f"{self.figures}{name}": content for name, content in pictures_of_file.items()},
        }

    def _about(self) -> str:
        computed = f" Computed {self.created}." if self.created else ""
        return f"{self.kind}. {self.about}{computed}"

    def every_table(self) -> Mapping[str, DataTable]:
        """Tables of data, with that of the conditions of claims."""
        if not self.claims:
            return self.tables
        return {**self.tables, f"{self.name}_conditions.csv": condition_table(self.claims)}

    def _conditions(self) -> tuple[Part, ...]:
        """Section with the conditions of the claims; none without claims."""
        if not self.claims:
            return ()
        columns = condition_table(self.claims)
        rows = tuple(tuple(map(str, row)) for row in zip(*columns.values(), strict=True))
        caption = "What each claim needs, and what was found"
        table = Table(caption, COLUMNS, rows, frozenset(range(len(COLUMNS))))
        return (Part("conditions", "Claims and their conditions", (table,), folded=True),)

    def _blocks(self) -> list[Block]:
        return [block for part in self.parts for block in part.blocks]

    def _headed(self) -> tuple[Part, ...]:
        """Sections, the first that is not folded begins with the summary."""
        parts = (*self.parts, *self._conditions())
        if not self.summary:
            return parts
        first, *others = self.summary
        head = (Text(first, "headline"), *map(Text, others))
        unfolded = next((unfolded for unfolded, part in enumerate(parts) if not part.folded), 0)
        part = parts[unfolded]
        headed = part._replace(blocks=(*head, *part.blocks))
        return (*parts[:unfolded], headed, *parts[unfolded + 1 :])


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
