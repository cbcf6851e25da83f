"""Evaluated pieces of designs in a folder, by the hash of their designs; see `PieceFiles`."""

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from functools import partial
from pathlib import Path
from typing import Any, Final

from ...base.arrays import Array
from ...base.errors import StorageError
from ...base.folder import Folder, make_folder, opened_folder
from ...base.forms import has_form
from ...base.plain_bytes import canonical_json, sha256
from ...results.files import LOCK_NAME, STAGING_NAME, naming, replace_all, staging, write
from ...results.lock import locked
from ...results.piece_files import PieceFiles
from ..evaluation import Evaluation, Stream

PLAN_NAME: Final = "plan.json"
_MAXIMUM_PLAN_BYTES: Final = 10_000_000


@contextmanager
def opened_store(path: Path, plan: dict[str, object]) -> Iterator[PieceFiles]:
    """Open the pieces of a plan in a folder, which has one writer at a time.

    What is not written yet is written at the end, also after an error.

    Parameters
    ----------
    path : path of the folder, in that of the results; both are made where they are missing
    plan : inputs that shape the designs and their evaluation, as JSON values
    """
    with ExitStack() as stack:
        with naming(path):
            make_folder(path.parent)
            results = stack.enter_context(opened_folder(path.parent))
            folder = stack.enter_context(results.below(path.name, make=True))
            stack.enter_context(locked(folder, LOCK_NAME, str(path)))
        _same_plan(folder, canonical_json(plan).encode())
        store = PieceFiles(folder)
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


def stored(stream: Stream, store: PieceFiles, counts: tuple[int, int] | None = None) -> Stream:
    """Return what evaluates each piece once: those of a store are read there.

    Parameters
    ----------
    stream : function that evaluates pieces that the store does not hold
    store : store of evaluated pieces
    counts : numbers of objectives and constraints; None where they are not known
    """
    return partial(
        store.each_once,
        stream=stream,
        key_of=lambda designs: sha256(designs.tobytes())[:32],
        fits=lambda designs, piece: _fits(designs, piece, counts),
    )


def _fits(designs: Array, piece: Any, counts: tuple[int, int] | None) -> bool:
    """Whether a piece is the evaluation of designs."""
    if not has_form(piece, Evaluation):
        return False
    shapes = piece.objectives.shape, piece.constraints.shape
    if [len(shape) for shape in shapes] != [2, 2] or len(piece.failures) != len(designs):
        return False
    columns = tuple(shape[1] for shape in shapes)
    return {shape[0] for shape in shapes} == {len(designs)} and columns == (counts or columns)
