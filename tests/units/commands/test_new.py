"""`new`: files to begin with, also from an installed package in an empty folder."""

import html
import os
import re
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

import numpy as np
import pytest
from support import ROOT, assert_refused, command_here, made_up_radiation

from vibroacoustics import pipeline
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.commands.starter import STUDIES, WITH_SOURCES, starting_files, study_for
from vibroacoustics.machine.machine import MACHINES
from vibroacoustics.report import render
from vibroacoustics.study.loading import load_study

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


@pytest.mark.parametrize(
    ("kind", "with_sources"),
    [*((kind, False) for kind in STUDIES), *((kind, True) for kind in WITH_SOURCES)],
)
@pytest.mark.filterwarnings("ignore:.*contradict themselves")
def test_study_has_the_machine_and_nothing_of_its_publication(
    kind: str, with_sources: bool, tmp_path: Path
) -> None:
    for name, content in starting_files(kind, with_sources).items():
        (tmp_path / name).write_bytes(content)
    shipped = load_study(ROOT / "pipelines" / study_for(kind, with_sources))
    new = load_study(tmp_path / "study.toml")
    assert new.machine.kind == kind
    assert new.machine.shell == shipped.machine.shell
    assert new.machine.housing == shipped.machine.housing
    assert set(new.options) <= set(shipped.options)
    assert len(new.options) >= 2
    assert set(new.sources) == set(shipped.sources)
    assert new.machine.overall_noise is None
    assert not new.machine.errata
    assert not new.evidence.forces
    for file in (tmp_path / "study.toml", tmp_path / "machine.toml"):
        text = file.read_text()
        assert "../" not in text
        assert shipped.machine.name not in text
        assert shipped.title not in text


def test_level_of_the_machine(tmp_path: Path) -> None:
    for name, content in starting_files("oldham-scroll", True, 61.5).items():
        (tmp_path / name).write_bytes(content)
    noise = load_study(tmp_path / "study.toml").machine.overall_noise
    assert noise is not None
    assert (noise.level_dba, noise.distance_m) == (61.5, 1.0)
    with pytest.raises(ParameterError, match=r"--level = 200 dB\(A\): must be above 0 to 140"):
        starting_files("oldham-scroll", True, 200.0)


@pytest.mark.parametrize(
    ("kind", "with_sources"),
    [*((kind, False) for kind in STUDIES), *((kind, True) for kind in WITH_SOURCES)],
)
@pytest.mark.filterwarnings("ignore:.*contradict themselves")
def test_every_kind_takes_a_level(kind: str, with_sources: bool, tmp_path: Path) -> None:
    """At the first microphone, 1 m from the shell; a run may be planned."""
    for name, content in starting_files(kind, with_sources, 52.0).items():
        (tmp_path / name).write_bytes(content)
    study = load_study(tmp_path / "study.toml")
    assert study.machine.overall_noise is not None
    microphone = study.receivers[study.catalogue_receiver]
    distance_m = study.machine.shell.distance_m(microphone.x_m, microphone.y_m, microphone.height_m)
    assert distance_m == pytest.approx(1.0, rel=0.05)


def test_kind_without_sources_is_refused(tmp_path: Path) -> None:
    outcome = command_here("new", "table", "--with", "sources", "--out", tmp_path / "out")
    assert_refused(outcome, "--with sources", "table", "oldham-scroll")
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("kind", ["oldham-scroll", "table"])
def test_report_of_an_own_machine_says_nothing_of_another(kind: str, tmp_path: Path) -> None:
    """Own values and sources: no source, name or erratum of a shipped file is in the report."""
    own = re.compile(r'source = "[^"]*"')
    for name, content in starting_files(kind).items():
        text = content.decode()
        if name in ("study.toml", "machine.toml"):
            text = own.sub('source = "own measurement"', text)
            text = re.sub(r"(?m)^#(?!:schema).*\n", "", text)
        (tmp_path / name).write_text(text)
    results = pipeline.run(load_study(tmp_path / "study.toml"), radiation=made_up_radiation)
    files = render(results)
    shown = "\n".join(
        content.decode()
        for name, content in files.items()
        if name.endswith((".html", ".csv", ".md"))
    )
    shipped = ROOT / "pipelines" / STUDIES[kind]
    study = load_study(shipped)
    foreign = {record.source for record in study.records if len(record.source) > 12}
    foreign |= {
        study.machine.name,
        study.title,
        *(erratum.finding for erratum in study.machine.errata),
    }
    assert len(foreign) > 20
    shown = html.unescape(shown)
    assert [words for words in sorted(foreign) if words in shown] == []


def test_the_scores_tell_the_options_apart(tmp_path: Path) -> None:
    """Of the scales' whole span, 1, the best and the worst option are a fifth apart at least."""
    for name, content in starting_files("table").items():
        (tmp_path / name).write_bytes(content)
    results = pipeline.run(load_study(tmp_path / "study.toml"), radiation=made_up_radiation)
    scores = results["score"].isel(scoring_method=0).values
    assert np.ptp(scores) > 0.2
    assert len(set(scores.round(2))) == len(scores)


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
