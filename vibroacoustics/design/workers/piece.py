"""A piece of designs as it goes to a worker and comes back: JSON, in which every bit is kept."""

import json
from collections.abc import Callable
from functools import lru_cache

import numpy as np

from ...base.arrays import Array
from ...base.linear_algebra import one_thread_of_linear_algebra
from ..evaluation import Evaluate, Evaluation

Builder = Callable[[bytes], Evaluate]
"""A function of a module that makes an evaluation of what a task's JSON says."""


def evaluate_piece(builder: Builder, task: bytes, designs: bytes) -> bytes:
    """Evaluate a piece on a worker.

    Parameters
    ----------
    builder : makes the evaluation of the task, once a process
    task : JSON of the task
    designs : of `designs_to_json`

    Returns
    -------
    JSON of the evaluation
    """
    with one_thread_of_linear_algebra():
        evaluation = _built(builder, task)(np.array(json.loads(designs), dtype=float))
    parts = (evaluation.objectives.tolist(), evaluation.constraints.tolist(), evaluation.failures)
    return json.dumps(parts).encode()


def designs_to_json(designs: Array) -> bytes:
    """Designs, shape (design, variable), as JSON."""
    return json.dumps(designs.tolist()).encode()


def evaluation_from_json(content: bytes) -> Evaluation:
    """What `evaluate_piece` gave."""
    objectives, constraints, failures = json.loads(content)
    rows = len(objectives)
    return Evaluation(
        np.array(objectives, dtype=float).reshape(rows, -1),
        np.array(constraints, dtype=float).reshape(rows, -1),
        tuple(failures),
    )


@lru_cache(maxsize=2)
def _built(builder: Builder, task: bytes) -> Evaluate:
    return builder(task)
