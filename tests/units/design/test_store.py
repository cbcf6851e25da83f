"""Pieces of designs on disk: whole, of one plan, each evaluated once, resumed to the same bits."""

import os
import signal
import subprocess
import sys
import time
from functools import partial
from pathlib import Path
from random import Random

import numpy as np
import pytest

from vibroacoustics.base.arrays import Array
from vibroacoustics.base.errors import StorageError
from vibroacoustics.base.folder import opened_folder
from vibroacoustics.design.evaluation import Evaluation, joined
from vibroacoustics.design.search.best import search_best
from vibroacoustics.design.search.problem import Searched, SearchProblem
from vibroacoustics.design.store.pieces import opened_store, stored
from vibroacoustics.results import piece_files
from vibroacoustics.results.piece_files import PieceFiles

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
        each = stored(partial(map, evaluate), store)
        problem = SearchProblem(
            np.array([-1.0, -1.0]), np.array([1.0, 1.0]), np.zeros(2, bool),
            lambda designs: joined(list(each([designs]))),
        )  # fmt: skip
        return search_best(problem, 12, 25, seed=4)


def same(first: Searched, second: Searched) -> None:
    """Every bit and every reason."""
    assert first.designs.tobytes() == second.designs.tobytes()
    assert first.evaluation.objectives.tobytes() == second.evaluation.objectives.tobytes()
    assert first.evaluation.failures == second.evaluation.failures


def test_piece_comes_back_with_its_failures(tmp_path: Path) -> None:
    designs = np.random.default_rng(0).uniform(-1.0, 1.0, (50, 2))
    for written in (False, True):  # from the batch, then from the file
        with opened_store(tmp_path / "designs", PLAN) as store:
            assert ("all" in store) == written
            if not written:
                store.put("all", bowl(designs))
                store.put("some", bowl(designs[:3]))
            back = store.get("all")
            assert back.objectives.tobytes() == bowl(designs).objectives.tobytes()
            assert back.failures == bowl(designs).failures
            assert "too far left" in back.failures
            assert store.get("some").failures == back.failures[:3]
            assert "none" not in store
    assert [one.name for one in tmp_path.glob("designs/pieces_*")] == ["pieces_00000000.bin"]


def test_pieces_are_written_by_time(tmp_path: Path) -> None:
    """A file at the first piece that ends 10 s or more after the last file."""
    now_s = 0.0
    with opened_folder(tmp_path) as folder:
        store = PieceFiles(folder, lambda: now_s)
        for number in range(24):
            now_s += 3.0
            store.put(str(number), bowl(np.ones((1, 2))))
            assert len(list(tmp_path.glob("pieces_*"))) == (number + 1) // 4


def test_pieces_are_evaluated_once_in_any_order(tmp_path: Path) -> None:
    """Some are known, others not, and one is asked for twice at a time."""
    designs = [np.full((1, 2), 0.1 * number) for number in range(8)]
    evaluated: list[float] = []

    def evaluate(piece: Array) -> Evaluation:
        evaluated.append(float(piece[0, 0]))
        return bowl(piece)

    with opened_store(tmp_path / "designs", PLAN) as store:
        each = stored(partial(map, evaluate), store)
        list(each([designs[5], designs[2]]))
        asked = [*designs[::-1], designs[0]]
        values = [float(one.objectives[0, 0]) for one in each(asked)]
    assert values == [float((piece**2).sum()) for piece in asked]
    assert sorted(evaluated[:9]) == sorted(float(piece[0, 0]) for piece in designs)


def test_folder_of_another_plan_is_refused(tmp_path: Path) -> None:
    with opened_store(tmp_path, PLAN):
        pass
    with (
        pytest.raises(StorageError, match="holds designs of another study"),
        opened_store(tmp_path, {"study": "b"}),
    ):
        pass


@pytest.mark.parametrize("damage", ["cut", "flipped", "removed"])
def test_damaged_file_is_evaluated_again(
    tmp_path: Path, damage: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(piece_files, "BATCH_S", 0.0)  # a file a generation
    whole = searched_in(tmp_path)
    path = sorted(tmp_path.glob("pieces_*.bin"))[7]
    content = bytearray(path.read_bytes())
    if damage == "removed":
        path.unlink()
    else:
        content[len(content) // 2] ^= 1
        path.write_bytes(content[:100] if damage == "cut" else content)
    if damage == "removed":
        again = searched_in(tmp_path)
    else:
        with pytest.warns(UserWarning, match="computed again"):
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
    """SIGKILL at a random moment while files are written, then the search again."""
    code = (
        f"import sys; sys.path.insert(0, {str(Path(__file__).parent)!r})\n"
        "from pathlib import Path\n"
        "from test_store import piece_files, searched_in\n"
        "piece_files.BATCH_S = 0.1\n"
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
