"""Chunks of evaluated designs in a folder: numbered files that appear whole or not at all.

A chunk is written once and never changed. One that is missing, damaged or of other designs is not
there: it is evaluated again, so that a run goes on from wherever it was ended.
"""

import json
import warnings
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Final

import numpy as np
import xarray as xr

from ...base.arrays import Array
from ...base.errors import StorageError
from ...base.folder import Folder, make_folder, opened_folder
from ...base.hashing import canonical_json
from ...results.files import LOCK_NAME, STAGING_NAME, naming, replace_all, staging, write
from ...results.lock import locked
from ...results.storage import results_in, stage_results
from ..evaluation import Evaluate, Evaluation

PLAN_NAME: Final = "plan.json"
_MAXIMUM_PLAN_BYTES: Final = 10_000_000


class ChunkStore:
    """Chunks in a folder that this process alone writes; made by `opened_store`."""

    def __init__(self, folder: Folder) -> None:
        self._folder = folder

    def get(self, number: int, designs: Array) -> Evaluation | None:
        """A chunk, where it is there, undamaged, and of just these designs."""
        name = _name(number)
        self._folder.check_file(name)
        if not self._folder.holds_file(name):
            return None
        try:
            chunk = results_in(self._folder, name)
        except StorageError as error:
            warnings.warn(f"{error}; its designs are evaluated again", stacklevel=2)
            return None
        if not np.array_equal(chunk["design_values"].values, designs):
            return None
        return Evaluation(
            chunk["objectives"].values,
            chunk["constraints"].values,
            tuple(json.loads(chunk.attrs["failures"])),
        )

    def put(self, number: int, designs: Array, evaluation: Evaluation) -> None:
        """Write a chunk.

        Raises
        ------
        StorageError
            It cannot be written.
        """
        chunk = xr.Dataset(
            {
                "design_values": (("design", "variable"), designs),
                "objectives": (("design", "objective"), evaluation.objectives),
                "constraints": (("design", "constraint"), evaluation.constraints),
            },
            attrs={"failures": json.dumps(evaluation.failures)},
        )
        with staging(self._folder, STAGING_NAME) as staged:
            stage_results(chunk, staged, _name(number))
            replace_all(staged)


def _name(number: int) -> str:
    return f"chunk_{number:08d}.nc"


@contextmanager
def opened_store(path: Path, plan: dict[str, object]) -> Iterator[ChunkStore]:
    """Chunks of a plan in a folder, which has one writer at a time.

    Parameters
    ----------
    path : of the folder, in that of the results; both are made where they are missing
    plan : what shapes the designs and their evaluation, as JSON values

    Raises
    ------
    StorageError
        The folder holds designs of another plan, or cannot be written.
    """
    with ExitStack() as stack:
        with naming(path):
            make_folder(path.parent)
            results = stack.enter_context(opened_folder(path.parent))
            folder = stack.enter_context(results.below(path.name, make=True))
            stack.enter_context(locked(folder, LOCK_NAME, str(path)))
        _same_plan(folder, canonical_json(plan).encode())
        yield ChunkStore(folder)


def _same_plan(folder: Folder, plan: bytes) -> None:
    """Write the plan, or see that it is the one that is there."""
    try:
        present = folder.read_bytes(PLAN_NAME, _MAXIMUM_PLAN_BYTES)
    except FileNotFoundError:
        with staging(folder, STAGING_NAME) as staged:
            write(staged, PLAN_NAME, plan)
            replace_all(staged)
        return
    except OSError as error:
        raise StorageError(f"{folder.path / PLAN_NAME}: cannot be read: {error.strerror}") from None
    if present != plan:
        raise StorageError(
            f"{folder.path}: holds designs of another study, version or plan: "
            "choose another folder with --out, or remove this one"
        )


class Stored:
    """Evaluation of one batch after another that looks its answers up before it computes them.

    A search with the same seed asks for the same designs; so one that was ended goes on where it
    was, and ends with the same bits.
    """

    def __init__(self, evaluate: Evaluate, store: ChunkStore) -> None:
        self._evaluate, self._store = evaluate, store
        self._number = 0

    def __call__(self, designs: Array) -> Evaluation:
        """Evaluate a batch."""
        number, self._number = self._number, self._number + 1
        evaluation = self._store.get(number, designs)
        if evaluation is None:
            evaluation = self._evaluate(designs)
            self._store.put(number, designs, evaluation)
        return evaluation
