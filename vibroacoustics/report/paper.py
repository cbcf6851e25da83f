"""A page as it goes on paper: everything unfolded, on sheets of a size."""

import re
from typing import Final

from .html import content_hash

PAPERS: Final = {"a4": "A4", "letter": "letter"}
"""Names of the sheets as the style writes them."""
_STYLE: Final = re.compile("<style>(.*?)</style>", re.DOTALL)
_DETAILS: Final = re.compile(r'<details(?=>| class="part">)')


def for_paper(page: bytes, paper: str) -> bytes:
    """The HTML page for sheets of `paper`, a name of PAPERS; its policy allows its new style."""
    text = page.decode()
    found_style = _STYLE.search(text)
    if found_style is not None:
        style = found_style[1]
        sized = style.replace("size: A4", f"size: {PAPERS[paper]}")
        text = text.replace(style, sized, 1).replace(content_hash(style), content_hash(sized), 1)
    return _DETAILS.sub("<details open", text).encode()
