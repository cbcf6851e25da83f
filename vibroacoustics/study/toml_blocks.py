"""Text of a TOML file as blocks of lines, so that tables are taken out with their comments."""

import re
import tomllib
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any, Final

_HEADER: Final = re.compile(r"(\[\[?)\s*([^\[\]]+?)\s*\]\]?\s*(?:#.*)?$")
_KEY: Final = re.compile(r'("[^"]*"|[\w-]+)\s*=')


@dataclass
class Entry:
    """A key with its value.

    Attributes
    ----------
    key : last part
    line : whole line of the file
    comments : lines before it
    active : whether it is written without a mark of a comment
    """

    key: str
    line: str
    comments: list[str] = field(default_factory=list)
    active: bool = True

    @property
    def value(self) -> Any:
        """Value as TOML reads it."""
        return tomllib.loads(self.line)[self.key.strip('"')]

    def lines(self) -> list[str]:
        """Lines of the file."""
        return [*self.comments, self.line if self.active else f"# {self.line}"]


@dataclass
class Block:
    """A table of a file.

    Attributes
    ----------
    header : line that names it; empty for the first values of a file
    keys : parts of its name
    entries : its values
    comments : lines before it
    """

    header: str = ""
    keys: tuple[str, ...] = ()
    entries: list[Entry] = field(default_factory=list)
    comments: list[str] = field(default_factory=list)

    def entry(self, key: str) -> Entry | None:
        """Entry of a key; None where it has none."""
        return next((each for each in self.entries if each.key == key), None)

    def put(self, new: Entry) -> None:
        """Replace the entry of the same key, or add one."""
        for number, old in enumerate(self.entries):
            if old.key == new.key:
                self.entries[number] = Entry(new.key, new.line, old.comments, new.active)
                return
        self.entries.append(new)

    def comment_out(self) -> None:
        """Turn all its values, and so its header, to comments."""
        for entry in self.entries:
            entry.active = False

    def lines(self) -> list[str]:
        """Lines of the file."""
        active = not self.entries or any(entry.active for entry in self.entries)
        header = [self.header if active else f"# {self.header}"] if self.header else []
        return [*self.comments, *header, *(line for each in self.entries for line in each.lines())]


def blocks_of(text: str) -> list[Block]:
    """Blocks of a file's text whose values have one line each; the first has no header."""
    blocks = [Block()]
    comments: list[str] = []
    for line in filter(None, map(str.strip, text.splitlines())):
        header, key = _HEADER.match(line), _KEY.match(line)
        if line.startswith("#"):
            comments.append(line)
            continue
        if header is not None:
            keys = tuple(part.strip().strip('"') for part in header[2].split("."))
            blocks.append(Block(line, keys, comments=comments))
        elif key is not None:
            blocks[-1].entries.append(Entry(key[1], line, comments))
        else:
            raise ValueError(f"a value has several lines: {line}")
        comments = []
    return blocks


def text_of(blocks: Iterable[Block]) -> str:
    """Text of a file of blocks, an empty line between two of them."""
    return "\n\n".join("\n".join(block.lines()) for block in blocks if block.lines()) + "\n"
