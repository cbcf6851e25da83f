"""Rating levels on the first screen, in their section and its files, and in a browser."""

import csv
import io
import re

import pytest
import xarray as xr
from selenium.webdriver import Chrome
from sources_study import rated_run
from support import PIPELINES

import vibroacoustics as va
from vibroacoustics.report.sections.rating import rating_sentence, rating_table, worst_window
from vibroacoustics.report.sections.verdict.words import sentences
from vibroacoustics.report.study import analysis_of_study, render

MOST_WORDS = 90
_SHOWN = (
    "return [...document.querySelectorAll('#verdict > p, #verdict > div > p')]"
    ".map(p => p.innerText)"
)


@pytest.fixture(scope="module")
def results() -> xr.Dataset:
    return rated_run()


@pytest.fixture(scope="module")
def files(results: xr.Dataset) -> dict[str, bytes]:
    return render(results)


def words_of(lines: list[str]) -> int:
    return sum(len(line.split()) for line in lines)


def in_terminal(results: xr.Dataset) -> list[str]:
    """Lines before the table of options."""
    text = analysis_of_study(results).text()
    return text.partition(" rpm (1x at ")[0].splitlines()[:-1]


def test_the_first_screen_has_the_worst_window_alone(results: xr.Dataset) -> None:
    chance = results["limit_probability"].sel(speed=2900.0, option="none")
    window = worst_window(results)
    assert float(chance.sel(rating_window=window)) == chance.min().item()
    assert window != results["rating_window"].values[0]
    first = sentences(results)[0]
    assert f"Rating level at window {window} (worst of 3): " in first
    assert sum("Rating level" in line for line in sentences(results)) == 1
    assert words_of(list(sentences(results))) <= MOST_WORDS
    assert words_of(in_terminal(results)) <= MOST_WORDS


def test_sentence_table_file_and_sheet_have_one_adjustment(
    results: xr.Dataset, files: dict[str, bytes]
) -> None:
    rows = csv.DictReader(io.StringIO(files["rating.csv"].decode()))
    in_file = {
        (row["option"], row["rating_window"]): float(row["value"])
        for row in rows
        if row["quantity"] == "rating_adjustment"
    }
    for window in map(str, results["rating_window"].values):
        cells = {str(row[0]): str(row[3]) for row in rating_table(results, window).rows}
        sheet = {one.window: one.adjustment_db for one in va.data_sheet(results, "none").windows}
        added = re.search(r"including (\S+) dB for the tone", rating_sentence(results, window))
        assert in_file["none", window] == sheet[window] == float(cells["none"].split()[0])
        assert in_file["none", window] == (float(added[1]) if added else 0.0)


@pytest.mark.slow
def test_page_at_both_widths(
    browser: Chrome, files: dict[str, bytes], tmp_path_factory: pytest.TempPathFactory
) -> None:
    """Unfolded it does not scroll sideways; the answer of each option is seen without scrolling."""
    page = tmp_path_factory.mktemp("rating") / "report.html"
    page.write_bytes(files["report.html"])
    for width in (1280, 390):
        size = {"width": width, "height": 844, "deviceScaleFactor": 1, "mobile": width < 400}
        browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
        browser.get(page.as_uri())
        shown = browser.execute_script(_SHOWN)
        assert "(worst of 3)" in shown[0]
        assert words_of(shown) <= MOST_WORDS
        browser.execute_script("document.querySelectorAll('details').forEach(d => d.open = true)")
        assert browser.execute_script("return document.documentElement.scrollWidth") <= width
        right = browser.execute_script(
            "return [...document.querySelectorAll('#rating td:nth-child(-n+3)')]"
            ".map(cell => cell.getBoundingClientRect().right)"
        )
        assert right
        assert max(right) <= width
        assert browser.get_log("browser") == []


@pytest.mark.long
def test_the_neighbour_study_has_at_most_90_words_first() -> None:
    results = va.run(va.load_study(PIPELINES / "neighbour.toml"))
    assert words_of(list(sentences(results))) <= MOST_WORDS
    assert words_of(in_terminal(results)) <= MOST_WORDS
