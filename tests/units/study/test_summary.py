"""What a Python prompt shows of a study."""

import pytest
from pydantic import BaseModel
from support import PIPELINES, TINY

import vibroacoustics as va

STUDY = va.load_study(PIPELINES / "copeland_sources.toml")


def test_a_study_is_shown_in_a_few_lines():
    lines = repr(STUDY).splitlines()
    assert len(lines) <= 20
    assert lines[0].startswith("study: Copeland ZP41K3E-PFJ")
    assert f"{len(STUDY.options)} options at {len(STUDY.receivers)} microphones" in lines[1]
    assert str(STUDY) == repr(STUDY)


def test_a_notebook_shows_a_table():
    shown = va.load_study(TINY).replace({"title": "a < b"})._repr_html_()
    assert shown.startswith("<table><tr><th>study</th><td>a &lt; b")
    assert shown.count("<tr>") == len(repr(va.load_study(TINY)).splitlines())


def test_dir_has_no_names_of_pydantic():
    names = set(dir(STUDY)) | set(dir(STUDY.machine))
    assert {"operation", "replace", "housing", "capability"} <= names
    assert not names & (set(dir(BaseModel)) - set(dir(object)))
    assert not [name for name in names if name.startswith(("model_", "__pydantic", "__class_v"))]


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"operation.speed_rpm": "x"}, "must be a list"),
        ({"operation.maximum_order": "16"}, "must be a whole number"),
        ({"options.none": 3}, "must be a table"),
        ({"receivers": [1]}, "must be a table"),
        ({"title": 3}, "must be a text"),
        ({"operation.speed_rpm": [1000.0, "a"]}, "must be a number"),
    ],
)
def test_refusals_name_no_type_of_python(values, words):
    with pytest.raises(va.ParameterError, match=words):
        STUDY.replace(values)
