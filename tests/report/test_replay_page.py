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

PAIR = (Sound("before", "a b.wav"), Sound("after", "c.wav"))
PAGE = page_of(Part("sounds", "Sounds", (Sounds(PAIR, blind=True),)))
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
    assert text.count("<script>") == 1
    plain = page_of(Part("sounds", "Sounds", (Sounds(PAIR),))).html()
    assert b"<script" not in plain
    assert b"media-src" in plain
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


BLIND = """
const [test] = window.blindSounds, button = (name) => test.at(name);
const wait = async (ready) => {
  for (let n = 0; n < 100 && !ready(); n++) await new Promise((go) => setTimeout(go, 50));
};
const disabled = () => ["X", "is-A", "is-B"].every((name) => button(name).disabled);
const shown = !test.panel.hidden, first = disabled();
button("start").click();
const played = new Set();
let trials = 0, alone = true, sounded = true;
while (!test.abx.finished) {
  trials += 1;
  test.players.A.currentTime = 0;
  await test.players.A.play();
  button("X").click();
  // Firefox without a sound card stops with an error once it knows the sound's length
  await wait(() => test.hidden.readyState > 0 && (!test.hidden.paused || test.hidden.error));
  alone = alone && test.players.A.paused;
  sounded = sounded && test.hidden.duration === 1;
  const heard = decodeURIComponent(test.hidden.src.split("/").pop()) === "a b.wav" ? "A" : "B";
  played.add(heard);
  // right eight times, wrong twice
  button(`is-${trials > 8 ? { A: "B", B: "A" }[heard] : heard}`).click();
}
return [shown, first, disabled(), alone, sounded, test.hidden.paused, trials, played.size,
  button("score").textContent];
"""
BLIND_RESULT = [
    True, True, True, True, True, True, 10, 2,
    "8 of 10 right, 10 in all; by guessing as many or more in 5.5 %",
]  # fmt: skip
"""(45 + 10 + 1)/1024 by hand; X was A and B, but for one series of ten in 512."""


@pytest.mark.slow
def test_a_blind_test_in_chromium(browser: Chrome, page: Path) -> None:
    browser.get_log("browser")
    browser.get(page.as_uri())
    body = f"const done = arguments[0]; (async () => {{{BLIND}}})().then(done)"
    browser.set_script_timeout(60)
    assert browser.execute_async_script(body) == BLIND_RESULT
    assert not browser.get_log("browser")


@pytest.mark.slow
def test_a_blind_test_in_firefox(fox: Firefox, page: Path) -> None:
    fox.open(page.as_uri(), 1000)
    assert fox.run(BLIND) == BLIND_RESULT
