"""Values of the example in the report: their number, and by the samples the ones that matter."""

import json
from typing import Any

import pytest
import xarray as xr
from test_report_unknowns import NAMES, with_unknowns

from vibroacoustics import report
from vibroacoustics.report import render
from vibroacoustics.report.blocks import Text
from vibroacoustics.report.sections import SECTIONS
from vibroacoustics.report.sections.example import example_words
from vibroacoustics.report.sections.verdict.content import _blocks as first_screen
from vibroacoustics.report.tables import Table


def with_records(results: xr.Dataset, examples: dict[str, bool]) -> xr.Dataset:
    """Results whose study reads these values, of which some are the example's."""
    study = json.loads(results.attrs["parameters"])
    study["records"] = [
        {"file": "machine.toml", "field": field, "value": "1", "unit": "", "source": "book",
         "lowest": 0.5, "highest": 2.0, "example": example}
        for field, example in examples.items()
    ]  # fmt: skip
    return results.assign_attrs(parameters=json.dumps(study))


FIELDS = {"variation.mobility_change_db": False, "gas.polytropic_index": True,
          "mounts.pitch_mm": True, "oldham.mass_kg": True}  # fmt: skip
SENTENCE = "3 of 4 values that this study reads are the example's."


def words(blocks: Any) -> list[str]:
    return [block.words for block in blocks if isinstance(block, Text)]


@pytest.fixture(scope="module")
def results() -> xr.Dataset:
    return with_records(with_unknowns(), FIELDS)


def test_the_section_ranks_by_the_samples(results: xr.Dataset) -> None:
    """The first in the samples is the user's own; the last has no resolved share."""
    assert NAMES[0] == "variation.mobility_change_db"
    assert SECTIONS["example"].applies(results)
    blocks = SECTIONS["example"].blocks(results)
    assert words(blocks)[0].startswith(SENTENCE)
    (table,) = (block for block in blocks if isinstance(block, Table))
    assert [row[0] for row in table.rows] == ["gas polytropic index"]


def test_first_screen_and_terminal_count(results: xr.Dataset) -> None:
    assert SENTENCE in words(first_screen(results))
    assert SENTENCE in report.analysis_of_study(results).text()


def test_inputs_say_which(results: xr.Dataset) -> None:
    rows = render(results)["inputs.csv"].decode().splitlines()
    column = rows[0].split(",").index("origin")
    assert [row.split(",")[column] for row in rows[1:]] == ["", *["example"] * 3]


def test_a_study_without_a_template_says_nothing(results: xr.Dataset) -> None:
    own = with_records(results, dict.fromkeys(FIELDS, False))
    assert not SECTIONS["example"].applies(own)
    assert example_words(own) == ""
    assert not any("example's" in text for text in words(first_screen(own)))
