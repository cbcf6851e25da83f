"""Titles of options, machines and criteria stand in reports and figures; CSV keeps the names."""

import csv
import io

import pytest
from pages import page_of
from support import ROOT, TINY, assert_refused, command_here, made_up_radiation

import vibroacoustics as va
from vibroacoustics.report.charts.marks import Line
from vibroacoustics.report.sections import SECTIONS
from vibroacoustics.report.sections.comparison import comparison_data
from vibroacoustics.report.sections.scores import criteria_table, scores_data
from vibroacoustics.report.study import analysis_of_study
from vibroacoustics.report.tables import to_csv
from vibroacoustics.results.titles import chosen, option_titles, titled

TITLE = "Half of the counterweight"
MACHINE = "Our scroll"
CRITERION = "What a foot passes on"
NAME = "counterweight-half"


@pytest.fixture(scope="module")
def results():
    values = {
        f"options.{NAME}.title": TITLE,
        "machine.title": MACHINE,
        "scoring.criteria.foot_force_1x_n.title": CRITERION,
    }
    study = va.load_study(TINY).replace(values)
    assert study.options[NAME].model_dump() == va.load_study(TINY).options[NAME].model_dump()
    return va.run(study, radiation=made_up_radiation)


def test_the_report_shows_titles(results, monkeypatch):
    some = ("verdict", "comparison")
    monkeypatch.setattr(
        "vibroacoustics.report.study.sections_of", lambda _: [SECTIONS[name] for name in some]
    )
    page = analysis_of_study(results)
    assert page.kind == MACHINE
    for part in page.parts:
        shown = str(part.blocks)
        assert TITLE in shown, part.name
        assert NAME not in page_of(part).html().decode(), part.name
    for text in (page.text(), *page.summary):
        assert NAME not in text
    assert TITLE in page.text()
    assert results["criterion_label"].item() == CRITERION
    assert CRITERION in str(criteria_table(results).rows)


def test_csv_keeps_the_names(results):
    for made in (to_csv(comparison_data(results)), to_csv(scores_data(results))):
        rows = list(csv.DictReader(io.StringIO(made.decode())))
        assert {row["option"] for row in rows} == {"none", NAME}
    assert results["option"].values.tolist() == ["none", NAME]


def test_figures_show_titles_and_take_names(results):
    chart = va.plot.levels_over_speed.__wrapped__(results, options=["none", NAME])
    labels = [mark.label for mark in chart.panels[0].marks if isinstance(mark, Line)]
    assert [label.replace("\n", " ") for label in labels] == ["none", TITLE]
    assert va.plot.levels_over_speed(results, options=[TITLE]).axes[0].lines
    shown = titled(results)
    assert titled(shown).identical(shown)
    assert chosen(shown, "option", NAME) == TITLE
    assert chosen(results, "option", TITLE) == NAME
    drawn = titled(results.assign_coords(shown_option=["none", NAME]))
    assert drawn["shown_option"].values.tolist() == ["none", TITLE]
    assert option_titles(results) == {NAME: TITLE}


@pytest.mark.parametrize(
    ("table", "title", "said"),
    [
        (NAME, '""', "must be a line of text"),
        (NAME, "3", "must be a line of text"),
        (NAME, f'"{"x" * 61}"', "has 61 letters; allowed 1 to 60"),
        (NAME, '"none"', "is name or title of another option"),
        ("none", '"As built"', "every report names it none"),
    ],
)
def test_titles_that_say_nothing_are_refused(tmp_path, table, title, said):
    text = TINY.read_text().replace("../../data", str(ROOT / "data"))
    file = tmp_path / "study.toml"
    file.write_text(text.replace(f"[options.{table}]", f"[options.{table}]\ntitle = {title}"))
    assert_refused(command_here("check", file), f"options.{table}.title = ", said)
