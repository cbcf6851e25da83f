"""Markdown of a page: tables whose cells may hold anything."""

from collections.abc import Iterable, Sequence


def cell(text: object) -> str:
    """Text of a cell, in which no sign ends the table."""
    return " ".join(str(text).split()).replace("|", "\\|")


def table(head: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A Markdown table."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(f"| {' | '.join(map(cell, line))} |" for line in lines)


def code(name: object) -> str:
    """A name of the code; nothing for no name."""
    return f"`{name}`" if str(name) else ""


def first_sentence(docstring: str | None) -> str:
    """What a thing is, from its docstring."""
    paragraph = " ".join((docstring or "").partition("\n\n")[0].split())
    return paragraph.partition(". ")[0].rstrip(".") + "."
