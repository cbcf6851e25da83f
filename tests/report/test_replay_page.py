"""Sounds of a page: players in HTML, links in Markdown, and browsers that read the files."""

import re
from pathlib import Path

import numpy as np
import pytest
from browsers import Firefox
from pages import page_of
from selenium.webdriver import Chrome
from selenium.webdriver.support.ui import WebDriverWait

from vibroacoustics.report.blocks import Part, Sound, Sounds, Text
from vibroacoustics.sound.files import wav_bytes

PAGE = page_of(
    Part("sounds", "Sounds", (Sounds((Sound("before", "a b.wav"), Sound("after", "c.wav"))),))
)
ASKED = "[...document.querySelectorAll('audio')].map(each => [each.readyState, each.duration])"


@pytest.fixture
def page(tmp_path: Path) -> Path:
    for name in ("a b.wav", "c.wav"):
        (tmp_path / name).write_bytes(wav_bytes(np.zeros(8000), 8000, 1.0))
    file = tmp_path / "page.html"
    file.write_bytes(PAGE.html())
    return file


def test_players_and_links() -> None:
    text = PAGE.html().decode()
    assert re.findall(r'<audio controls [^>]*src="([^"]*)"', text) == ["a%20b.wav", "c.wav"]
    assert "media-src &#39;self&#39;" in text
    assert "- [before](a%20b.wav)\n- [after](c.wav)" in PAGE.markdown().decode()
    assert b"media-src" not in page_of(Part("text", "Text", (Text("Words."),))).html()


@pytest.mark.slow
def test_chromium_reads_the_sounds(browser: Chrome, page: Path) -> None:
    browser.get_log("browser")
    browser.get(page.as_uri())
    WebDriverWait(browser, 10).until(
        lambda tab: all(ready > 0 for ready, _ in tab.execute_script(f"return {ASKED}"))
    )
    assert [duration for _, duration in browser.execute_script(f"return {ASKED}")] == [1.0, 1.0]
    assert not browser.get_log("browser")


@pytest.mark.slow
def test_firefox_reads_the_sounds(fox: Firefox, page: Path) -> None:
    fox.open(page.as_uri(), 1000)
    players = fox.run(
        "for (let n = 0; n < 100 && [...document.querySelectorAll('audio')]"
        ".some(each => each.readyState < 1); n++) "
        f"await new Promise(go => setTimeout(go, 100)); return {ASKED}"
    )
    assert [duration for _, duration in players] == [1.0, 1.0]
