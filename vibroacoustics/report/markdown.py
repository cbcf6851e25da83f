"""Pages as Markdown; figures are files beside them."""

from collections.abc import Sequence
from urllib.parse import quote

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
    pictures,
    rendered,
)
from .charts.svg import picture_file
from .tables import Table, escape_markdown, to_markdown


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
