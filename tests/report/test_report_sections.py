"""Sections and blocks of the report, and what it shows of many speeds."""

import json
import re

import numpy as np
import pytest
import xarray as xr
from pages import comparison_text, page_of
from support import ROOT
from test_report import make_results
from test_report_unknowns import with_unknowns

from vibroacoustics.commands.outputs import REPORT_FILES
from vibroacoustics.report import blocks, render
from vibroacoustics.report.blocks import Part
from vibroacoustics.report.charts.marks import Axis, Chart, Line, Panel
from vibroacoustics.report.charts.svg import Picture, picture
from vibroacoustics.report.columns import COLUMNS
from vibroacoustics.report.sections import SECTIONS
from vibroacoustics.report.shown_speeds import few_speeds, few_speeds_words
from vibroacoustics.report.tables import Table
from vibroacoustics.results.stored_study import speeds

PNG = b"\x89PNG and so on"
LIGHT = blocks.Light("uncertain", "−7 to 0", (-0.07, 0.0), 0.05)
EVERY_BLOCK = (
    blocks.Text("see there", "note", (("there", "scores"),)),
    blocks.Text("It is loud.", "headline"),
    blocks.Heading("Head"),
    blocks.Bullets(("first", "a|b")),
    blocks.Definitions((blocks.Definition("term", "no change", "words"),)),
    Table("Caption µ", ("Option", "N"), (("none", "1"),)),
    blocks.Beside(
        blocks.Text("narrow"),
        blocks.Lights(
            "Chart",
            ("Option", "1× force, %"),
            (blocks.LightRow("half", "mixed", (LIGHT,)),),
            "Read.",
        ),
    ),
    blocks.Intervals(
        "Levels",
        ("Part", "dB(A)"),
        (
            blocks.Interval("a|b", "50 (45 to 60)", 45.0, 50.0, 60.0, "part"),
            blocks.Interval("half", "0.0", 40.0, 40.0, 40.0, "no change"),
        ),
        (40.0, 60.0),
        (42.0, 44.0),
        "Levels do not add up.",
    ),
    blocks.Details("Fold", (blocks.Pictures((Picture("one", "alt", "caption", PNG),)),)),
)
BUILT_IN = [
    "verdict",
    "rating",
    "reasons",
    "comparison",
    "baseline",
    "live",
    "sources",
    "measured-spectrum",
    "alternatives",
    "paths",
    "structure-borne",
    "in-room",
    "shell-test",
    "run-up",
    "speeds",
    "unknowns",
    "tones",
    "orders",
    "vibration",
    "forces",
    "mounts",
    "radiation",
    "stopping",
    "scores",
    "evidence",
    "claims",
    "example",
    "assumptions",
    "errata",
    "provenance",
]
NOT_HERE = {
    "vibration",
    "rating",
    "alternatives",
    "example",
    "measured-spectrum",
    "run-up",
    "evidence",
    "live",
    "stopping",
    "baseline",
    "paths",
    "structure-borne",
    "in-room",
    "shell-test",
    "tones",
    "speeds",
}
"""What the results of these tests do not have."""


@pytest.fixture(scope="module")
def results() -> xr.Dataset:
    made = with_unknowns()
    parameters = json.loads(made.attrs["parameters"])
    parameters["machine"]["errata"] = [{"item": "Mass", "printed": "1", "finding": "2"}]
    return made.assign_attrs(parameters=json.dumps(parameters))


def test_charts_become_pictures() -> None:
    line = Chart("line", "alt", "caption", (Panel(Axis(), Axis(), (Line([0, 1], [2, 3]),)),))
    folded = (blocks.Details("Fold", (blocks.Pictures((line,)),)),)
    assert list(blocks.charts(folded)) == [line]
    assert list(blocks.pictures(folded)) == [picture(line)]
    assert blocks.from_json(blocks.to_json(folded)) == blocks.rendered(folded)


def test_blocks_survive_json() -> None:
    assert blocks.from_json(blocks.to_json(EVERY_BLOCK)) == EVERY_BLOCK
    assert blocks.to_json(EVERY_BLOCK).isascii()


