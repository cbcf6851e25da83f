"""The project stands alone: it cites nothing that a reader cannot look up."""

import re
import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest
from support import ROOT

FOLDERS = ("vibroacoustics", "data", "docs", "tests", "pipelines", "benchmarks")
BUILT = ("docs/_build/", "docs/examples/", "docs/generated/")
"""Made from the sources by `make docs`."""
PAGES = ("reports/README.md", "README.md", "CHANGELOG.md")
SUFFIXES = {".csv", ".md", ".py", ".svg", ".toml", ".txt"}
# Every pattern has a class of one letter, so that this file does not match itself.
PRIVATE = re.compile(
    r"(?<![\w.])[s]hared/"
    r"|\b[p]hysics(-\d)?\.md"
    r"|\b[m]achines\.yaml"
    r"|\b[d]esign\.md"
    r"|(?<!docs/)(?<!\()\b[r]adiation(-\d)?\.md"
    r"|\b[i]ssues? *#?\d"
    r"|\b[t]he( first| second)? issue"
    r"|\b[s]eed (document )?\d"
    r"|\b[s]eed document"
    r"|\b[p]rototype",
    re.IGNORECASE,
)
AUTHORITIES = {
    "Dagilis", "Estupiñan", "Okoma", "PDSim", "Tsuji", "Zhao", "thesis",  # docs/sources.md
    "Lanchester", "as", "assumed", "classical", "derived", "usual",
}  # fmt: skip


def texts() -> Iterator[Path]:
    for folder in FOLDERS:
        for path in (ROOT / folder).rglob("*"):
            is_built = path.relative_to(ROOT).as_posix().startswith(BUILT)
            if path.suffix in SUFFIXES and not is_built:
                yield path
    yield from (ROOT / page for page in PAGES)


def quantities(table: object, keys: str = "") -> Iterator[tuple[str, str]]:
    """Key and source of every value that has one."""
    if isinstance(table, list):
        for number, entry in enumerate(table):
            yield from quantities(entry, f"{keys}[{number}]")
    if isinstance(table, dict):
        if "value" in table and "source" in table:
            yield keys, table["source"]
        for key, entry in table.items():
            yield from quantities(entry, f"{keys}.{key}")


def test_no_text_cites_what_a_reader_cannot_look_up():
    cited = [
        f"{path.relative_to(ROOT)}:{number}: {line.strip()[:120]}"
        for path in texts()
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
        if PRIVATE.search(line)
    ]
    assert not cited, "\n".join(cited)


@pytest.mark.parametrize(
    "line",
    ["in S" + "hared/rooms.md", "see p" + "hysics-2.md C", "(I" + "ssue 6)", "i" + "ssues 2 and 3",
     "the i" + "ssue's case", "(s" + "eed 4)", "S" + "eed document 0", "d" + "esign.md",
     "r" + "adiation.md: a dipole", "m" + "achines.yaml"],
)  # fmt: skip
def test_a_private_citation_is_seen(line):
    assert PRIVATE.search(line)


@pytest.mark.parametrize(
    "line",
    ["[radiation](radiation.md)", "(docs/radiation.md)", "rng = default_rng(seed=4)", "seed = 7",
     "issuing a warning", "`shared_memory`"],
)  # fmt: skip
def test_what_a_reader_can_look_up_is_let_through(line):
    assert not PRIVATE.search(line)


def test_every_source_says_who():
    """One of the documents of docs/sources.md, an assumption, a derivation, a classical rule."""
    files = [*ROOT.glob("data/machines/*.toml"), *ROOT.glob("pipelines/*.toml")]
    sources = [
        (f"{file.relative_to(ROOT)}{key}", source)
        for file in files
        for key, source in quantities(tomllib.loads(file.read_text(encoding="utf-8")))
    ]
    assert len(sources) > 100
    assert not [pair for pair in sources if re.split(r"\W", pair[1])[0] not in AUTHORITIES]


def test_page_of_sources_has_every_document():
    page = (ROOT / "docs" / "sources.md").read_text(encoding="utf-8")
    for cited in ("thesis", "Zhao", "Estupiñan", "Tsuji", "Dagilis", "PDSim"):
        assert f"| {cited} |" in page
