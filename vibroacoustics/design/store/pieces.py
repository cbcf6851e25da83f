"""Evaluated pieces of designs in a folder: files that appear whole or not at all.

A piece is known by the hash of its designs, so that it is evaluated once, whatever asks for it. A
file holds the pieces of some seconds. One that is damaged is removed, and its pieces are evaluated
again.
"""

import json
import time
import warnings
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Final

import numpy as np
import xarray as xr

from ...base.arrays import Array
from ...base.errors import StorageError
from ...base.folder import Folder, make_folder, opened_folder
from ...base.hashing import canonical_json, sha256
from ...results.files import LOCK_NAME, STAGING_NAME, naming, replace_all, staging, write
from ...results.lock import locked
from ...results.storage import results_in, stage_results
from ..evaluation import Evaluation, Stream, joined

PLAN_NAME: Final = "plan.json"
_MAXIMUM_PLAN_BYTES: Final = 10_000_000
BATCH_S: Final = 10.0
"""Longest time between two files, but for the piece that is in work."""
_BATCH_BYTES: Final = 32_000_000
"""Most values of a file."""


class PieceStore:
    """Evaluated pieces in a folder that this process alone writes; made by `opened_store`.

    Parameters
    ----------
    folder : folder of the files
    clock : function that gives the time, s
    """

    def __init__(self, folder: Folder, clock: Callable[[], float] = time.monotonic) -> None:
        self._folder, self._clock = folder, clock
        self._batch: dict[str, Evaluation] = {}
        self._batch_bytes, self._written_s = 0, clock()
        self._rows: dict[str, tuple[str, slice]] = {}
        self._last: tuple[str, Evaluation] | None = None
        self._names = sorted(name for name in folder.files() if name.startswith("pieces_"))
        for name in self._names:
            self._take_in(name)

    def __contains__(self, designs: Array) -> bool:
        return (key := _key(designs)) in self._batch or key in self._rows

    def get(self, designs: Array) -> Evaluation:
        """Return the evaluation of a piece that the store holds.

        Raises
        ------
        StorageError
            Its file cannot be read any more.
        """
        key = _key(designs)
        if key in self._batch:
            return self._batch[key]
        name, rows = self._rows[key]
        if self._last is None or self._last[0] != name:
            self._last = name, _evaluation(results_in(self._folder, name))
        stored = self._last[1]
        return Evaluation(stored.objectives[rows], stored.constraints[rows], stored.failures[rows])

    def put(self, designs: Array, evaluation: Evaluation) -> None:
        """Keep a piece; it is written with those of the last seconds.

        Raises
        ------
        StorageError
            They cannot be written.
        """
        self._batch[_key(designs)] = evaluation
        self._batch_bytes += evaluation.objectives.nbytes + evaluation.constraints.nbytes
        due_s = self._written_s + BATCH_S
        if self._clock() >= due_s or self._batch_bytes >= _BATCH_BYTES:
            self.write()

    def write(self) -> None:
        """Write the pieces that are not written yet.

        Raises
        ------
        StorageError
            They cannot be written.
        """
        if self._batch:
            number = 1 + int(self._names[-1][len("pieces_") : -len(".nc")]) if self._names else 0
            name = f"pieces_{number:08d}.nc"
            with staging(self._folder, STAGING_NAME) as staged:
                stage_results(_dataset(self._batch), staged, name)
                replace_all(staged)
            self._names.append(name)
            self._index(name, {key: len(piece.failures) for key, piece in self._batch.items()})
        self._batch, self._batch_bytes, self._written_s = {}, 0, self._clock()

    def _take_in(self, name: str) -> None:
        """Note the pieces of a file; remove it if it is damaged."""
        self._folder.check_file(name)
        try:
            self._index(name, json.loads(results_in(self._folder, name).attrs["pieces"]))
        except StorageError as error:
            warnings.warn(f"{error}; its designs are evaluated again", stacklevel=4)
            self._folder.remove(name)

    def _index(self, name: str, counts: dict[str, int]) -> None:
        ends = np.cumsum([0, *counts.values()]).tolist()
        slices = map(slice, ends[:-1], ends[1:])
        self._rows |= {key: (name, rows) for key, rows in zip(counts, slices, strict=True)}


def _key(designs: Array) -> str:
    return sha256(designs.tobytes())[:32]


def _dataset(pieces: dict[str, Evaluation]) -> xr.Dataset:
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


def _evaluation(stored: xr.Dataset) -> Evaluation:
    failed = json.loads(stored.attrs["failures"])
    reasons = tuple(failed.get(str(row), "") for row in range(stored.sizes["design"]))
    return Evaluation(stored["objectives"].values, stored["constraints"].values, reasons)


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

    def each(pieces: Iterable[Array]) -> Iterator[Evaluation]:
        waiting: deque[tuple[Array, bool]] = deque()

        def missing() -> Iterator[Array]:
            for piece in pieces:
                waiting.append((piece, piece in store))
                if not waiting[-1][1]:
                    yield piece

        def stored_next() -> Iterator[Evaluation]:
            while waiting and waiting[0][1]:
                yield store.get(waiting.popleft()[0])

        for evaluation in stream(missing()):
            yield from stored_next()
            store.put(waiting.popleft()[0], evaluation)
            yield evaluation
        yield from stored_next()

    return each
