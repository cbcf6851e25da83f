"""Limits of bands, totals, criteria and lowest values: files, margins, what is refused."""

import numpy as np
import pytest
from sources_study import rated_run
from support import tiny_run

from vibroacoustics import FigureLimit, compare, read_figure_limits
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.report import broken_lines
from vibroacoustics.report.compared.page import ratings_sentences
from vibroacoustics.results.figure_limits import Compared, check_figures
from vibroacoustics.results.rating_changes import rating_changes

MICROPHONE = "pressure front_1m"


@pytest.fixture(scope="module")
def compared():
    study = tiny_run()
    orders = compare(study, study, other_option="counterweight-half")
    return Compared(orders, study, study)


def rows_of(compared, *limits):
    return {row.result: row for row in check_figures(compared, limits)}


def test_total_of_a_study_has_the_remainder(compared):
    rows = rows_of(compared, FigureLimit(60.0, "dB(A)", MICROPHONE))
    level = compared.first["level_total"].sel(option="counterweight-half", receiver="front_1m")
    assert rows["B"].value == pytest.approx(level.item())
    assert rows["B"].margin == pytest.approx(60.0 - level.item())


def test_criterion_of_each_option(compared):
    values = compared.first["criterion_value"].sel(criterion="foot_force_1x_n")
    middle = float(values.mean())
    rows = rows_of(compared, FigureLimit(middle, "N", criterion="foot_force_1x_n"))
    assert rows["A"].is_within == bool(values.sel(option="none") <= middle)
    assert rows["A"].is_within != rows["B"].is_within
    (line,) = broken_lines(compared.orders, list(rows.values()))
    assert line.startswith("criterion foot_force_1x_n in A: ")
    assert line.endswith("N (limit)")


def test_criteria_that_no_study_scores_have_probabilities():
    study = rated_run()
    compared = Compared(compare(study, study, other_option="counterweight-half"), study, study)
    for name, unit, variable, dim in (
        ("rating_level_dba", "dB(A)", "rating_level", "rating_window"),
        ("audibility_db", "dB", "decisive_audibility", "receiver"),
    ):
        assert name not in study["criterion"].values
        worst = study[f"{variable}_by_sample"].max([dim, "speed"]).sel(option="none")
        limit = float(np.quantile(worst, 0.6))
        row = rows_of(compared, FigureLimit(limit, unit, criterion=name))["A"]
        weight = study["sample_weight"].values[0]
        assert row.probability == pytest.approx(float(weight @ (worst.values <= limit)))
        assert row.is_within == (row.probability >= 0.5)


def test_tones_and_rating_levels_of_both():
    study = rated_run()
    compared = Compared(compare(study, study, other_option="counterweight-half"), study, study)
    rows = {one[:2]: one for one in rating_changes(compared, [2900.0])}
    level = rows["rating_level", "bedroom"]
    by_sample = study["rating_level_by_sample"].sel(rating_window="bedroom", speed=2900.0)
    change = by_sample.sel(option="counterweight-half") - by_sample.sel(option="none")
    assert level.change.low <= level.change.value <= level.change.high
    assert change.min() <= level.change.low
    assert level.change.high <= change.max()
    steps = {rows["rating_adjustment", "bedroom"].first.value, rows["tonal_adjustment",
             "front_1m"].second.value}  # fmt: skip
    assert steps <= set(range(7))
    chance = rows["limit_probability", "bedroom"]
    expected = study["limit_probability"].sel(rating_window="bedroom", speed=2900.0)
    assert chance.second.value == expected.sel(option="counterweight-half").item()
    sentence = ratings_sentences(list(rows.values()))[-1]
    assert sentence.startswith("The rating level at bedroom, 2900 rpm, changes by ")
    assert "limit 45 dB(A) met with " in sentence


def test_lowest_order_in_another_unit(compared):
    rms = abs(compared.orders["channel_order"].sel(channel="velocity tx", order=1.0).item())
    limit = FigureLimit(1e3 * rms / np.sqrt(2.0), "mm/s", "velocity tx", order=1.0, side="lowest")
    rows = rows_of(compared, limit)
    assert rows["A"].margin == pytest.approx(0.0, abs=1e-9)
    assert rows["B"].margin < 0.0


def test_band_of_the_machine(compared):
    rows = rows_of(compared, FigureLimit(40.0, "dB", MICROPHONE, band_hz=50.0))
    at = {"option": "none", "receiver": "front_1m", "noise_band": 50.0}
    band = compared.first["total_band_level"].sel(at)
    assert rows["A"].value == pytest.approx(band.item())


@pytest.mark.parametrize(
    ("limit", "words"),
    [
        (FigureLimit(1.0, "dB", "front"), "channel = 'front', in dB: must be one of"),
        (FigureLimit(1.0, "dB(A)", "force x"), "channel = 'force x', in dB"),
        (FigureLimit(1.0, "m/s", "force x", order=1.0), "channel = 'force x', in m/s"),
        (FigureLimit(1.0, "dB", MICROPHONE, band_hz=51.0), "neither result has such a figure"),
        (FigureLimit(1.0, "N", criterion="force"), "neither result has such a figure"),
        (
            FigureLimit(40.0, "dB(A)", criterion="rating_level_dba"),
            r"neither result has such a figure; it needs the table \[rating\] in the study",
        ),
        (FigureLimit(1.0, "kg", criterion="foot_force_1x_n"), "unit = 'kg'"),
    ],
)
def test_limits_of_what_is_not_there(compared, limit, words):
    with pytest.raises(ParameterError, match=words.replace("(", "\\(")):
        check_figures(compared, [limit])


def test_file_of_all_kinds(tmp_path):
    path = tmp_path / "limits.csv"
    rows = ("front,1,,,60,dB,", "front,,500,,45,dB,highest", "front,2,,,1,mPa,lowest",
            ",,,added_mass_kg,1,kg,", "front,,,,62,dB(A),")  # fmt: skip
    header = "channel,order,band_hz,criterion,limit,unit,side"
    path.write_text("\n".join((header, *rows)))
    orders, figures = read_figure_limits(path)
    assert [(one.channel, one.order) for one in orders] == [("front", 1.0)]
    assert [one.figure for one in figures] == ["band", "order", "criterion", "total"]
    assert figures[1].origin == f"{path}: line 4"


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("front,1,500,,60,dB,", "line 2: order, band_hz, criterion: one of them"),
        ("front,1,,,60,dB,upper", "line 2: side = 'upper': must be highest or lowest"),
        ("front,,500,,60,Pa,", "line 2: unit = 'Pa': of a band must be one of dB"),
        ("front,,,,60,N,", "line 2: unit = 'N': of a total must be one of dB, dB"),
        ("front,,-5,,60,dB,", "line 2: band_hz = -5: must be a number above 0"),
        ("front,,,,x,dB,", "line 2: limit = x: must be a finite number"),
        (",,500,,60,dB,", "line 2: channel = '': must be a channel's name"),
        ("front,,,mass,60,kg,", "line 2: channel = 'front': must be"),
    ],
)
def test_lines_that_are_refused(line, words, tmp_path):
    path = tmp_path / "limits.csv"
    path.write_text(f"channel,order,band_hz,criterion,limit,unit,side\n{line}\n")
    with pytest.raises(ParameterError, match=words):
        read_figure_limits(path)
