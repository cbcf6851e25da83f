"""`new`: files to begin with, also from an installed package in an empty folder."""

import os
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from support import ROOT, assert_refused, command_here, made_up_radiation

from vibroacoustics import pipeline
from vibroacoustics.commands.starter import STUDIES, starting_files
from vibroacoustics.machine.machine import MACHINES
from vibroacoustics.study.loading import load_study
from vibroacoustics.study.study import Study

SHIPPED = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["hatch"]["build"]["targets"][
    "wheel"
]["force-include"]
STEPS = """
import sys
from vibroacoustics.commands import cli
for words in (["new", kind], ["check", f"{kind}/study.toml"], ["run", f"{kind}/study.toml"]):
    sys.argv = ["vibroacoustics", *words]
    try:
        cli.main()
    except SystemExit as ended:
        if ended.code:
            raise
import vibroacoustics
print(vibroacoustics.__file__)
"""


@pytest.fixture
def installed(tmp_path: Path) -> Path:
    """A folder with the package as a wheel holds it; compiled kernels are shared."""
    package = tmp_path / "installed" / "vibroacoustics"
    package.mkdir(parents=True)
    for path in (ROOT / "vibroacoustics").iterdir():
        (package / path.name).symlink_to(path)
    for source, target in SHIPPED.items():
        linked = tmp_path / "installed" / target
        linked.parent.mkdir(parents=True, exist_ok=True)
        linked.symlink_to(ROOT / source)
    return package.parent


def new_check_run(kind: str, installed: Path, empty: Path) -> None:
    empty.mkdir()
    outcome = subprocess.run(
        [sys.executable, "-c", f"kind = {kind!r}{STEPS}"],
        cwd=empty,
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": str(installed)},
        check=False,
        timeout=1800,
    )
    assert outcome.returncode == 0, outcome.stderr
    assert outcome.stdout.splitlines()[-1].startswith(str(installed))
    assert f"{kind}/study.toml: nothing is wrong" in outcome.stdout
    assert (empty / "reports" / "study" / "report.html").is_file()


@pytest.mark.long
def test_from_an_installed_package_in_an_empty_folder(installed: Path, tmp_path: Path) -> None:
    new_check_run("table", installed, tmp_path / "empty")


@pytest.mark.long
@pytest.mark.parametrize("kind", STUDIES)
def test_every_kind_from_a_wheel(kind: str, tmp_path: Path) -> None:
    pytest.importorskip("hatchling")
    words = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(tmp_path)]
    subprocess.run(words, cwd=ROOT, check=True, capture_output=True)
    (wheel,) = tmp_path.glob("*.whl")
    with zipfile.ZipFile(wheel) as content:
        content.extractall(tmp_path / "installed")
    new_check_run(kind, tmp_path / "installed", tmp_path / "empty")


def test_every_kind_has_a_study() -> None:
    built_in = {kind for kind in MACHINES if MACHINES[kind].__module__.startswith("vibroacoustics")}
    assert set(STUDIES) == built_in


@pytest.mark.parametrize("kind", STUDIES)
def test_study_says_what_the_shipped_one_says(kind: str, tmp_path: Path) -> None:
    for name, content in starting_files(kind).items():
        (tmp_path / name).write_bytes(content)
    shipped, new = (
        load_study(ROOT / "pipelines" / STUDIES[kind]),
        load_study(tmp_path / "study.toml"),
    )
    assert new.machine.kind == kind
    assert new.machine.shell == shipped.machine.shell
    assert list(new.options) == list(shipped.options)
    assert _values(new) == _values(shipped) or kind == "table"  # names of files differ
    is_assumed = kind != "oldham-scroll"  # whose catalogue gives a level
    assert (new.machine.overall_noise is None) == is_assumed
    assert new.catalogue_receiver == shipped.catalogue_receiver
    assert new.ranges == shipped.ranges
    assert not new.evidence.forces
    assert "../" not in (tmp_path / "study.toml").read_text()


def test_the_scores_tell_the_options_apart(tmp_path: Path) -> None:
    """Of the scales' whole span, 1, the best and the worst option are a fifth apart at least."""
    for name, content in starting_files("table").items():
        (tmp_path / name).write_bytes(content)
    results = pipeline.run(load_study(tmp_path / "study.toml"), radiation=made_up_radiation)
    scores = results["score"].isel(scoring_method=0).values
    assert np.ptp(scores) > 0.2
    assert len(set(scores.round(2))) == len(scores)


def _values(study: Study) -> list[dict[str, Any]]:
    """Options and machine, but for the level and what it leaves."""
    level = {"overall_noise", "remainder"}
    options = [option.model_dump(exclude={"machine": level}) for option in study.options.values()]
    return [*options, study.machine.model_dump(exclude=level)]


def test_nothing_is_overwritten(tmp_path: Path) -> None:
    (tmp_path / "machine.toml").write_text("mine")
    assert_refused(command_here("new", "table", "--out", tmp_path), "machine.toml", "already")
    assert [path.name for path in tmp_path.iterdir()] == ["machine.toml"]
    assert (tmp_path / "machine.toml").read_text() == "mine"


def test_unknown_kind(tmp_path: Path) -> None:
    outcome = command_here("new", "oldham-scrol", "--out", tmp_path / "out")
    assert_refused(outcome, "oldham-scrol", "oldham-scroll")
    assert not (tmp_path / "out").exists()


def test_schemas_lie_beside(tmp_path: Path) -> None:
    outcome = command_here("new", "minicrank-scroll", "--out", tmp_path / "out")
    assert outcome.returncode == 0, outcome.stderr
    for kind in ("study", "machine"):
        first = (tmp_path / "out" / f"{kind}.toml").read_text().splitlines()[0]
        assert first == f"#:schema schemas/{kind}.json"
        shipped = ROOT / "data" / "schemas" / f"{kind}.json"
        assert (tmp_path / "out" / "schemas" / shipped.name).read_bytes() == shipped.read_bytes()
