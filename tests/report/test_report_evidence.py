"""The table of evidence: errors and uncertainties by hand."""

import json

import numpy as np
import pytest
import xarray as xr
from test_report import make_results
from test_report_sources import PUBLISHED_DBA, energy, with_parameters, with_sources

from vibroacoustics.base.vocabulary import stamp
from vibroacoustics.report import render
from vibroacoustics.report.sections.evidence import agreement_sentence, evidence_table
from vibroacoustics.results.validation import (
    AGREES,
    DIFFERS,
    UNDECIDED,
    Validation,
    validations,
)
from vibroacoustics.uncertainty.validation import validation_variables

SOURCE = "Thesis, page 1"
FORCE = {"part": "oldham", "proportional_to": "ring.mass_kg ring.stroke_mm", "source": SOURCE}


def record(field: str, value: str, lowest: float | None, highest: float | None) -> dict:
    limits = {"lowest": lowest, "highest": highest}
    return {"field": field, "value": value, **limits, "source": "S", "file": "m", "unit": ""}


def with_evidence(results: xr.Dataset, forces: list[dict]) -> xr.Dataset:
    machine = json.loads(results.attrs["parameters"])["machine"]
    records = [
        record("overall_noise.level_dba", "56", None, None),
        record("ring.mass_kg", "2", 1.0, 3.0),
        record("ring.stroke_mm", "4", None, None),
    ]
    return with_parameters(
        results,
        machine={**machine, "remainder": {"speed_growth_db": 30.0}},
        records=records,
        evidence={"forces": forces},
    )


@pytest.fixture(scope="module")
def results() -> xr.Dataset:
    """A ring's force of 45 N, three samples of the bank at 50, 53 and 59 dB(A)."""
    results = with_sources({"none": 40.0, "idle": 40.0})
    phasor = np.zeros((2, 2, 1, 3, 5), dtype=complex)
    phasor[..., 0, 1], phasor[..., 1, 1] = 45.0, 27.0j  # an ellipse, 45 N its longer half
    coords = {dim: results[dim].values for dim in ("speed", "option", "source", "axis", "order")}
    level = results["prior_sample_level"].copy(data=np.resize([50.0, 53.0, 59.0, np.nan], 11))
    forces = [
        {**FORCE, "speed_rpm": 2900.0, "force_1x_n": 60.0, "deviation_n": 5.0},
        {**FORCE, "speed_rpm": 3500.0, "force_1x_n": 110.0, "deviation_n": 5.0},
        {**FORCE, "speed_rpm": 1000.0, "force_1x_n": 1.0, "deviation_n": 5.0},
    ]
    results = results.assign(
        force_order=stamp("force_order", phasor, coords), prior_sample_level=level
    )
    results = with_evidence(results, forces)
    return results.merge(validation_variables(results))


def test_the_level_is_that_of_the_sources_with_the_spread_before_any_data(
    results: xr.Dataset,
) -> None:
    level = validations(results)[0]
    assert level.simulation == pytest.approx(energy(7.0, 50.0, 40.0))
    assert level.data == PUBLISHED_DBA
    sampled = results["prior_sample_level"].values
    assert level.inputs == pytest.approx(np.std(sampled[np.isfinite(sampled)]))
    assert level.published == 2.0
    assert level.numerical == pytest.approx(20.0 * np.log10(1.01))  # of vectors off by 1 %
    assert level.error == pytest.approx(level.simulation - PUBLISHED_DBA)


def test_no_row_tests_a_range_against_the_data_that_made_it(results: xr.Dataset) -> None:
    """The range of the growth with speed comes from other makers' levels at two speeds."""
    assert [each.quantity.split()[0] for each in validations(results)] == [
        "Level",
        "Force",
        "Force",
    ]


@pytest.mark.parametrize(
    ("error", "uncertainty", "verdict"),
    [
        (1.7, 2.0, AGREES),  # 1.7 + 1.64 · 2.0 = 4.98
        (-1.7, 2.0, AGREES),
        (1.8, 2.0, UNDECIDED),
        (5.5, 5.9, UNDECIDED),
        (3.9, 2.0, UNDECIDED),
        (-4.1, 2.0, DIFFERS),
        (0.0, 3.1, UNDECIDED),
        (4.0, 0.5, AGREES),  # 8 deviations off, but within the tolerance
    ],
)
def test_levels_agree_within_five_decibels_differ_or_are_undecided(
    error: float, uncertainty: float, verdict: str
) -> None:
    each = Validation("Level", "dB(A)", 56.0 + error, 56.0, 0.0, uncertainty, 0.0, "maker")
    assert each.verdict == verdict


def test_a_force_follows_the_ranges_that_it_is_proportional_to(results: xr.Dataset) -> None:
    near, far = validations(results)[1:]  # that at 1000 rpm has no result
    assert near.simulation == pytest.approx(45.0)
    assert near.inputs == pytest.approx(45.0 * (2.0 / np.sqrt(12.0)) / 2.0)
    assert near.uncertainty == pytest.approx(np.hypot(near.inputs, 5.0))
    assert near.tolerance == pytest.approx(6.0)
    assert near.verdict == UNDECIDED  # |-15| within twice 13.9
    assert far.verdict == DIFFERS  # |-65| beyond
    rows = evidence_table(results).rows
    assert [row[9] for row in rows[1:]] == [UNDECIDED, DIFFERS]
    assert rows[2][4] == "−65.0"


def test_the_page_shows_the_table_of_evidence(results: xr.Dataset) -> None:
    page = render(results)["report.html"].decode()
    assert "Results beside published values" in page
    assert SOURCE in page


def test_without_any_more_the_catalogue_level_stands_alone() -> None:
    results = make_results({"none": 1.0, "halved": 0.5})
    assert validations(results) == []
    (level,) = validations(results.merge(validation_variables(results)))
    assert "moving parts" in level.quantity
    assert level.inputs == 0.0
    assert level.verdict == DIFFERS  # the rigid machine's orders are no machine's level


def test_the_sentence_says_how_far_the_level_is_from_the_published_one(results: xr.Dataset) -> None:
    text = agreement_sentence(results)
    assert "is too uncertain to be compared with the published 56.0 dB(A)" in text
    level = validations(results)[0]
    assert f"u = {level.uncertainty:.1f} dB" in text
