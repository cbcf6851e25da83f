"""Files, folders and tests that the pages name are in the repository."""

import re
from functools import cache

import pytest
from support import ROOT

BUILT = {"_build", "examples", "generated"}
AT_ROOT = [ROOT / "README.md", ROOT / "CONTRIBUTING.md"]
PAGES = AT_ROOT + [
    page
    for page in sorted((ROOT / "docs").rglob("*.md"))
    if BUILT.isdisjoint(page.relative_to(ROOT / "docs").parts)
]
ROOTS = [ROOT, ROOT / "vibroacoustics", ROOT / "tests"]
"""Folders to which a page names files relative."""
NOT_OURS = {
    r"reports/.*": "written by a command",
    r"docs/(_build|generated)/.*": "written by `make docs`",
    r"\w+/(results|orders)\.nc": "results of two runs of the user",
    r"/?(east|west)/?": "folders and names of the reader's two machines",
    r"\d+/\d+/\d+": "a date",
    r"group/channel": "name of a channel in a TDMS file",
    r"examples/rollingpiston_compressor\.py|PDSim/.*": "files of PDSim",
    r"(1|\w{1,3})(/\w{1,3})+": "a unit",
}
"""Names that are no files of the repository, as regular expressions, with the reason."""
FENCE = re.compile(r"^ *```.*?^ *```", re.DOTALL | re.MULTILINE)
CODE = re.compile(r"`([^`\n]+)`")
PATH = re.compile(r"/?(?:[\w.-]+/)+[\w.-]*|[\w-]+\.py")
TEST = re.compile(r"(test_\w+)(?:::(\w+))?")
PLACEHOLDER = re.compile(r"[A-Z]{4,}")


def stale(text: str) -> list[str]:
    """Return paths and tests in backticks that the repository lacks."""
    return [word for word in words_in_code(text) if _is_stale(word)]


def words_in_code(text: str) -> list[str]:
    """Return the words in backticks outside fenced code."""
    return [word for code in CODE.findall(FENCE.sub("", text)) for word in code.split()]


def _is_stale(word: str) -> bool:
    if test := TEST.fullmatch(word):
        files = [names_by_file().get(test[1], ())] if test[2] else names_by_file().values()
        return not any((test[2] or test[1]) in names for names in files)
    if not PATH.fullmatch(word) or PLACEHOLDER.search(word):
        return False
    if any(re.fullmatch(pattern, word) for pattern in NOT_OURS):
        return False
    return _is_missing(word)


def _is_missing(word: str) -> bool:
    if "/" not in word:
        return word not in python_files()
    return not any((root / word).exists() or (root / f"{word}.py").exists() for root in ROOTS)


@cache
def python_files() -> frozenset[str]:
    """Return names of Python files of the repository."""
    folders = ("vibroacoustics", "tests", "benchmarks", "data", "docs/gallery", "docs/figures")
    return frozenset(file.name for folder in folders for file in (ROOT / folder).rglob("*.py"))


@cache
def names_by_file() -> dict[str, frozenset[str]]:
    """Return the name of each file of tests with those of its functions and its own."""
    return {
        file.stem: frozenset(re.findall(r"^def (test_\w+)", file.read_text("utf-8"), re.MULTILINE))
        | {file.stem}
        for file in (ROOT / "tests").rglob("test_*.py")
    }


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_what_a_page_names_is_there(page):
    assert not stale(page.read_text(encoding="utf-8"))


@pytest.mark.parametrize("page", AT_ROOT, ids=lambda page: page.stem)
def test_links_at_the_root_lead_somewhere(page):
    links = re.findall(r"\]\(([^)#:\s]+)", page.read_text(encoding="utf-8"))
    assert len(links) > 2
    assert not [link for link in links if not (ROOT / link).exists()]


@pytest.mark.parametrize("pattern", NOT_OURS)
def test_every_exception_is_needed(pattern):
    words = {word for page in PAGES for word in words_in_code(page.read_text("utf-8"))}
    paths = [*filter(PATH.fullmatch, filter(re.compile(pattern).fullmatch, words))]
    is_written = NOT_OURS[pattern].startswith("written by")  # and may be there
    assert any(is_written or _is_missing(path) for path in paths)


@pytest.mark.parametrize(
    "name",
    ["radiation/join.py", "commands/nothing.py", "nothing.py", "tests/nothing", "data/nothing.csv",
     "test_nothing", "test_pages::test_nothing", "vibroacoustics/nothing/", "results/nothing"],
)  # fmt: skip
def test_a_stale_name_is_seen(name):
    assert stale(f"The method (`{name}`) is exact.") == [name]


@pytest.mark.parametrize(
    "text",
    ["`tests/house`, `house/test_pages.py`, `test_pages`, `test_paths::test_a_stale_name_is_seen`",
     "`balancers/NAME.py`, `base/vocabulary`, `m/s²`, `reports/a/report.html`, `a.csv`, `a + b`",
     "```\nmore/lines.py\n```"],
)  # fmt: skip
def test_names_that_are_there_are_free(text):
    assert not stale(text)
