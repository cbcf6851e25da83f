"""Criteria of third parties and criteria that a study gives: values, words, refusals, report."""

import json
import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from support import ROOT, TINY, assert_refused, command_here, tiny_run

from vibroacoustics import report, scoring
from vibroacoustics.base.errors import ParameterError, PluginError
from vibroacoustics.base.plugin_file import load_plugin
from vibroacoustics.results import storage
from vibroacoustics.study.criterion import CRITERIA
from vibroacoustics.study.loading import load_study
from vibroacoustics.study.scoring import Scoring
from vibroacoustics.study.study import Study

THIRD_PARTY = (ROOT / "tests" / "third_party" / "second_order.py").read_text()
"""The criterion that the tutorial shows."""
SECOND_FORCE = "force_2x_n = { weight = 1.0, best = 0.0, worst = 50.0 }\n"
GIVEN = """
[options.none.given]
cost_eur = 0
room = { value = 3, source = "assumed: nothing is added", range = [2, 3] }

[options.counterweight-half.given]
cost_eur = { value = 4.5, source = "classical: a lump of iron" }
room = 2.5
"""
COST = "cost_eur = { weight = 2.0, best = 0.0, worst = 10.0 }\n"
ROOM = 'room = { weight = 1.0, best = 3.0, worst = 1.0, label = "Free room", unit = "marks" }\n'
StudyFile = Callable[..., Path]


@pytest.fixture
def third_party(tmp_path: Path) -> Path:
    """File of a third party's criterion."""
    assert len(CRITERIA) == 10  # the built-in ones
    file = tmp_path / "second_force.py"
    file.write_text(THIRD_PARTY)
    return file


@pytest.fixture
def study_file(tmp_path: Path) -> StudyFile:
    """The tiny study with further tables of options and lines of criteria."""

    def write(options: str = "", criteria: str = "", name: str = "mine.toml") -> Path:
        text = TINY.read_text().replace("../../data", str(ROOT / "data"))
        file = tmp_path / name
        file.write_text(text.replace("[receivers.", f"{options}\n[receivers.", 1) + criteria)
        return file

    return write


@pytest.fixture(scope="module")
def judged() -> xr.Dataset:
    """Results with two given criteria beside a computed one."""
    return tiny_run(GIVEN, COST + ROOM)


# --- a third party's ----------


@pytest.mark.long
def test_third_partys_criterion_is_scored_and_reported_without_its_file(
    third_party: Path, tmp_path: Path
) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(CRITERIA, "_things", dict(CRITERIA._things))
        patch.setattr(CRITERIA, "_origins", dict(CRITERIA._origins))
        load_plugin(third_party)
        results = tiny_run(criteria=SECOND_FORCE)
    assert "force_2x_n" not in CRITERIA
    value = results["criterion_value"].sel(criterion="force_2x_n")
    np.testing.assert_array_equal(value, results["force_amplitude"].sel(order=2).max("speed"))
    assert value["criterion_label"] == "Largest force at twice the speed"
    assert value["criterion_unit"] == "N"  # of the suffix
    assert "criterion force_2x_n" in json.loads(results.attrs["plugins"])
    file = storage.write_results(results, tmp_path / "results.nc")
    files = report.render(storage.open_results(file))
    row = b'Largest force at twice the speed</th><td class="words">N</td>'
    assert row in files["report.html"]
    assert files["scores.csv"].startswith(b"option,foot_force_1x_n,force_2x_n,score_")
    assert_refused(command_here("score", file), "criterion force_2x_n: unknown")


def test_third_partys_criterion_comes_after_the_built_in_ones(third_party: Path) -> None:
    load_plugin(third_party)
    assert list(CRITERIA)[-1] == "force_2x_n"
    assert len(CRITERIA) == 11


def test_third_partys_criterion_of_a_built_in_name_is_refused(third_party: Path) -> None:
    third_party.write_text(THIRD_PARTY.replace("force_2x_n", "added_mass_kg"))
    with pytest.raises(PluginError, match=r"second_force.py: criterion added_mass_kg: is built in"):
        load_plugin(third_party)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            '.max("speed")',
            "",
            r"is omitted: .*: has dims .*, must have \('option',\)",
        ),
        (
            "force_amplitude",
            "warmth",
            r"is omitted: .*, line \d+: KeyError: .*warmth",
        ),
        ('.max("speed")', '.max("speed") * float("nan")', "no finite value for the option none"),
    ],
)
def test_wrong_values_of_a_third_party_are_one_line(
    third_party: Path, judged: xr.Dataset, old: str, new: str, message: str
) -> None:
    third_party.write_text(THIRD_PARTY.replace(old, new))
    load_plugin(third_party)
    scale = {"weight": 1.0, "best": 0.0, "worst": 1.0}
    settings = Scoring.model_validate({"criteria": {"force_2x_n": scale}})
    with (
        pytest.warns(UserWarning, match=message),
        pytest.raises(ParameterError, match="none with a weight above 0 has values"),
    ):
        scoring.score(judged, settings)


# --- given ones -----------------------------------------------------------------------------------


