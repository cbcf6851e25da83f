"""A search of designs that is killed goes on to the same bits, here and with workers."""

import signal
import subprocess
import sys
import time
from pathlib import Path
from random import Random

import pytest
from design_studies import LEFT, WEIGHT
from support import ROOT, TINY

pytestmark = pytest.mark.long
DESIGN = """
[design]
option = "weight"
draws = 8
[design.search]
population = 16
generations = 24
fresh_draws = 100
[design.objectives.quiet]
figure = "order_level_db"
order = 1
[design.objectives.mass]
figure = "added_mass_kg"
[design.variables]
"options.weight.mass_g" = { range = [1.0, 200.0] }
"options.weight.angle_deg" = { range = [-180.0, 180.0] }
[design.tolerances]
"options.weight.mass_g" = { ratio = 0.03 }
"""


@pytest.fixture(scope="module")
def study(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A study with a design space."""
    file = tmp_path_factory.mktemp("study") / "designs.toml"
    written = TINY.read_text().replace("../../data", str(ROOT / "data"))
    file.write_text(written + LEFT + WEIGHT + DESIGN)
    return file


@pytest.fixture(scope="module")
def undisturbed(study: Path, tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """All designs of a search that nothing ended."""
    return designs_of(study, tmp_path_factory.mktemp("undisturbed"))


def command(study: Path, out: Path, *options: str) -> list[str]:
    return [sys.executable, "-m", "vibroacoustics", "optimise", str(study), "--out", str(out),
            *options]  # fmt: skip


def designs_of(study: Path, out: Path, *options: str) -> bytes:
    """All designs of a search, as CSV."""
    subprocess.run(command(study, out, *options), check=True, capture_output=True)
    return (out / "designs.csv").read_bytes()


def killed_and_gone_on(study: Path, out: Path, seed: int) -> bytes:
    """SIGKILL at a random moment after the first chunk, then the same command again."""
    process = subprocess.Popen(command(study, out), stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)  # fmt: skip
    while not list(out.glob("search_chunks/chunk_*")) and process.poll() is None:
        time.sleep(0.01)
    time.sleep(Random(seed).uniform(0.0, 1.0))
    process.send_signal(signal.SIGKILL)
    process.wait()
    return designs_of(study, out)


@pytest.mark.parametrize("seed", range(30))
def test_search_killed_at_random(
    study: Path, undisturbed: bytes, tmp_path: Path, seed: int
) -> None:
    assert killed_and_gone_on(study, tmp_path, seed) == undisturbed


def test_two_workers_equal_serial(study: Path, undisturbed: bytes, tmp_path: Path) -> None:
    assert designs_of(study, tmp_path, "--workers", "2") == undisturbed


def test_folder_of_another_study_is_refused(study: Path, tmp_path: Path) -> None:
    (tmp_path / "search_chunks").mkdir()
    (tmp_path / "search_chunks" / "plan.json").write_text("{}")
    done = subprocess.run(command(study, tmp_path), capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert "holds designs of another study" in done.stderr
    assert "Traceback" not in done.stderr
