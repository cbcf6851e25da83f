"""Section of the claims that a study depends on."""

import json

import pytest
from test_report import make_results
from test_report_sources import with_parameters

from vibroacoustics.report.blocks import Table
from vibroacoustics.report.sections import SECTIONS
from vibroacoustics.results.claims import claims


@pytest.fixture(scope="module")
def results():
    made = make_results({"none": 1.0, "idle": 1.0})
    machine = json.loads(made.attrs["parameters"])["machine"]
    return with_parameters(made, machine={**machine, "kind": "reciprocating"})


def test_claims_are_those_of_the_machine_and_of_every_study(results):
    rows = SECTIONS["claims"].tables(results)["claims.csv"]
    topics = {row.what: set(row.topics) for row in claims()}
    listed = [topics[what] for what in rows["what"]]
    assert {"reciprocating"} in listed
    assert {"receivers"} in listed
    assert not any(each & {"minicrank-scroll", "room"} for each in listed)


def test_page_counts_them_and_shows_the_closest(results):
    rows = SECTIONS["claims"].tables(results)["claims.csv"]
    count, closest = SECTIONS["claims"].blocks(results)
    assert f"{len(rows['what'])} of {len(claims())} tested claims" in count.words
    assert (
        f"{rows['verdict'].count('missed')} of them disagree with the printed value" in count.words
    )
    assert isinstance(closest, Table)
    shares = [float(row[-1]) for row in closest.rows]
    met = [s for s, v in zip(rows["share"], rows["verdict"], strict=True) if v == "met"]
    assert shares == sorted(met, reverse=True)[:4]