def test_given_criteria_are_scored_like_computed_ones(judged: xr.Dataset) -> None:
    assert judged["criterion"].values.tolist() == ["foot_force_1x_n", "cost_eur", "room"]
    assert judged["criterion_label"].values.tolist()[1:] == ["Cost", "Free room"]
    assert judged["criterion_unit"].values.tolist() == ["N", "€", "marks"]
    assert judged["criterion_value"].sel(criterion="cost_eur").values.tolist() == [0.0, 4.5]
    force = np.clip(1.0 - judged["criterion_value"].sel(criterion="foot_force_1x_n"), 0.0, 1.0)
    by_hand = (force + 2.0 * np.array([1.0, 0.55]) + np.array([1.0, 0.75])) / 4.0
    np.testing.assert_allclose(judged["score"].sel(scoring_method="weighted_sum"), by_hand)


def test_given_values_are_in_the_report_with_their_sources(judged: xr.Dataset) -> None:
    page = report.render(judged)["report.html"].decode()
    assert re.search(r"Free room</\w+>\s*<td[^>]*>marks</td>", page)
    records = {record["field"]: record for record in _parameters(judged)["records"]}
    assert records["options.counterweight-half.given.cost_eur"]["unit"] == "€"
    room = records["options.none.given.room"]
    assert (room["unit"], room["lowest"], room["highest"]) == ("marks", 2.0, 3.0)


def test_given_criteria_are_weighed_again_from_the_results_alone(
    judged: xr.Dataset, study_file: StudyFile, tmp_path: Path
) -> None:
    file = storage.write_results(judged, tmp_path / "results.nc")
    again = scoring.score(storage.open_results(file))
    xr.testing.assert_equal(again["score"], judged["score"])
    other = study_file(GIVEN, COST.replace("10.0", "4.5"), "other.toml")
    outcome = command_here("score", file, "--scoring", other)
    assert outcome.returncode == 0, outcome.stderr
    none, half = judged["criterion_value"].sel(criterion="foot_force_1x_n").clip(0.0, 1.0).values
    assert f"{(1.0 - none + 2.0) / 3.0:.3f}" in outcome.stdout
    assert f"{(1.0 - half) / 3.0:.3f}" in outcome.stdout


def test_a_given_criterion_that_the_results_lack_is_refused(
    judged: xr.Dataset, study_file: StudyFile, tmp_path: Path
) -> None:
    file = storage.write_results(judged, tmp_path / "results.nc")
    renamed = GIVEN.replace("cost_eur", "costs_eur"), COST.replace("cost_eur", "costs_eur")
    outcome = command_here("score", file, "--scoring", study_file(*renamed))
    assert_refused(outcome, "criterion costs_eur: unknown, did you mean cost_eur?")


def test_given_criteria_need_not_be_scored_nor_complete() -> None:
    results = tiny_run(GIVEN.replace("room = 2.5\n", ""))
    assert results["criterion"].values.tolist() == ["foot_force_1x_n"]
    room = results["given_value"].sel(given_criterion="room").values
    np.testing.assert_array_equal(room, [3.0, np.nan])


@pytest.mark.parametrize(
    ("options", "criteria", "words"),
    [
        ("", "foot_force_1y_n = { weight = 1, best = 0, worst = 1 }\n",
         ["scoring.criteria.foot_force_1y_n: unknown, did you mean foot_force_1x_n?"]),
        (GIVEN, COST.replace("cost", "cots"), ["scoring.criteria.cots_eur", "mean cost_eur?"]),
        (GIVEN.replace("cost_eur = 0\n", ""), COST, ["options.none.given.cost_eur: is missing"]),
        (GIVEN.replace("cost_eur", "added_mass_kg"), "",
         ["options.none.given.added_mass_kg", "computed criterion"]),
        (GIVEN.replace("= 2.5", "= 'much'"), "", ["options.counterweight-half.given.room = much"]),
        (GIVEN.replace("= 2.5", "= nan"), "", ["given.room = nan: must be a number"]),
        (GIVEN.replace("value = 3,", "value = 4,"), ROOM, ["none.given.room = 4 marks: outside"]),
        (GIVEN.replace("room = 2.5", "'free room' = 2"), "", ["given.free room", "letters"]),
        ("[options.none]\nkind='none'\ngiven = 3\n", "", ["options.none.given: must be a table"]),
        (GIVEN, COST.replace("10.0", "0.0"), ["scoring.criteria.cost_eur: worst = 0: must differ"]),
        ("", "added_mass_kg = { weight = 1, best = 0, worst = 1, unit = 'g' }\n",
         ["scoring.criteria.added_mass_kg: label and unit are for given"]),
        ("[given.none]\ncost_eur = 1\n", "", ["given: unknown key"]),
    ],
)  # fmt: skip
def test_refusals_name_file_and_key(
    study_file: StudyFile, options: str, criteria: str, words: list[str]
) -> None:
    file = study_file(options, criteria)
    if "[options.none]\n" in options:
        text = file.read_text().replace('[options.none]\nkind = "none"\n', "", 1)
        file.write_text(text)
    with pytest.raises(ParameterError) as refusal:
        load_study(file)
    for word in ("mine.toml: ", *words):
        assert word in str(refusal.value)


def test_a_dump_gives_study_and_scoring_back(study_file: StudyFile) -> None:
    study = load_study(study_file(GIVEN, COST + ROOM))
    assert Study.model_validate(study.model_dump()) == study
    assert Scoring.model_validate_json(study.scoring.model_dump_json()) == study.scoring
    changed = load_study(study_file(GIVEN.replace("4.5", "4.6"), COST + ROOM))
    assert changed.model_dump_json() != study.model_dump_json()


def _parameters(results: xr.Dataset) -> dict:
    return json.loads(results.attrs["parameters"])
