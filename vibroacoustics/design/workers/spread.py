"""A batch of designs as workers evaluate it; the bits do not depend on the number of workers."""

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from functools import lru_cache, partial

import numpy as np

from ...base.arrays import Array
from ...base.linear_algebra import one_thread_of_linear_algebra
from ...base.processes import ProcessPool
from ..evaluation import Evaluate, Evaluation, joined

Builder = Callable[[bytes], Evaluate]
"""A function of a module that makes an evaluation from the JSON of a task."""
ParallelMap = Callable[
    [
        Callable[[Array], Evaluation],
        Iterable[Array],
        Callable[[Array, str], Evaluation],
    ],
    Iterator[Evaluation],
]
"""Takes a function, items and the result of an item that is lost; `ProcessPool.in_order` is one."""


@contextmanager
def local_workers(number: int) -> Iterator[ParallelMap]:
    """Open processes of this machine; gives their map."""
    with ProcessPool(number) as pool:
        yield pool.in_order


def spread(
    parallel_map: ParallelMap, builder: Builder, task: bytes, piece: int, counts: tuple[int, int]
) -> Evaluate:
    """Make an evaluation by workers.

    Parameters
    ----------
    parallel_map : of the workers
    builder : function of a module that the workers have, which makes the evaluation
    task : JSON for the builder
    piece : designs that a worker gets at a time
    counts : of objectives and of constraints, for designs that no worker survives
    """

    def lost(designs: Array, reason: str) -> Evaluation:
        objectives, constraints = (np.full((len(designs), count), np.nan) for count in counts)
        return Evaluation(objectives, constraints, (f"its workers ended: {reason}",) * len(designs))

    def evaluate(designs: Array) -> Evaluation:
        function = partial(evaluate_piece, builder, task)
        return joined(list(parallel_map(function, pieces(designs, piece), lost)))

    return evaluate


def in_pieces(evaluate: Evaluate, piece: int) -> Evaluate:
    """Make the same evaluation in this process, in the same pieces and so to the same bits."""
    return lambda designs: joined([evaluate(part) for part in pieces(designs, piece)])


def pieces(designs: Array, piece: int) -> list[Array]:
    """Split designs into pieces; the last one may be shorter."""
    return [designs[start : start + piece] for start in range(0, len(designs), piece)]


def evaluate_piece(builder: Builder, task: bytes, designs: Array) -> Evaluation:
    """Evaluate a piece on a worker.

    Parameters
    ----------
    builder : makes the evaluation of the task, once a process
    task : JSON for the builder
    designs : in SI, shape (design, variable)
    """
    with one_thread_of_linear_algebra():
        return _built(builder, task)(designs)


@lru_cache(maxsize=2)
def _built(builder: Builder, task: bytes) -> Evaluate:
    return builder(task)
