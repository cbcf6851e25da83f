"""Check that Python and commands of docs/orders.md and docs/compare.md print what these show."""

import re
import shlex
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from support import PIPELINES
from typer.testing import CliRunner

import vibroacoustics
from vibroacoustics.base.vocabulary import RIGID_BODY_DOFS, stamp
from vibroacoustics.commands import cli
from vibroacoustics.results import storage

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "docs" / name for name in ("orders.md", "compare.md")]
TEXT = "".join(page.read_text("utf-8") for page in PAGES)
FENCED = re.compile(r"^```(python|console)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
NUMBER = re.compile(r"[-+]?\d+(?:\.(\d+))?")


@pytest.fixture
def workplace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the package's data and results of the thesis's study, where no sound is right.

    The radiation takes minutes and the page shows forces only.
    """
    monkeypatch.chdir(tmp_path)
    Path("data").symlink_to(ROOT / "data")
    results = vibroacoustics.run(
        vibroacoustics.load_study(PIPELINES / "copeland_thesis.toml"), radiation=_unit_vectors
    )
    storage.write_results(results, "reports/copeland_thesis/results.nc")
    return tmp_path


def _unit_vectors(study, *_) -> tuple[xr.Dataset, bool]:
    frequency = np.array([25.0, study.radiation.maximum_frequency_hz])
    coords = {
        "receiver": list(study.receivers),
        "dof": list(RIGID_BODY_DOFS),
        "frequency": frequency,
        "distance": ("receiver", np.ones(len(study.receivers))),
    }
    values = np.ones((len(study.receivers), len(RIGID_BODY_DOFS), frequency.size), dtype=complex)
    names = ("transfer_vector", "transfer_vector_closed_form")
    vectors = {name: stamp(name, values, coords) for name in names}
    return xr.Dataset(vectors, attrs={"method": "made up"}), False


@pytest.mark.long
def test_page_shows_what_comes_out(workplace):
    namespace: dict[str, object] = {}
    shown = []
    for kind, block in FENCED.findall(TEXT):
        if kind == "python":
            exec(compile(block, "docs", "exec"), namespace)  # noqa: S102 - our own page
        else:
            shown.append(block)
            check_session(block)
    assert len(shown) >= 3
    assert (workplace / "reports/motor/map_1_Acceleration.svg").is_file()


def check_session(block: str) -> None:
    """Run the commands of a block; between them stands what they print."""
    for command in re.split(r"^\$ vibroacoustics ", block, flags=re.MULTILINE)[1:]:
        line, _, expected = command.replace("\\\n", " ").partition("\n")
        outcome = CliRunner().invoke(cli.app, shlex.split(line))
        assert outcome.exit_code == ("broken: " in expected), outcome.output
        check_alike(expected, outcome.stdout)


def check_alike(expected: str, found: str) -> None:
    """The same words, and numbers within one of the last digit printed."""
    words, others = (NUMBER.sub("#", text).split() for text in (expected, found))
    assert words == others, found
    for wanted, number in zip(NUMBER.finditer(expected), NUMBER.finditer(found), strict=True):
        digit = 10.0 ** -len(wanted[1] or "")
        assert float(number[0]) == pytest.approx(float(wanted[0]), abs=1.01 * digit), found


def test_links_of_the_page_lead_somewhere():
    for target in re.findall(r"\]\(([^)#]+)\)", TEXT):
        assert (ROOT / "docs" / target).exists(), target


def test_tests_that_the_page_names_are_there():
    sources = {path.stem: path.read_text() for path in (ROOT / "tests").rglob("test_*.py")}
    named = re.findall(r"`(test_\w+)::(test_\w+)`", TEXT)
    assert len(named) >= 10
    for module, function in named:
        assert f"def {function}(" in sources[module], (module, function)
