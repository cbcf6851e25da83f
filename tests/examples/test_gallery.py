"""Every page of the gallery runs, without a warning, draws, and asks for public names only."""

import ast
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
import typer
from support import ROOT

import vibroacoustics
from vibroacoustics.commands import cli

GALLERY = ROOT / "docs" / "gallery"
HELPERS = {"rough_radiation.py"}
ELSEWHERE = {"doctor", "cache"}
"""They look after the machine's set-up: docs/start.md."""
PAGES = sorted(page for page in GALLERY.glob("*.py") if page.name not in HELPERS)


@pytest.fixture(scope="module")
def outcomes(request: pytest.FixtureRequest) -> dict[str, dict[str, object]]:
    """Of the pages that are tested in this session, run one after the other in one process."""
    tests = [item for item in request.session.items if "outcomes" in item.fixturenames]
    pages = [str(item.callspec.params["page"]) for item in tests]
    done = subprocess.run(
        [sys.executable, str(Path(__file__).with_name("run_pages.py")), *pages],
        capture_output=True,
        text=True,
        env={**os.environ, "MPLBACKEND": "Agg"},
        check=False,
        timeout=400,
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.mark.long  # `make docs` runs them too, and ends at an error, a warning or no figure
@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_page_runs_and_draws(page, outcomes):
    outcome = outcomes[page.name]
    assert not outcome["error"], outcome["error"]
    assert outcome["figures"] >= 1


def test_there_is_a_page_for_every_machine_and_job():
    assert len(PAGES) >= 17
    text = "".join(page.read_text() for page in GALLERY.glob("studies/*.toml"))
    text += "".join((ROOT / "pipelines" / f"{name}.toml").read_text() for name in extended(text))
    for machine in (ROOT / "data" / "machines").glob("*.toml"):
        assert machine.name in text, machine.name


@pytest.mark.parametrize("job", sorted(set(typer.main.get_command(cli.app).commands) - ELSEWHERE))
def test_there_is_a_page_for_every_command(job):
    """As words of the command line, or as arguments of a process."""
    text = "".join(page.read_text() for page in PAGES)
    assert f"vibroacoustics {job}" in text or f'"vibroacoustics", "{job}"' in text


def extended(text: str) -> list[str]:
    """Studies of `pipelines` that the gallery's studies extend."""
    return re.findall(r'^extends = ".*/pipelines/(.*)\.toml"$', text, re.MULTILINE)


@pytest.mark.parametrize(
    "page", [*PAGES, GALLERY / "rough_radiation.py"], ids=lambda page: page.stem
)
def test_pages_use_public_names_only(page):
    for node in ast.walk(ast.parse(page.read_text())):
        if isinstance(node, ast.ImportFrom):
            assert not (node.module or "").startswith("vibroacoustics"), node.module
        if isinstance(node, ast.Import):
            assert not any(name.name.startswith("vibroacoustics.") for name in node.names)
        if isinstance(node, ast.Attribute) and ast.unparse(node.value) == "va":
            assert node.attr in vibroacoustics.__all__, node.attr