def test_every_block_is_in_both_forms() -> None:
    page = page_of(Part("mine", "Mine", EVERY_BLOCK))
    in_html, in_markdown = page.html().decode(), page.markdown().decode()
    assert '<p class="note">see <a href="#scores">there</a></p>' in in_html
    assert '<span class="tag tag-no-change">no change</span>' in in_html
    assert "<details><summary>Fold</summary>" in in_html
    assert "data:image/png;base64," in in_html
    assert "- a\\|b" in in_markdown
    assert "![alt](figures/one.png)" in in_markdown
    assert "| none | 1 |" in in_markdown
    assert "| half: mixed | uncertain (−7 to 0) |" in in_markdown
    assert re.search(r'<div class="beside"><div>\s*<p>narrow</p>', in_html)
    assert 'aria-label="uncertain"' in in_html
    assert 'class="bar uncertain"' in in_html
    assert page.files()["figures/one.png"] == PNG


def test_a_chart_of_intervals_is_drawn_to_its_scale() -> None:
    """From 40 to 60: 45, 50 and 60 are 25, 50 and 100 % along the axis."""
    page = page_of(Part("mine", "Mine", EVERY_BLOCK))
    in_html, in_markdown = page.html().decode(), page.markdown().decode()
    (table,) = re.findall(r'<table class="intervals">(.*?)</table>', in_html, re.DOTALL)
    assert "<caption>Levels</caption>" in table
    first, second = re.findall(r"<tr>(<th scope=\"row\".*?)</tr>", table, re.DOTALL)
    drawn = [
        [float(number) for number in re.findall(r"M([\d.]+) 5H([\d.]+)", row)[0]]
        for row in (first, second)
    ]
    assert drawn == [[25.0, 100.0], [0.0, 0.0]]
    assert [float(one) for one in re.findall(r"M([\d.]+) 1V9", table)] == [50.0, 0.0]
    assert float(re.findall(r"M([\d.]+) 0H[\d.]+V10", first)[0]) == 10.0
    assert float(re.findall(r"0H([\d.]+)V10", first)[0]) == 20.0
    assert 'class="bar part"' in first
    assert "<strong>" not in first
    assert 'class="bar no-change"' in second
    assert "<strong>no change</strong>" in second
    assert "Levels do not add up." in in_html
    assert "| a\\|b | 50 (45 to 60) | part |" in in_markdown
    assert "| half | 0.0 | no change |" in in_markdown
    assert "Levels do not add up." in in_markdown
    (read,) = (
        block for block in blocks.from_json(blocks.to_json(EVERY_BLOCK))
        if isinstance(block, blocks.Intervals)
    )  # fmt: skip
    assert read in EVERY_BLOCK


def test_what_is_no_block_is_refused() -> None:
    chart = {"name": "a", "alt": "", "caption": "", "panels": []}
    with pytest.raises(ValueError, match="a chart where a finished picture is expected"):
        blocks.from_json(json.dumps([{"block": "pictures", "pictures": [chart]}]))
    for wrong in ("words", [blocks.Text(3)], [Table("c", ("a",), ((1,),))]):  # type: ignore[arg-type]
        with pytest.raises(ValueError, match="validation error"):
            blocks.to_json(wrong)  # type: ignore[arg-type]


def test_files_of_sections_belong_to_the_report() -> None:
    """`report` warns of older ones beside it, so it knows their names."""
    folder = ROOT / "vibroacoustics" / "report" / "sections"
    texts = [file.read_text("utf-8") for file in folder.rglob("*.py")]
    names = {name for text in texts for name in re.findall(r'"(\w+\.csv)"', text)}
    assert {"inputs.csv", "uncertainty.csv"} <= names <= set(REPORT_FILES)


def test_sections_are_in_their_order() -> None:
    assert [name for name in SECTIONS if name not in SECTIONS.origins()] == BUILT_IN


