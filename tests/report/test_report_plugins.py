"""A third party's section and column: shown, kept in the results, rebuilt without it."""

import json
from pathlib import Path

import pytest
import xarray as xr
from pages import comparison_text
from support import command_here
from test_report import make_results

from vibroacoustics.base.errors import PluginError
from vibroacoustics.base.plugin_file import load_plugin
from vibroacoustics.commands import outputs
from vibroacoustics.report import keep, render
from vibroacoustics.report.columns import COLUMNS
from vibroacoustics.report.sections import SECTIONS
from vibroacoustics.results import storage
from vibroacoustics.results.provenance import SCHEMA_VERSION

SECTION = """
from vibroacoustics.base.registry import register
from vibroacoustics.report.blocks import Bullets, Details, Pictures, Text
from vibroacoustics.report.charts.marks import Axis, Chart, Line, Panel
from vibroacoustics.report.sections import Section
from vibroacoustics.report.tables import Table


def blocks(results):
    rows = tuple((str(name), "42") for name in results["option"].values)
    panel = Panel(Axis(), Axis(), (Line([0, 1], [0, 1]),))
    chart = Chart("../prices", "Prices as a line", "Prices.", (panel,))
    return [
        Text("A µ <b>third party</b> says so.", "note"),
        Bullets(("one|two",)),
        Table("Prices", ("Option", "Price"), rows),
        Details("More", (Pictures((chart,)),)),
    ]


register(Section("prices", "What it costs", blocks, position=25.0))
"""
COLUMN = """
from vibroacoustics.base.registry import register
from vibroacoustics.report.columns import Column
from pages import comparison_text

register(
    Column(
        "force_3x_n",
        lambda results: results["force_amplitude"].sel(order=1) / 3.0,
        "Force 3×, N",
        "3x N",
        lambda value, results: f"about {value:.0f}",
    )
)
"""
BARE = "from vibroacoustics.base.registry import register\n"


@pytest.fixture
def results() -> xr.Dataset:
    made = make_results({"none": 1.0, "louder": 1.8})
    return made.assign_attrs(schema_version=SCHEMA_VERSION)


def plugin(folder: Path, content: str, name: str = "mine.py") -> None:
    """Load a plug-in of this content."""
    file = folder / name
    file.write_text(content)
    load_plugin(file)


def test_section_and_column_are_shown_and_made_again_without_the_plugin(
    results: xr.Dataset,
    tmp_path: Path,
) -> None:
    plugin(tmp_path, SECTION, "prices.py")
    plugin(tmp_path, COLUMN, "thirds.py")
    outputs.write_report(results, tmp_path / "run")
    page = (tmp_path / "run" / "report.html").read_text()
    assert page.index('id="comparison"') < page.index('id="prices"') < page.index('id="orders"')
    assert "<summary><h2>What it costs</h2></summary>" in page
    assert "A µ &lt;b&gt;third party&lt;/b&gt; says so." in page
    assert "about 15" in page  # 45.3 N / 3
    assert "about 15" in comparison_text(results)
    csv = (tmp_path / "run" / "comparison.csv").read_text().splitlines()
    assert csv[0].endswith(",level_modelled_dbc,force_3x_n")
    assert csv[1].endswith(",15.1")
    origins = json.loads(storage.open_results(tmp_path / "run" / "results.nc").attrs["plugins"])
    assert origins["section prices"]["file"] == "prices.py"
    assert len(origins["column force_3x_n"]["sha256"]) == 64
    _made_again_is_the_same(tmp_path)


def _made_again_is_the_same(folder: Path) -> None:
    """Where no plug-in is known."""
    for registry, name in ((SECTIONS, "prices"), (COLUMNS, "force_3x_n")):
        del registry._things[name], registry._origins[name]
    words = ("report", folder / "run" / "results.nc", "--out", folder / "again")
    command_here(*words).check_returncode()
    files = sorted(path for path in (folder / "again").rglob("*.*") if path.is_file())
    assert (folder / "again" / "figures" / "_prices.svg") in files
    for path in files:
        if path.name == "files.json":  # says that the dataset does not lie there
            continue
        assert (
            path.read_bytes() == (folder / "run" / path.relative_to(folder / "again")).read_bytes()
        )


