"""The tutorials' files and tables, as they stand on the pages, make what the pages say."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from support import ROOT


@pytest.fixture(scope="module")
def followed() -> dict[str, object]:
    script = Path(__file__).with_name("run_tutorials.py")
    done = subprocess.run(
        [sys.executable, str(script)], capture_output=True, text=True, check=False, timeout=200
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_every_tutorial_has_complete_code(followed):
    assert set(followed["files"]) == {
        "add_a_balancer", "add_a_criterion", "add_a_machine", "add_a_reader", "add_a_section",
        "add_a_source", "add_a_stage",
    }  # fmt: skip
    for page, files in followed["files"].items():
        assert files, page
        for file in files:
            assert (ROOT / "docs" / file).is_file(), file


def test_balancer_source_and_criterion_are_in_the_results(followed):
    assert "counter-shaft" in followed["options"]
    assert {"table", "bench"} <= set(followed["sources"])
    assert "force_2x_n" in followed["criteria"]


def test_section_and_column_are_in_the_report(followed):
    assert "What the floor gets" in followed["report"]
    assert "Force 3×, N" in followed["report"]


def test_stage_is_in_the_report(followed):
    assert "Vibration severity" in followed["report"]


def test_machine_makes_its_force(followed):
    expected = 0.005 * 0.02 * (2.0 * np.pi * 2900.0 / 60.0) ** 2
    assert followed["rotor_force_n"] == pytest.approx(expected, rel=1e-9)
