"""Values of a template: their sources are marked, and the mark holds for the written value alone.

`example: 0.0727 kg; thesis 7.1` marks the source of 0.0727 kg. Beside another value the source is
stale, and the value is no example's.
"""

import re
import sys
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final
from zlib import crc32

from ..base.regular_file import read_bytes
from ..base.units import split_key

MARK: Final = "example: "
_END: Final = "; "
_LARGEST_FILE_BYTES: Final = 100_000_000
_VALUE: Final = re.compile(
    r'(?P<key>\w+)(?P<equals> = \{ value = )(?P<value>\[[^\]\n]*\]|"[^"\n]*"|[^,"\[\n]+)'
    r'(?P<comma>, source = ")'
)


def marked(text: str, files: Mapping[str, bytes]) -> str:
    """Return a template's text whose sources are marked as the example's.

    Parameters
    ----------
    text : TOML with quantities `key = { value = …, source = "…" }`, also in comments
    files : content of the data files that values name
    """

    def with_mark(match: re.Match[str]) -> str:
        value = tomllib.loads(f"value = {match['value']}")["value"]
        content = files.get(value, b"") if isinstance(value, str) else b""
        return f"{match[0]}{MARK}{_written(match['key'], value, content)}{_END}"

    return _VALUE.sub(with_mark, text)


def unmarked(source: str, key: str, value: Any, folder: Path) -> tuple[str, bool]:
    """Return a source without its mark, and whether the value is the example's.

    The source of a value that was changed, or whose file was, keeps its mark.

    Parameters
    ----------
    source : source of the value
    key : key of the value, with its unit
    value : value in the file
    folder : that names of data files are relative to
    """
    if not source.startswith(MARK):
        return source, False
    written, _, original = source.removeprefix(MARK).partition(_END)
    content = _content(folder / value) if isinstance(value, str) else b""
    unchanged = bool(original) and written == _written(key, value, content)
    return (original, True) if unchanged else (source, False)


def _written(key: str, value: Any, content: bytes) -> str:
    """Value with its unit; name of a data file with its checksum, as its content counts."""
    unit = split_key(key)[1]
    words = f"[{', '.join(map(_plain, value))}]" if isinstance(value, list) else _plain(value)
    checksum = f"checksum {crc32(content):08x}" if content else ""
    return " ".join(filter(None, [words, unit.symbol if unit else "", checksum]))


def _plain(value: Any) -> str:
    """Number to twelve digits, so that 3 and 3.0 are the same; a word as it is."""
    if isinstance(value, bool | str):
        return str(value)
    is_number = isinstance(value, int | float) and abs(value) <= sys.float_info.max
    return f"{value:.12g}" if is_number else ""  # its field refuses anything else


def _content(file: Path) -> bytes:
    """Content of a data file; empty where it cannot be read, which its reader refuses."""
    try:
        return read_bytes(file, _LARGEST_FILE_BYTES)
    except (OSError, ValueError):
        return b""


def example_sentence(examples: int, read: int) -> str:
    """Say how many of the values that a study reads are the example's; empty where none is."""
    verb = "is" if examples == 1 else "are"
    sentence = f"{examples} of {read} values that this study reads {verb} the example's."
    return sentence if examples else ""