@pytest.mark.parametrize(
    ("blocks", "words"),
    [
        ("lambda results: [Text(results['nothing'].item())]", "KeyError"),
        ("lambda results: ['plain text']", "blocks returns a str, must be"),
        ("lambda results: [Text(3)]", "blocks returns a int in words"),
    ],
)
def test_section_that_fails_is_named_in_one_line(
    results: xr.Dataset, tmp_path: Path, blocks: str, words: str
) -> None:
    imports = "from vibroacoustics.report.blocks import Text\n"
    section = "from vibroacoustics.report.sections import Section\n"
    plugin(tmp_path, f"{BARE}{imports}{section}register(Section('odd', 'Odd', {blocks}))\n")
    with pytest.warns(UserWarning, match=f"section odd is omitted: mine.py, line 4: {words}"):
        page = render(results)["report.html"].decode()
    assert page.count(f"section odd is omitted: mine.py, line 4: {words}") == 2  # first screen
    assert "<h2>Provenance</h2>" in page


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ("lambda results: results['nothing']", "KeyError"),
        ("lambda results: results['order_level']", "dimensions are"),
    ],
)
def test_column_that_fails_is_named_in_one_line(
    results: xr.Dataset, tmp_path: Path, values: str, words: str
) -> None:
    column = "from vibroacoustics.report.columns import Column\n"
    plugin(tmp_path, f"{BARE}{column}register(Column('odd_n', {values}, 'Odd'))\n")
    with pytest.warns(UserWarning, match="column odd_n is omitted"):
        files = render(results)
    lines = [line for line in files["comparison.md"].decode().splitlines() if "is omitted:" in line]
    assert len(lines) == 2  # on the first screen, and with the comparison
    assert all(words in line for line in lines)
    assert "odd_n" not in files["comparison.csv"].decode()


def test_what_was_not_kept_is_named(results: xr.Dataset) -> None:
    origin = {"file": "mine.py", "version": "", "sha256": "0"}
    results.attrs["plugins"] = json.dumps({"section odd": origin, "column odd_n": origin})
    page = render(results)["report.html"].decode()
    assert "section odd is missing: mine.py is not loaded" in page
    assert "column odd_n is missing: mine.py is not loaded" in page


def test_section_that_does_not_apply_is_not_missed(results: xr.Dataset, tmp_path: Path) -> None:
    section = "from vibroacoustics.report.sections import Section\n"
    arguments = "'odd', 'Odd', lambda results: [], lambda results: False"
    plugin(tmp_path, f"{BARE}{section}register(Section({arguments}))\n")
    results.attrs["plugins"] = json.dumps({"section odd": {"file": "mine.py"}})
    kept = keep(results)
    del SECTIONS._things["odd"], SECTIONS._origins["odd"]
    assert "is missing:" not in render(kept)["report.html"].decode()


def test_kept_columns_and_sections_outlive_a_second_run(
    results: xr.Dataset, tmp_path: Path
) -> None:
    plugin(tmp_path, COLUMN)
    first = keep(results)
    del COLUMNS._things["force_3x_n"], COLUMNS._origins["force_3x_n"]
    storage.write_results(keep(first), tmp_path / "results.nc")
    again = storage.open_results(tmp_path / "results.nc")
    assert render(again)["comparison.csv"] == render(first)["comparison.csv"]
    assert "about 15" in comparison_text(again)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (
            "from vibroacoustics.report.sections import Section\n"
            "register(Section('scores', 'Mine', lambda results: []))\n",
            "section scores: is built in",
        ),
        (
            "from vibroacoustics.report.columns import Column\n"
            "register(Column('force_1x_n', lambda results: results['force']))\n",
            "column force_1x_n: is built in",
        ),
    ],
)
def test_name_of_a_built_in_one_is_refused(tmp_path: Path, content: str, message: str) -> None:
    with pytest.raises(PluginError, match=message):
        plugin(tmp_path, f"{BARE}{content}")


@pytest.mark.long
def test_report_takes_a_plugin_that_the_run_did_not_have(
    results: xr.Dataset, tmp_path: Path
) -> None:
    storage.write_results(results, tmp_path / "results.nc")
    (tmp_path / "prices.py").write_text(SECTION)
    words = ["report", tmp_path / "results.nc", "--plugin", tmp_path / "prices.py"]
    outcome = command_here(*words)
    assert outcome.returncode == 0, outcome.stderr
    assert "What it costs" in (tmp_path / "report.html").read_text()
