"""Pages as Markdown; figures are files beside them."""

from collections.abc import Sequence
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
    Part,
    Pictures,
    Text,
    drawn,
    pictures,
)
from .charts.picture import picture_file
from .tables import Table, escape_markdown, to_markdown


def markdown(title: str, about: str, parts: Sequence[Part], folder: str = "") -> bytes:
    """Return the sections of a page, each under its heading.

    Parameters
    ----------
    title, about : heading, and paragraph below it
    parts : sections
    folder : of the figures
    """
    texts = [f"# {escape_markdown(title)}", escape_markdown(about)]
    for part in parts:
        texts.append(f"## {escape_markdown(part.title)}")
        texts += [_block(block, folder) for block in drawn(part.blocks)]
    return ("\n\n".join(filter(None, texts)) + "\n").encode()


@singledispatch
def _block(block: Block, folder: str) -> str:
    raise TypeError(f"{block!r}: is no block")


@_block.register
def _text(block: Text, folder: str) -> str:
    words = escape_markdown(block.words)
    return f"**{words}**" if block.kind in {"headline", "strong"} else words


@_block.register
def _heading(block: Heading, folder: str) -> str:
    return f"### {escape_markdown(block.words)}"


@_block.register
def _bullets(block: Bullets, folder: str) -> str:
    return "\n".join(f"- {escape_markdown(item)}" for item in block.items)


@_block.register
def _definitions(block: Definitions, folder: str) -> str:
    return "\n".join(
        f"- **{escape_markdown(entry.term)}** ({escape_markdown(entry.tag)}): "
        f"{escape_markdown(entry.words)}"
        for entry in block.entries
    )


@_block.register
def _table(block: Table, folder: str) -> str:
    return to_markdown(block)


@_block.register
def _pictures(block: Pictures, folder: str) -> str:
    return "\n\n".join(
        f"![{escape_markdown(picture.alt)}]({folder}{picture_file(picture)})\n"
        f"{escape_markdown(picture.caption)}"
        for picture in pictures([block])
    )


@_block.register
def _live(block: Live, folder: str) -> str:
    return ""


@_block.register
def _lights(block: Lights, folder: str) -> str:
    rows = tuple(
        (f"{row.name}: {row.word}", *(f"{light.word} ({light.change})" for light in row.lights))
        for row in block.rows
    )
    words = frozenset(range(len(block.head)))
    return f"{to_markdown(Table(block.caption, block.head, rows, words))}\n\n{block.note}"


@_block.register
def _intervals(block: Intervals, folder: str) -> str:
    rows = tuple((row.name, row.text, row.word) for row in block.rows)
    table = Table(block.caption, (*block.head, ""), rows, frozenset({0, 2}))
    return f"{to_markdown(table)}\n\n{block.note}"


@_block.register
def _beside(block: Beside, folder: str) -> str:
    return f"{_block(block.narrow, folder)}\n\n{_block(block.wide, folder)}"


@_block.register
def _details(block: Details, folder: str) -> str:
    return "\n\n".join(
        [f"### {escape_markdown(block.summary)}", *(_block(one, folder) for one in block.blocks)]
    )
