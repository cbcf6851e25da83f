"""Rating levels of a run with samples and of one without, against its own levels."""

import json

import numpy as np
import pytest
from sources_study import RATED, SOURCES_STUDY, rated_run

import vibroacoustics as va
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.report.sections.rating import rating_sentence, rating_table
from vibroacoustics.results.estimates import nominal
from vibroacoustics.study.criterion import CRITERIA
from vibroacoustics.study.loading import load_study


@pytest.fixture(scope="module")
def results():
    return rated_run()


def test_nominal_rating_is_that_of_the_nominal_level(results):
    case = {"speed": 2900.0, "receiver": "left_1m"}
    level = nominal(results, "level_total").sel(case)
    audibility = nominal(results, "decisive_audibility").sel(case)
    added = np.select([audibility <= 2.0, audibility <= 9.0], [0.0, 3.0], 6.0)
    found = nominal(results, "rating_level").sel(speed=2900.0, rating_window="office")
    np.testing.assert_allclose(found, level + added - 10.0 * np.log10(2.0), atol=1e-9)
    assert results["rating_limit"].values.tolist() == [50.0, 70.0, 45.0]


def test_probability_is_the_weight_of_samples_that_meet_the_limit(results):
    weight = results["sample_weight"].values[0]
    level = results["level_total_by_sample"].sel(speed=2900.0, receiver="left_1m")
    least = level.transpose("sample", "option").values - 10.0 * np.log10(2.0)
    found = results["limit_probability"].sel(speed=2900.0, rating_window="office").values
    without_tones = weight @ (least <= 50.0)
    with_six = weight @ (least + 6.0 <= 50.0)
    assert np.all(with_six - 1e-12 <= found)
    assert np.all(found <= without_tones + 1e-12)
    added = results["rating_adjustment"].sel(speed=2900.0, rating_window="office")
    if np.ptp([results[f"rating_adjustment{end}"] for end in ("_10_percent", "_90_percent")]) == 0:
        exact = weight @ (least + added.values <= 50.0)
        np.testing.assert_allclose(found, exact, atol=0.1)


def test_the_section_answers_first(results):
    words = rating_sentence(results, "office")
    assert words.startswith("Rating level at window office: ")
    assert ". Night limit 50: met with " in words
    table = rating_table(results, "office")
    shares = [float(row[1].split()[0]) for row in table.rows]
    assert shares == sorted(shares, reverse=True)
    assert json.loads(results.attrs["parameters"])["rating"]["windows"]["office"]


def test_a_window_without_its_microphone_is_refused():
    lost = {**RATED, "rating.windows.office.receiver": "garden"}
    with pytest.raises(
        ParameterError, match=r"rating.windows.office.receiver = garden: not among the receivers"
    ):
        load_study(SOURCES_STUDY).replace(lost)


def test_the_data_sheet_holds_audibility_and_windows(results):
    sheet = va.data_sheet(results, "none")
    case = results.sel(option="none", speed=2900.0)
    assert sheet.audibility_db == case["decisive_audibility"].max().item()
    window, *_ = sheet.windows
    rated = case.sel(rating_window="office")
    assert window.rating_level_dba == rated["rating_level"].item()
    assert window.rating_level_low_dba == rated["rating_level_10_percent"].item()
    assert window.limit_probability == rated["limit_probability"].item()
    assert window.limit_dba == 50.0
    assert sheet.tonal_adjustment_db in range(7)


def test_the_criterion_is_the_worst_window(results):
    found = CRITERIA["rating_level_dba"]().value(results)
    expected = results["rating_level"].sel(speed=2900.0).max("rating_window").values
    np.testing.assert_array_equal(found.transpose("option").values, expected)
    with pytest.raises(ParameterError, match=r"needs the table \[rating\] in the study"):
        CRITERIA["rating_level_dba"]().value(results.drop_vars("rating_level"))


def test_medians_of_adjustments_are_steps(results):
    """No sample adds 4.5 dB, so the median does not either."""
    for end in ("", "_10_percent", "_90_percent"):
        assert set(results[f"rating_adjustment{end}"].values.ravel()) <= {0.0, 3.0, 6.0}
        assert set(results[f"tonal_adjustment{end}"].values.ravel()) <= set(range(7))


def test_rating_levels_of_samples_have_the_probability_of_the_limit(results):
    weight = results["sample_weight"].values[0]
    level = results["rating_level_by_sample"].transpose(
        *results["limit_probability"].dims, "sample"
    )
    found = (level <= results["rating_limit"]).values @ weight
    np.testing.assert_allclose(found, results["limit_probability"].values, atol=1e-12)


@pytest.mark.parametrize(
    ("values", "where"),
    [
        ({"scoring.criteria.rating_level_dba": {"weight": 1.0, "best": 30.0, "worst": 60.0}},
         "scoring.criteria.rating_level_dba"),
        ({"design": {"option": "damping", "objectives": {"quiet": {"figure": "rating_level_dba"}}}},
         "design.objectives.quiet.figure = rating_level_dba"),
    ],
)  # fmt: skip
def test_a_rating_level_without_windows_is_refused_at_load(values, where):
    study = load_study(SOURCES_STUDY)
    with pytest.raises(ParameterError) as refused:
        study.replace(values)
    (line,) = refused.value.args
    assert line == f"{SOURCES_STUDY}: {where}: needs the table [rating] in the study"
    study.replace(RATED | values)
