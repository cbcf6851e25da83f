"""Chunks of designs on disk: whole, of one plan, and gone on with to the same bits."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from random import Random

import numpy as np
import pytest

from vibroacoustics.base.arrays import Array
from vibroacoustics.base.errors import StorageError
from vibroacoustics.design.evaluation import Evaluation
from vibroacoustics.design.search.best import search_best
from vibroacoustics.design.search.problem import Searched, SearchProblem
from vibroacoustics.design.store.chunks import Stored, opened_store

PLAN: dict[str, object] = {"study": "a"}


def bowl(designs: Array) -> Evaluation:
    """A bowl that fails at its left."""
    failed = designs[:, 0] < -0.9
    objective = np.where(failed, np.nan, (designs**2).sum(axis=1))[:, None]
    reasons = tuple("too far left" if one else "" for one in failed)
    return Evaluation(objective, np.empty((len(designs), 0)), reasons)


def searched_in(folder: Path, pause_s: float = 0.0) -> Searched:
    """A search whose generations are kept in a folder."""

    def evaluate(designs: Array) -> Evaluation:
        time.sleep(pause_s)
        return bowl(designs)

    with opened_store(folder, PLAN) as store:
        problem = SearchProblem(
            np.array([-1.0, -1.0]), np.array([1.0, 1.0]), np.zeros(2, bool), Stored(evaluate, store)
        )
        return search_best(problem, 12, 25, seed=4)


def same(first: Searched, second: Searched) -> None:
    """Every bit and every reason."""
    assert first.designs.tobytes() == second.designs.tobytes()
    assert first.evaluation.objectives.tobytes() == second.evaluation.objectives.tobytes()
    assert first.evaluation.failures == second.evaluation.failures


def test_chunk_comes_back_with_its_failures(tmp_path: Path) -> None:
    designs = np.random.default_rng(0).uniform(-1.0, 1.0, (50, 2))
    with opened_store(tmp_path / "designs", PLAN) as store:
        assert store.get(0, designs) is None
        store.put(0, designs, bowl(designs))
        back = store.get(0, designs)
        assert back is not None
        assert back.objectives.tobytes() == bowl(designs).objectives.tobytes()
        assert back.failures == bowl(designs).failures
        assert "too far left" in back.failures
        assert store.get(0, designs + 1e-15) is None  # of other designs


def test_folder_of_another_plan_is_refused(tmp_path: Path) -> None:
    with opened_store(tmp_path, PLAN):
        pass
    with (
        pytest.raises(StorageError, match="holds designs of another study"),
        opened_store(tmp_path, {"study": "b"}),
    ):
        pass


@pytest.mark.parametrize("damage", ["cut", "flipped", "removed"])
def test_damaged_chunk_is_evaluated_again(tmp_path: Path, damage: str) -> None:
    whole = searched_in(tmp_path)
    path = sorted(tmp_path.glob("chunk_*.nc"))[7]
    content = bytearray(path.read_bytes())
    if damage == "removed":
        path.unlink()
    else:
        content[len(content) // 2] ^= 1
        path.write_bytes(content[:100] if damage == "cut" else content)
    if damage == "removed":
        again = searched_in(tmp_path)
    else:
        with pytest.warns(UserWarning, match="evaluated again"):
            again = searched_in(tmp_path)
    same(again, whole)


@pytest.mark.parametrize(
    "seed", [0, *(pytest.param(one, marks=pytest.mark.long) for one in (1, 2))]
)
@pytest.mark.long
def test_search_killed_at_random_goes_on_to_the_same_bits(tmp_path: Path, seed: int) -> None:
    killed_and_gone_on(tmp_path, seed)


@pytest.mark.long
@pytest.mark.parametrize("seed", range(3, 30))
def test_search_killed_at_more_moments(tmp_path: Path, seed: int) -> None:
    killed_and_gone_on(tmp_path, seed)


def killed_and_gone_on(folder: Path, seed: int) -> None:
    """SIGKILL at a random moment while chunks are written, then the search again."""
    code = (
        f"import sys; sys.path.insert(0, {str(Path(__file__).parent)!r})\n"
        "from pathlib import Path\n"
        "from test_store import searched_in\n"
        f"print('begun', flush=True); searched_in(Path({str(folder / 'killed')!r}), 0.02)"
    )
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE)
    assert process.stdout is not None
    process.stdout.readline()
    time.sleep(Random(seed).uniform(0.0, 0.8))
    os.kill(process.pid, signal.SIGKILL)
    process.wait()
    process.stdout.close()
    same(searched_in(folder / "killed"), searched_in(folder / "undisturbed"))
