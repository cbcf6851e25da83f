"""Words of a report: few on the page, numbers in files beside it."""

import re
from html.parser import HTMLParser

import pytest
from sources_study import sources_run
from support import PIPELINES

import vibroacoustics as va
from vibroacoustics.report import render

MOST_VISIBLE = 400
MOST_UNFOLDED = 6000
NO_TEXT = {"script", "style", "svg", "title"}
EMPTY = {"meta", "link", "br", "hr", "img", "input", "col", "source", "wbr"}


class Words(HTMLParser):
    """Words of a page; visible ones are outside what is folded."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.visible: list[str] = []
        self.unfolded: list[str] = []

    def handle_starttag(self, tag, attrs):
        if tag not in EMPTY:
            self.open.append(tag)

    def handle_endtag(self, tag):
        while self.open and self.open.pop() != tag:
            pass

    def handle_data(self, data):
        if NO_TEXT & {*self.open}:
            return
        self.unfolded += data.split()
        folds = self.open.count("details")
        if folds - (self.open[-1:] == ["summary"] or "summary" in self.open) <= 0:
            self.visible += data.split()


def words_of(page: bytes) -> Words:
    words = Words()
    words.feed(page.decode())
    return words


@pytest.fixture(scope="module")
def files() -> dict[str, bytes]:
    return render(sources_run())


def test_folded_words_are_not_visible():
    words = words_of(b"<p>a b</p><details><summary>c</summary>d <svg>e</svg></details><br>f")
    assert words.visible == ["a", "b", "c", "f"]
    assert words.unfolded == ["a", "b", "c", "d", "f"]


def test_the_page_is_short(files):
    words = words_of(files["report.html"])
    assert len(words.visible) <= MOST_VISIBLE
    assert len(words.unfolded) <= MOST_UNFOLDED


def test_every_file_that_the_page_names_is_beside_it(files):
    named = {*re.findall(r"\b[a-z_]+\.csv", " ".join(words_of(files["report.html"]).unfolded))}
    assert named <= {*files}
    assert len(named) > 8


@pytest.mark.long
def test_the_report_of_the_main_job_is_short():
    study = va.load_study(PIPELINES / "copeland_sources.toml")
    words = words_of(render(va.run(study))["report.html"])
    assert len(words.visible) <= MOST_VISIBLE
    assert len(words.unfolded) <= MOST_UNFOLDED
