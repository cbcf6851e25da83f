"""Rows of evidence.json: each has its test and its source, and the page shows all of them."""

import os
import random
import re
import subprocess
import sys
from typing import get_args

import pytest
from documents import FORM
from evidence import SETTINGS, Kind, claim, compared
from evidence_files import FILE, has_test, written
from evidence_plugin import IDS
from support import PIPELINES, ROOT

from vibroacoustics.results.claims import (
    MET,
    MISSED,
    claims,
    claims_of_study,
    closest,
    documents,
    topics_of,
)
from vibroacoustics.study.loading import load_study

CHANGED = 50
BY_HAND = {"unit": "N", "source": FORM("by hand"), "kind": "exact", "topics": ("receivers",)}


def test_every_row_has_its_test(request):
    """In its file; by its identifier, too, where the session has collected the file."""
    assert [row.what for row in claims() if not has_test(row)] == []
    if any("::" in argument for argument in request.config.args):
        return
    files = {name.partition("::")[0] for name in IDS}
    collected = [row for row in claims() if row.test.partition("::")[0] in files]
    assert [row.test for row in collected if row.test not in IDS] == []


def test_every_row_says_what_it_is_held_against():
    assert len(claims()) >= 200
    assert len({row.what for row in claims()}) == len(claims())
    for row in claims():
        document = documents()[row.document]
        assert all((row.passage, row.unit, document.author, document.title, document.year)), row
        assert row.kind in get_args(Kind), row
        assert row.verdict == (MISSED if row.reason else MET), row
        assert (row.share > 1.0) == bool(row.reason), row


def test_file_is_made_from_the_rows():
    assert written(claims()) == FILE.read_text(encoding="utf-8")


def test_topics_are_names_that_a_study_knows():
    studies = [load_study(file).parameters() for file in sorted(PIPELINES.glob("*.toml"))]
    known = frozenset().union(*map(topics_of, studies), *studies)
    assert {topic for row in claims() for topic in row.topics} <= known
    selected = [len(claims_of_study(study)) for study in studies]
    assert 50 < min(selected) < max(selected) < len(claims())


def test_closest_are_those_met_with_the_largest_shares():
    met = sorted((row.share for row in claims() if row.verdict == MET), reverse=True)
    assert [row.share for row in closest(claims(), 10)] == met[:10]


@pytest.mark.parametrize(
    ("computed", "missed", "words"),
    [
        (1.3, "", "not so that the claim is met"),
        (float("nan"), "", "not so that the claim is met"),
        (1.05, "A misprint", "not so that the claim is missed"),
        (1.05, "", "no such row in evidence.json"),
    ],
)
def test_a_claim_fails_in_one_line(computed, missed, words, monkeypatch):
    monkeypatch.setattr(SETTINGS, "writes", False)
    with pytest.raises(AssertionError, match=words):
        claim("By hand", computed=computed, reference=1.0, tolerance=0.2, missed=missed, **BY_HAND)


def test_share_is_the_distance_in_tolerances():
    assert compared([1.0, 2.3], [1.0, 2.0], [0.1, 0.5]) == pytest.approx((2.3, 2.0, 0.5, 0.6))
    assert compared(3j, 3.0, 10.0).share == pytest.approx(0.3 * 2.0**0.5)
    assert compared(1.2, 1.0, 0.5, shifted=True).share == pytest.approx(0.4 + 1.01)


@pytest.mark.long
def test_tests_fail_where_a_row_is_changed_by_its_tolerance(tmp_path):
    """Fifty random rows of different tests; long tests are passed over."""
    rows = list(claims())
    random.Random(43).shuffle(rows)
    rows = list({row.test: row for row in rows}.values())[: CHANGED + 20]
    names = tmp_path / "shifted.txt"
    names.write_text("\n".join(row.what for row in rows), encoding="utf-8")
    options = ["-n", "0", "-q", "--tb=no", "-rfE", "-p", "no:cacheprovider"]
    shifted_tests = [f"--shifted-claims={names}", *(row.test for row in rows)]
    done = subprocess.run(
        [sys.executable, "-m", "pytest", *options, f"--maxfail={CHANGED}", *shifted_tests],
        cwd=ROOT, env={**os.environ, "COLUMNS": "1000"}, capture_output=True, text=True,
        check=False,
    )  # fmt: skip
    failed = re.findall(r"^FAILED (.*?) - AssertionError: (.*)$", done.stdout, re.MULTILINE)
    summary = done.stdout.splitlines()[-1]
    print(summary)
    assert f"{CHANGED} failed" in summary, done.stdout
    assert "passed" not in summary, done.stdout
    shifted = {row.test: row.what for row in rows}
    assert all(message.startswith(shifted[test]) for test, message in failed), done.stdout
    assert len(failed) == CHANGED
