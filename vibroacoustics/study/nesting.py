"""How deep a TOML text nests, told before it is parsed: the parser's cost grows with the square."""

import re
from typing import Final

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
