"""The report as Markdown; figures are files beside it."""

from functools import singledispatch

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
    Pictures,
    Text,
    drawn,
    pictures,
)
from .page import Page, figure_file
from .tables import Table, escape_markdown, to_markdown


def markdown(page: Page) -> bytes:
    """The sections of the page, each under its heading."""
    parts = [
        f"# {escape_markdown(page.title)}",
        escape_markdown(f"{page.machine}. Computed {page.created}."),
    ]
    for part in page.parts:
        parts.append(f"## {escape_markdown(part.title)}")
        parts += [_block(block) for block in drawn(part.blocks)]
    return ("\n\n".join(filter(None, parts)) + "\n").encode()


@singledispatch
def _block(block: Block) -> str:
    raise TypeError(f"{block!r}: is no block")


@_block.register
def _text(block: Text) -> str:
    words = escape_markdown(block.words)
    return f"**{words}**" if block.kind in {"headline", "strong"} else words


@_block.register
def _heading(block: Heading) -> str:
    return f"### {escape_markdown(block.words)}"


@_block.register
def _bullets(block: Bullets) -> str:
    return "\n".join(f"- {escape_markdown(item)}" for item in block.items)


@_block.register
def _definitions(block: Definitions) -> str:
    return "\n".join(
        f"- **{escape_markdown(entry.term)}** ({escape_markdown(entry.tag)}): "
        f"{escape_markdown(entry.words)}"
        for entry in block.entries
    )


@_block.register
def _table(block: Table) -> str:
    return to_markdown(block)


@_block.register
def _pictures(block: Pictures) -> str:
    return "\n\n".join(
        f"![{escape_markdown(picture.alt)}]({figure_file(picture)})\n"
        f"{escape_markdown(picture.caption)}"
        for picture in pictures([block])
    )


@_block.register
def _live(block: Live) -> str:
    return ""


@_block.register
def _lights(block: Lights) -> str:
    rows = tuple(
        (f"{row.name}: {row.word}", *(f"{light.word} ({light.change})" for light in row.lights))
        for row in block.rows
    )
    words = frozenset(range(len(block.head)))
    return f"{to_markdown(Table(block.caption, block.head, rows, words))}\n\n{block.note}"


@_block.register
def _intervals(block: Intervals) -> str:
    rows = tuple((row.name, row.text, row.word) for row in block.rows)
    table = Table(block.caption, (*block.head, ""), rows, frozenset({0, 2}))
    return f"{to_markdown(table)}\n\n{block.note}"


@_block.register
def _beside(block: Beside) -> str:
    return f"{_block(block.narrow)}\n\n{_block(block.wide)}"


@_block.register
def _details(block: Details) -> str:
    return "\n\n".join([f"### {escape_markdown(block.summary)}", *map(_block, block.blocks)])
