"""Pieces of designs as workers evaluate them; the bits do not depend on the number of workers."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import lru_cache, partial

import numpy as np

from ...base.arrays import Array
from ...base.linear_algebra import one_thread_of_linear_algebra
from ...base.processes import ParallelMap, ProcessPool
from ..evaluation import Evaluate, Evaluation, Stream

Builder = Callable[[bytes], Evaluate]
"""A function of a module that makes an evaluation from the JSON of a task."""


@contextmanager
def local_workers(number: int) -> Iterator[ParallelMap]:
    """Open processes of this machine; gives their map."""
    with ProcessPool(number) as pool:
        yield pool.in_order


def spread(
    parallel_map: ParallelMap, builder: Builder, task: bytes, counts: tuple[int, int]
) -> Stream:
    """Return what evaluates pieces by workers.

    Parameters
    ----------
    parallel_map : map of the workers
    builder : function of a module that the workers have, which makes the evaluation
    task : JSON for the builder
    counts : number of objectives and of constraints, for designs that no worker survives
    """

    def lost(designs: Array, reason: str) -> Evaluation:
        objectives, constraints = (np.full((len(designs), count), np.nan) for count in counts)
        return Evaluation(objectives, constraints, (f"its workers ended: {reason}",) * len(designs))

    return lambda pieces: parallel_map(partial(evaluate_piece, builder, task), pieces, lost)


def evaluate_piece(builder: Builder, task: bytes, designs: Array) -> Evaluation:
    """Evaluate a piece on a worker.

    Parameters
    ----------
    builder : makes the evaluation of the task, once a process
    task : JSON for the builder
    designs : shape (design, variable), SI
    """
    with one_thread_of_linear_algebra():
        return _built(builder, task)(designs)


@lru_cache(maxsize=2)
def _built(builder: Builder, task: bytes) -> Evaluate:
    return builder(task)
