"""The study of the thesis and its machine with one value or table changed, as TOML."""

import copy
import math
import shutil
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final

from support import MACHINE_FILE, PIPELINES, ROOT

CONTENTS: Final = {
    "study": tomllib.loads((PIPELINES / "copeland_thesis.toml").read_text(encoding="utf-8")),
    "machine": tomllib.loads(MACHINE_FILE.read_text(encoding="utf-8")),
}


def leaves(content: Any, prefix: tuple[str, ...] = ()) -> Iterator[tuple[str, ...]]:
    """Paths of all values, those inside quantities too, and of all tables."""
    items = content.items() if isinstance(content, dict) else []
    for key, value in items:
        yield (*prefix, key)
        yield from leaves(value, (*prefix, key))


PATHS: Final = [(name, path) for name, content in CONTENTS.items() for path in leaves(content)]


def make_tree(root: Path) -> Path:
    """Folders for study and machine, and the tables that they name."""
    shutil.copytree(ROOT / "data" / "validation", root / "data" / "validation")
    (root / "data" / "machines").mkdir()
    (root / "pipelines").mkdir()
    return root


def write_changed(root: Path, place: tuple[str, tuple[str, ...]], value: Any, rename: bool) -> Path:
    """Write the study with one value or table replaced, removed (None) or renamed.

    Parameters
    ----------
    root : of `make_tree`
    place : one of PATHS
    value : new value, or new key
    rename : whether a text is the new key

    Returns
    -------
    the study's file
    """
    contents = copy.deepcopy(CONTENTS)
    table = contents[place[0]]
    *parents, last = place[1]
    for key in parents:
        table = table[key]
    if value is None:
        del table[last]
    elif rename and isinstance(value, str):
        table[value] = table.pop(last)
    else:
        table[last] = value
    files = {
        "machine": root / "data" / "machines" / MACHINE_FILE.name,
        "study": root / "pipelines" / "study.toml",
    }
    for name, file in files.items():
        lines = (f"{_quoted(key)} = {toml(item)}" for key, item in contents[name].items())
        file.write_text("\n".join(lines), encoding="utf-8")
    return files["study"]


def toml(value: Any) -> str:
    """Return a value as TOML."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        return repr(value) if math.isfinite(value) else str(value)
    if isinstance(value, int):
        return str(value)
    if isinstance(value, str):
        return _quoted(value)
    if isinstance(value, list):
        return "[" + ", ".join(toml(item) for item in value if item is not None) + "]"
    items = ((key, item) for key, item in value.items() if item is not None)
    return "{" + ", ".join(f"{_quoted(key)} = {toml(item)}" for key, item in items) + "}"


def _quoted(text: str) -> str:
    return '"' + "".join(f"\\U{ord(character):08X}" for character in text) + '"'
