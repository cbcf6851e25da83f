"""Only `estimate()`, the uncertainty room and the stages know how samples are kept."""

import re
from pathlib import Path

import pytest
from support import ROOT

PACKAGE = ROOT / "vibroacoustics"
NAMES = re.compile(
    r"[\"'](?:\w+_by_sample|sample|sample_weight|sampled_value|prior_sample\w*|shell_sample)[\"']"
)
"""Dimensions, weights and values of samples as variables of a dataset."""
ALLOWED = (
    "uncertainty/", "stages/", "base/", "results/estimates.py",
    "results/run_variables.py", "recordings/",
)  # fmt: skip
CONTRACT = {
    "study/criterion.py": {'"sample"'},
    "results/criterion_values.py": {'"sample"'},
    "design/engine/engine.py": {'"sample"'},
    "design/search_dataset.py": {'"sample"'},
}
"""The dimension of what third-party criteria give, a key of the cache, and a word."""


def found(path: Path) -> set[str]:
    name = path.relative_to(PACKAGE).as_posix()
    return set(NAMES.findall(path.read_text("utf-8"))) - CONTRACT.get(name, set())


def test_samples_are_read_through_estimates():
    guilty = {
        path.relative_to(PACKAGE).as_posix(): found(path)
        for path in PACKAGE.rglob("*.py")
        if not path.relative_to(PACKAGE).as_posix().startswith(ALLOWED)
    }
    assert {name: names for name, names in guilty.items() if names} == {}


@pytest.mark.parametrize(
    "line",
    ['results["level_total_by_sample"]', 'results["sample_weight"]', 'isel(sample=0)["sample"]'],
)
def test_the_names_are_recognised(line):
    assert NAMES.search(line)
