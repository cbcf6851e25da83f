"""Pages as PDF: nothing of them is lost on paper."""

import base64
import hashlib
import re
from collections.abc import Iterator, Sequence
from html import unescape
from io import BytesIO
from pathlib import Path
from unicodedata import normalize

import pytest
import xarray as xr
from browsers import program
from pages import page_of
from pypdf import PdfReader
from support import assert_refused, command_here, tiny_run

from vibroacoustics.commands import printing
from vibroacoustics.commands.outputs import write_report
from vibroacoustics.report.blocks import Beside, Block, Details, Lights, Part, Text
from vibroacoustics.report.html import for_paper
from vibroacoustics.report.study import analysis_of_study
from vibroacoustics.report.tables import Table

MICROPHONES = "".join(
    f"[receivers.{name}]\nx_mm = {x}\ny_mm = {y}\nheight_mm = 400.0\n"
    for name, x, y in (("side_1m", 0.0, 1082.5), ("rear_1m", -1082.5, 0.0))
)
SIZES = {"a4": (595, 842), "letter": (612, 792)}


@pytest.fixture(scope="module")
def results() -> xr.Dataset:
    return tiny_run(options=MICROPHONES)


def folded_page() -> bytes:
    table = Table("Inner", ("Option", "N"), (("none", "1"),))
    blocks = (Details("More", (table,)), Text("the end"))
    parts = (Part("first", "First", blocks), Part("second", "Second", blocks, folded=True))
    return page_of(*parts).html()


@pytest.mark.parametrize("paper", SIZES)
def test_on_paper_all_is_unfolded_and_the_policy_allows_the_style(paper: str) -> None:
    text = for_paper(folded_page(), paper).decode()
    assert len(re.findall("<details open", text)) == len(re.findall("<details", text)) == 3
    (style,) = re.findall("<style>(.*?)</style>", text, re.DOTALL)
    assert re.search(rf"@page {{ size: {paper};", style, re.IGNORECASE)
    digest = base64.b64encode(hashlib.sha256(style.encode()).digest()).decode()
    assert f"style-src 'sha256-{digest}'" in unescape(text)


def test_folded_sections_have_their_name_within_what_is_folded() -> None:
    """So that a browser opens the section of a link."""
    text = folded_page().decode()
    assert '<section id="first">' in text
    assert re.search(r'<summary><h2>Second</h2></summary>\s*<div id="second">', text)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--pdf",), "--pdf: needs a browser that prints"),
        (("--pdf", "--paper", "b5"), "--paper b5: must be a4 or letter"),
        (("--paper", "a4"), "--paper: is an option of the PDF; give --pdf as well"),
    ],
)
def test_without_browser_or_paper_one_line_and_nothing_written(
    arguments: tuple[str, ...], words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(printing.shutil, "which", lambda name: None)
    assert_refused(command_here("report", tmp_path / "results.nc", *arguments), words)
    assert_refused(command_here("orders", tmp_path / "a.wav", "--rpm", 2900, *arguments), words)
    assert list(tmp_path.iterdir()) == []


def test_a_browser_that_prints_nothing_is_named(tmp_path: Path) -> None:
    browser = tmp_path / "browser"
    browser.write_text("#!/bin/sh\necho cannot open display >&2\n")
    browser.chmod(0o755)
    with pytest.raises(printing.StorageError, match="printed nothing: cannot open display"):
        printing.Printer(str(browser), "a4").printed(folded_page())


def test_every_page_has_a_pdf_of_its_name() -> None:
    class Silent(printing.Printer):
        def printed(self, page: bytes) -> bytes:
            return b"%PDF of " + page

    files = {"report.html": b"page", "scores.csv": b""}
    assert Silent("", "a4").pages(files) == {"report.pdf": b"%PDF of page"}


@pytest.mark.slow
def test_every_table_is_in_the_pdf(results: xr.Dataset) -> None:
    page = analysis_of_study(results)
    reader = _read(printing.Printer(program("chromium"), "a4").printed(page.html()))
    assert _size(reader) == SIZES["a4"]
    pages = [sheet.extract_text() for sheet in reader.pages]
    text = _squeezed("".join(re.sub(r"^\d+ / \d+$", "", sheet, flags=re.M) for sheet in pages))
    wanted = [_squeezed(cell) for part in page.parts for row in _rows(part.blocks) for cell in row]
    assert len(wanted) > 200
    assert [cell for cell in wanted if cell not in text] == []
    for number, sheet in enumerate(pages, 1):
        assert f"{number} / {len(pages)}" in sheet
    for part in page.parts:
        assert _squeezed(part.title) in text
    assert _squeezed("2900 rpm (1× at 48.3 Hz), microphone front_1m") in text


@pytest.mark.long
def test_the_command_prints_on_letter(results: xr.Dataset, tmp_path: Path) -> None:
    write_report(results, tmp_path)
    file = tmp_path / "results.nc"
    outcome = command_here("report", file, "--pdf", "--paper", "letter")
    assert outcome.returncode == 0, outcome.stderr
    assert f"pdf: {tmp_path / 'report.pdf'}" in outcome.stdout.splitlines()
    assert outcome.stderr == ""
    assert _size(_read((tmp_path / "report.pdf").read_bytes())) == SIZES["letter"]


def _read(pdf: bytes) -> PdfReader:
    return PdfReader(BytesIO(pdf))


def _size(reader: PdfReader) -> tuple[int, int]:
    """Of the first page, points."""
    sheet = reader.pages[0].mediabox
    return round(sheet.width), round(sheet.height)


def _squeezed(text: str) -> str:
    """Without blanks, which a line's end may be, and without ligatures."""
    return re.sub(r"\s", "", normalize("NFKC", str(text)))


def _rows(blocks: Sequence[Block]) -> Iterator[tuple[str, ...]]:
    """Rows of all tables and charts, their heads and captions."""
    for block in blocks:
        if isinstance(block, Table):
            yield (block.caption,)
            yield block.head
            yield from block.rows
        elif isinstance(block, Lights):
            yield block.head
            for row in block.rows:
                yield (row.name, *(one.change for one in row.lights))
        elif isinstance(block, Details):
            yield (block.summary,)
            yield from _rows(block.blocks)
        elif isinstance(block, Beside):
            yield from _rows((block.narrow, block.wide))


def test_a_brief_page_omits_what_is_folded() -> None:
    page = folded_page().decode()
    brief = for_paper(folded_page(), "a4", brief=True).decode()
    assert "Inner" in page
    assert "Inner" not in brief
    assert "<details" not in brief
    assert brief.count("the end") == page.count("the end") - 1  # of the folded part
    assert "<h2>First</h2>" in brief
