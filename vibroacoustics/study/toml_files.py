"""TOML files as plain tables: reading, extension of one study by another, origin of values."""

import json
import os
import re
import tomllib
from collections.abc import Mapping
from copy import deepcopy
from functools import lru_cache
from pathlib import Path
from typing import Any, Final, NamedTuple

from ..base.errors import ParameterError
from ..base.regular_file import read_text
from ..base.units import si_key

MAXIMUM_FILE_BYTES: Final = 1_000_000
MAXIMUM_DEPTH: Final = 16
MOST_EXTENDED: Final = 8
"""Studies in a chain of `extends`."""
_MOST_PARSED: Final = 16
"""Texts whose tables are kept."""
_STRINGS_AND_COMMENTS: Final = re.compile(
    r'"""(?:[^"\\]|\\.|"(?!""))*+(?:"{3,5}|\\?\Z)'
    r"|'''(?:[^']|'(?!''))*+(?:'{3,5}|\Z)"
    r'|"(?:[^"\\\n]|\\[^\n])*+"?'
    r"|'[^'\n]*+'?"
    r"|#[^\n]*+",
    re.DOTALL,
)
_BETWEEN_KEYS: Final = re.compile(r"[=\[\]{},\n]")
_BRACKET: Final = re.compile(r"[\[\]{}]")


class Written(NamedTuple):
    """Content of a study's file, with that of the study it extends.

    Attributes
    ----------
    path : path of the file
    content : its tables
    origin : file that each value comes from, by its keys
    """

    path: Path
    content: dict[str, Any]
    origin: dict[tuple[str, ...], Path]


def read_toml(path: Path) -> dict[str, Any]:
    """Content of a TOML file, refused in one line where it cannot be read."""
    try:
        text = read_text(path, MAXIMUM_FILE_BYTES).replace("\r\n", "\n")
        content = deepcopy(_parsed(text))
    except FileNotFoundError:
        raise ParameterError(f"{path}: no such file") from None
    except OSError as error:
        raise ParameterError(f"{path}: cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise ParameterError(f"{path}: is not UTF-8 text") from None
    except (ValueError, RecursionError) as error:  # TOMLDecodeError is a ValueError
        raise ParameterError(f"{path}: is not valid TOML: {error}") from None
    if content is None:
        raise ParameterError(f"{path}: is nested deeper than {MAXIMUM_DEPTH} levels")
    if _deeper_than(content, MAXIMUM_DEPTH):
        raise ParameterError(f"{path}: tables are nested deeper than {MAXIMUM_DEPTH} levels")
    return content


@lru_cache(_MOST_PARSED)
def _parsed(text: str) -> dict[str, Any] | None:
    """Tables of a text, none where it is nested too deep; each option reads its machine's anew."""
    return None if nested_deeper_than(text, MAXIMUM_DEPTH) else tomllib.loads(text)


def _deeper_than(content: Mapping[str, Any], depth: int) -> bool:
    tables = (value for value in content.values() if isinstance(value, dict))
    return depth == 0 or any(_deeper_than(table, depth - 1) for table in tables)


def read_with_base(path: Path) -> Written:
    """Merge a study over the one it extends, and so on; also give the file of each value."""
    return _over_base(path, (path,))


def _over_base(path: Path, chain: tuple[Path, ...]) -> Written:
    content = read_toml(path)
    base_name = content.pop("extends", None)
    origin = dict.fromkeys(leaves(content), path)
    if base_name is None:
        return Written(path, content, origin)
    if not isinstance(base_name, str):
        raise ParameterError(f"{path}: extends = {base_name!r}: must be a file name")
    base_path = beside(path, base_name)
    if base_path in chain or len(chain) == MOST_EXTENDED:
        raise ParameterError(
            f"{path}: extends = {base_name}: studies extend one another in a circle, or more than "
            f"{MOST_EXTENDED} of them"
        )
    base = _over_base(base_path, (*chain, base_path))
    return Written(path, merge(base.content, content), base.origin | origin)


def beside(file: Path, name: str) -> Path:
    """A file named relative to the folder of another."""
    return Path(os.path.normpath(file.parent / name))


def merge(base: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """Return tables in which the values of others replace those of the base; false removes a table.

    Parameters
    ----------
    base : content of the extended file
    changes : content of the extending file
    """
    stated = {si_key(key)[0] for key, value in changes.items() if not is_table(value)}
    merged = {  # a value in another unit of the same quantity is replaced too
        key: value
        for key, value in base.items()
        if key in changes or is_table(value) or si_key(key)[0] not in stated
    }
    for key, value in changes.items():
        if value is False and is_table(merged.get(key)):
            del merged[key]
            continue
        nested = isinstance(value, dict) and isinstance(merged.get(key), dict)
        merged[key] = merge(merged[key], value) if nested and not is_quantity(value) else value
    return merged


def is_quantity(value: Any) -> bool:
    """Whether a value is a table of value, source and range."""
    return isinstance(value, dict) and "value" in value


def is_table(value: Any) -> bool:
    """Whether a value is a table of further values."""
    return isinstance(value, dict) and not is_quantity(value)


def leaves(content: Mapping[str, Any], prefix: tuple[str, ...] = ()) -> list[tuple[str, ...]]:
    """Key paths of all values; a quantity table is one value."""
    paths: list[tuple[str, ...]] = []
    for key, value in content.items():
        if isinstance(value, dict) and not is_quantity(value):
            paths += leaves(value, (*prefix, key))
        else:
            paths.append((*prefix, key))
    return paths


def shown_key(key: str) -> str:
    """A key as it is shown: in quotes where it is blank."""
    return key if key.strip() else json.dumps(key)


def nested_deeper_than(text: str, depth: int) -> bool:
    """Whether a key has more parts, or lists and inline tables stand deeper, than a depth.

    Parameters
    ----------
    text : TOML, valid or not
    depth : allowed
    """
    bare = _STRINGS_AND_COMMENTS.sub("", text)
    if any(piece.count(".") >= depth for piece in _BETWEEN_KEYS.split(bare)):
        return True
    level = 0
    for bracket in _BRACKET.findall(bare):
        level += 1 if bracket in "[{" else -1
        if level > depth:
            return True
    return False