@pytest.mark.parametrize("name", sorted({*BUILT_IN} - NOT_HERE))
def test_every_section_is_html_and_markdown(name: str, results: xr.Dataset) -> None:
    section = SECTIONS[name]
    assert section.applies(results)
    page = page_of(Part(name, section.title, tuple(section.blocks(results))))
    in_html, in_markdown = page.html().decode(), page.markdown().decode()
    assert f'<section id="{name}">\n<h2>{section.title}</h2>' in in_html
    assert f"## {section.title}\n" in in_markdown
    captions = re.findall(r"<caption>(.*?)</caption>", in_html)
    assert len(captions) == len(re.findall(r"^\|[-: |]+\|$", in_markdown, re.MULTILINE))
    assert in_html.count("<img ") == in_markdown.count("](figures/")
    assert captions or "<img " in in_html


def test_contents_lead_to_every_other_section() -> None:
    parts = tuple(Part(name, name.upper(), EVERY_BLOCK) for name in ("one", "two", "three"))
    contents = re.search(r"<nav.*?</nav>", page_of(*parts).html().decode(), re.DOTALL)
    assert contents is not None
    assert re.findall(r'href="#(.*?)"', contents[0]) == ["two", "three"]


def test_folded_sections_are_the_contents_and_links_lead_into_them(results: xr.Dataset) -> None:
    page = render(results)["report.html"].decode()
    assert "<nav" not in page
    folded = re.findall(
        r'<details class="part"><summary><h2>.*?</h2></summary>\s*<div id="(.*?)">', page
    )
    assert len(folded) == len(re.findall("<h2>", page)) - 1
    assert set(re.findall(r'href="#([a-z_]*?)">', page)) <= {"verdict", *folded}


def test_names_and_units_of_the_columns() -> None:
    assert [column.name for column in COLUMNS.values()][:2] == ["force_1x_n", "force_2x_n"]
    for column in COLUMNS.values():
        assert column.name.rsplit("_", 1)[1] in {"n", "nm", "db", "dba", "dbc"}
        assert not column.change_of or column.change_of in COLUMNS


def many(count: int = 23) -> xr.Dataset:
    """Results at many speeds, the catalogue's 2900 rpm among them."""
    grid = [*np.linspace(2000.0, 3700.0, count - 1), 2900.0]
    return make_results({"none": 1.0, "halved": 0.5}, speeds=sorted(grid))


def test_six_speeds_are_chosen_evenly() -> None:
    results = many()
    shown = speeds(few_speeds(results))
    assert len(shown) == 6
    assert {2000.0, 2900.0, 3700.0} <= set(shown)
    assert shown == sorted(shown)
    assert max(np.diff(shown)) < 3.0 * min(np.diff(shown))
    assert few_speeds_words(results) == "6 of 23 speeds; all are in comparison.csv."
    few = results.isel(speed=slice(6))
    assert few_speeds(few) is few
    assert few_speeds_words(few) == ""


def test_speeds_in_any_order_keep_it() -> None:
    results = many().isel(speed=slice(None, None, -1))
    assert speeds(few_speeds(results))[0] == 3700.0
    assert set(speeds(few_speeds(results))) == set(speeds(few_speeds(many())))


def test_the_catalogue_speed_may_be_missing_or_last() -> None:
    results = many()
    without = results.sel(speed=results["speed"] != 2900.0)
    assert len(speeds(few_speeds(without))) == 6
    slow = results.sel(speed=slice(None, 2900.0))
    assert speeds(few_speeds(slow))[-1] == 2900.0


def test_the_page_shows_one_of_many_speeds() -> None:
    files = render(many())
    page = files["report.html"].decode()
    assert page.count(", microphone front_1m</caption>") == 1
    assert "at 2000 to 3700 rpm (33.3 to 61.7 Hz)" in page
    assert len(files["comparison.csv"].decode().splitlines()) == 1 + 23 * 2 * 2
    assert "6 of 23 speeds" in comparison_text(many())


@pytest.mark.long
def test_the_page_does_not_grow_with_the_speeds() -> None:
    pages = [render(many(count))["report.html"] for count in (8, 60)]
    assert len(pages[1]) < 1.2 * len(pages[0])
