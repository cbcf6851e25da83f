"""Docstrings of the package as sphinx reads them: they are plain words with NumPy's sections."""

import re
from collections.abc import Iterator

LISTS = ("Parameters", "Attributes")
_NAMED = re.compile(r"^([\w*, ]+?) : (.*)$")
_QUOTED = re.compile(r"(`+[^`]+`+)")


def readable(lines: list[str]) -> list[str]:
    """Lines with signs of mathematics kept as such and words after a name as its description.

    After the colon of a parameter stands what it is, not its type; `Returns` holds free words.
    """
    return list(_readable(lines))


def _readable(lines: list[str]) -> Iterator[str]:
    section, in_doctest = "", False
    for number, line in enumerate(lines):
        following = lines[number + 1].strip() if number + 1 < len(lines) else ""
        in_doctest = line.lstrip().startswith(">>>") or (in_doctest and bool(line.strip()))
        if following and set(following) == {"-"}:
            section = line.strip()
        named = _NAMED.match(line) if section in LISTS else None
        if in_doctest:
            yield line
        elif section == "Returns" and line.strip() == "Returns":
            yield from ("", "**Returns**")
        elif section == "Returns" and set(line.strip()) == {"-"}:
            yield ""
        elif named:
            yield named[1]
            yield f"    {escaped(named[2])}"
        else:
            yield escaped(line)


def escaped(line: str) -> str:
    """A line in which stars and bars outside of quotes are no markup."""
    parts = _QUOTED.split(line)
    return "".join(
        part if number % 2 else re.sub(r"([*|])", r"\\\1", part)
        for number, part in enumerate(parts)
    )
