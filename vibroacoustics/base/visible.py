"""Text in which no character changes the direction of what follows."""

import html
from typing import Final

DIRECTIONS: Final = (0x061C, 0x200E, 0x200F, *range(0x202A, 0x202F), *range(0x2066, 0x206A))
"""Bidirectional control characters (Unicode Standard Annex 9): marks, embeddings, isolates."""
_CODES: Final = {code: f"[U+{code:04X}]" for code in DIRECTIONS}


def visible(text: str) -> str:
    """Return a text with the codes of its bidirectional control characters in their place."""
    return text if text.isascii() else text.translate(_CODES)


def escape(text: str) -> str:
    """Return a visible text as HTML and SVG show it."""
    return html.escape(visible(text))
