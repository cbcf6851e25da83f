"""Evaluated pieces of designs in a folder, by the hash of their designs."""

import json
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from functools import partial
from pathlib import Path
from typing import Final

import numpy as np
import xarray as xr

from ...base.arrays import Array
from ...base.errors import StorageError
from ...base.folder import Folder, make_folder, opened_folder
from ...base.hashing import canonical_json, sha256
from ...base.pieces import each_once
from ...results.files import LOCK_NAME, STAGING_NAME, Staging, naming, replace_all, staging, write
from ...results.lock import locked
from ...results.piece_files import PieceFiles
from ...results.storage import results_in, stage_results
from ..evaluation import Evaluation, Stream, joined

PLAN_NAME: Final = "plan.json"
_MAXIMUM_PLAN_BYTES: Final = 10_000_000


class PieceStore(PieceFiles[Evaluation]):
    """Evaluated pieces by `key_of` their designs; made by `opened_store`."""

    suffix, batch_bytes, pieces = ".nc", 32_000_000, "designs"

    def _size_bytes(self, piece: Evaluation) -> int:
        return piece.objectives.nbytes + piece.constraints.nbytes

    def _stage(self, pieces: Mapping[str, Evaluation], staged: Staging, name: str) -> None:
        stage_results(_dataset(pieces), staged, name)

    def _read(self, name: str) -> dict[str, Evaluation]:
        stored = results_in(self._folder, name)
        failed = json.loads(stored.attrs["failures"])
        reasons = tuple(failed.get(str(row), "") for row in range(stored.sizes["design"]))
        every = stored["objectives"].values, stored["constraints"].values, reasons
        counts = json.loads(stored.attrs["pieces"])
        ends = np.cumsum([0, *counts.values()]).tolist()
        slices = map(slice, ends[:-1], ends[1:])
        return {
            key: Evaluation(every[0][rows], every[1][rows], every[2][rows])
            for key, rows in zip(counts, slices, strict=True)
        }


def key_of(designs: Array) -> str:
    """Key of a piece of designs (design, variable)."""
    return sha256(designs.tobytes())[:32]


def _dataset(pieces: Mapping[str, Evaluation]) -> xr.Dataset:
    """Pieces by their keys as a dataset, one after another."""
    every = joined(list(pieces.values()))
    failed = {row: reason for row, reason in enumerate(every.failures) if reason}
    return xr.Dataset(
        {
            "objectives": (("design", "objective"), every.objectives),
            "constraints": (("design", "constraint"), every.constraints),
        },
        attrs={
            "pieces": json.dumps({key: len(piece.failures) for key, piece in pieces.items()}),
            "failures": json.dumps(failed),
        },
    )


@contextmanager
def opened_store(path: Path, plan: dict[str, object]) -> Iterator[PieceStore]:
    """Open the pieces of a plan in a folder, which has one writer at a time.

    What is not written yet is written at the end, also after an error.

    Parameters
    ----------
    path : path of the folder, in that of the results; both are made where they are missing
    plan : inputs that shape the designs and their evaluation, as JSON values

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
        store = PieceStore(folder)
        stack.callback(store.write)
        yield store


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


def stored(stream: Stream, store: PieceStore) -> Stream:
    """Return what evaluates each piece once: those of a store are read there.

    Parameters
    ----------
    stream : function that evaluates pieces that the store does not hold
    store : store of evaluated pieces
    """
    return partial(each_once, stream=stream, store=store, key_of=key_of)
