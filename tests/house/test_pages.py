"""Check that the pages stay short: words of all pages together, and of each page."""

import re
from pathlib import Path

import pytest
from support import ROOT

LARGEST_TOTAL = 47_000
LARGEST_PAGE = 2_250
BUILT = {"_build", "examples", "generated"}
PROSE = ("{glossary}",)
"""Directives whose fence holds prose."""
FENCE = re.compile(r" *(?P<mark>`{3,}|~{3,})(?P<kind>\S*)")


def pages() -> list[Path]:
    """Return README and the pages that are written by hand."""
    docs = ROOT / "docs"
    return [
        ROOT / "README.md",
        *(
            page
            for page in sorted(docs.rglob("*.md"))
            if BUILT.isdisjoint(page.relative_to(docs).parts)
        ),
    ]


def words(text: str) -> int:
    """Return the number of tokens with a letter outside fenced code."""
    count, end, is_code = 0, "", False
    for line in text.splitlines():
        fence = FENCE.match(line)
        if line.strip() == end:
            end, is_code = "", False
        elif fence and not end:
            end, is_code = fence["mark"], not fence["kind"].startswith(PROSE)
        elif not is_code:
            count += sum(any(map(str.isalpha, token)) for token in line.split())
    return count


def long_pages(number_by_page: dict[str, int]) -> list[str]:
    """Return what is longer than allowed."""
    total = sum(number_by_page.values())
    found = [
        f"{page}: {number} words, at most {LARGEST_PAGE}"
        for page, number in number_by_page.items()
        if number > LARGEST_PAGE
    ]
    return found + [f"all pages: {total} words, at most {LARGEST_TOTAL}"] * (total > LARGEST_TOTAL)


def test_pages_are_short():
    number_by_page = {
        str(page.relative_to(ROOT)): words(page.read_text(encoding="utf-8")) for page in pages()
    }
    assert len(number_by_page) > 50
    assert not long_pages(number_by_page)


@pytest.mark.parametrize(
    ("text", "number"),
    [
        ("# Order maps\n\n12 dB(A), 3.5 | --- | at 1×", 4),
        ("one\n```python\nimport this\n```\ntwo", 2),
        ("one\n```{code-block} toml\n:caption: a\n\nkey = 1\n```\ntwo", 2),
        ("  ```\n  code\n  ```\n~~~\nmore ``` code\n~~~\nword", 1),
        ("```{glossary}\nterm\n  Meaning of it.\n```\n", 4),
    ],
)
def test_words_are_counted_outside_of_code(text, number):
    assert words(text) == number


def test_long_pages_are_found():
    assert not long_pages({"a.md": LARGEST_PAGE, "b.md": LARGEST_PAGE})
    assert long_pages({"a.md": LARGEST_PAGE + 1}) == [
        f"a.md: {LARGEST_PAGE + 1} words, at most {LARGEST_PAGE}"
    ]
    many = {f"{number}.md": LARGEST_PAGE for number in range(LARGEST_TOTAL // LARGEST_PAGE)}
    many["last.md"] = LARGEST_TOTAL % LARGEST_PAGE
    assert not long_pages(many)
    assert long_pages({**many, "further.md": 1}) == [
        f"all pages: {LARGEST_TOTAL + 1} words, at most {LARGEST_TOTAL}"
    ]
