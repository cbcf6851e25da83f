"""Text in which no character changes the direction of what follows, or controls a terminal."""

import html
import re
from typing import Final

DIRECTIONS: Final = (0x061C, 0x200E, 0x200F, *range(0x202A, 0x202F), *range(0x2066, 0x206A))
"""Bidirectional control characters (Unicode Standard Annex 9): marks, embeddings, isolates."""
_HIDDEN: Final = re.compile(
    f"[{''.join(map(chr, DIRECTIONS))}\\x00-\\x08\\x0b\\x0c\\x0e-\\x1f\\x7f-\\x9f\\ud800-\\udfff]"
)
"""Also control characters but tab and line ends, and bytes of names that are no UTF-8."""


def visible(text: str) -> str:
    """Return a text with the codes of its bidirectional and other control characters."""
    return _HIDDEN.sub(lambda match: f"[U+{ord(match[0]):04X}]", text)


def escape(text: str) -> str:
    """Return a visible text as HTML and SVG show it."""
    return html.escape(visible(text))
