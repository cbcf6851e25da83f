"""Some designs of a sweep, timed before it starts, and the work of all of them."""

import time
from collections.abc import Callable, Iterator, Sequence
from typing import Final, NamedTuple

import numpy as np
from scipy.optimize import nnls

from ..base.arrays import Array, IndexArray
from .evaluation import Evaluate, Evaluation, evaluating, joined
from .problem import Problem
from .sweep_values import Listing

_STARTS, _CONSECUTIVE = 3, 4
"""Numbers of pieces from which some are timed, and how many that follow each other."""
_TRIED_S: Final = 2.0
"""Processor time after which no further piece is timed there."""


class Trial(NamedTuple):
    """Designs that were timed, and what follows from them for all.

    Attributes
    ----------
    designs : shape (design, variable), SI
    evaluation : evaluation of the designs
    seconds : processor time of all pieces of the sweep
    spent_s : part of it that was spent on results that are kept
    kept_bytes : memory that results of runs keep in the sweep beyond those of the trial
    """

    designs: Array
    evaluation: Evaluation
    seconds: float
    spent_s: float
    kept_bytes: float


class _Work:
    """Counts what is new in designs that are evaluated one after another.

    Parameters
    ----------
    problem : problem of the study
    """

    def __init__(self, problem: Problem) -> None:
        paths, loads = problem.splitting.paths, problem.splitting.loads
        self._columns = (list(loads), list(paths), [*paths, *loads])
        self._present: tuple[set[bytes], ...] = (set(), set(), set())

    def new(self, designs: Array) -> list[int]:
        """Return the numbers of new loads, new paths and new pairs of both, and of designs."""
        counts = []
        for columns, present in zip(self._columns, self._present, strict=True):
            rows = set(_rows(designs[:, columns])) if columns else set()
            counts.append(len(rows - present))
            present.update(rows)
        return [*counts, len(designs)]

    def few(self, designs: Array) -> Array:
        """Return the designs of a piece with known loads, and the first one with a new load."""
        present = [row in self._present[0] for row in _rows(designs[:, self._columns[0]])]
        chosen = np.array(present)
        chosen[chosen.argmin()] = True
        return np.asarray(designs[chosen])


def _rows(values: Array) -> list[bytes]:
    """Return a key of each row of values."""
    return [row.tobytes() for row in np.ascontiguousarray(values)]


def tried(problem: Problem, listing: Listing) -> Trial:
    """Time some pieces at the begin, in the middle and at the end of a sweep.

    Processor time is fitted to the numbers of new loads, paths, their pairs and designs, so that
    what pieces share is counted once. What is made once for all designs is not timed.
    """
    evaluate, pieces = evaluating(problem), _pieces(problem, listing)
    evaluate(pieces[0][:1])
    if not problem.run_columns:
        timed = list(_timed(pieces, evaluate, lambda piece: piece))
        designs, evaluation = _joined(timed)
        seconds = sum(spent for _, _, spent in timed) * listing.count / len(designs)
        return Trial(designs, evaluation, seconds, 0.0, 0.0)
    here, work, budget = _Work(problem), _work(problem, listing), problem.engine.sound_paths.budget
    here.new(pieces[0][:1])
    new: list[list[int]] = []
    kept_before = budget.kept_bytes

    def counted(piece: Array) -> Array:
        designs = here.few(piece)
        new.append([*here.new(designs), 1])
        return designs

    timed = list(_timed(pieces, evaluate, counted))
    seconds_of = np.array([spent for _, _, spent in timed])
    counts = np.array(new)
    by_kind, _ = nnls(counts / seconds_of[:, None], np.ones(len(timed)))  # relative errors
    made, all_made = counts[:, :2].sum(), work[:2].sum()
    kept = (budget.kept_bytes - kept_before) / max(made, 1)
    return Trial(
        *_joined(timed),
        float(by_kind @ work),
        float(seconds_of.sum()),
        float(kept * max(all_made - made, 0)),
    )


def _joined(timed: list[tuple[Array, Evaluation, float]]) -> tuple[Array, Evaluation]:
    """Return all timed designs and their evaluation."""
    designs, evaluations, _ = zip(*timed, strict=True)
    return np.concatenate(designs), joined(list(evaluations))


def _work(problem: Problem, listing: Listing) -> IndexArray:
    """Count loads, paths, their pairs, designs and pieces of a sweep."""
    work, total = _Work(problem), np.zeros(5, dtype=np.intp)
    for block in listing.blocks():
        designs = listing.designs(listing.ordered(block))
        total += [*work.new(designs), sum(1 for _ in problem.splitting.pieces(designs))]
    return total


def _pieces(problem: Problem, listing: Listing) -> list[Array]:
    """Return the pieces of the first, the middle and the last block of designs."""
    blocks = list(listing.blocks())
    some = [blocks[n] for n in sorted({0, len(blocks) // 2, len(blocks) - 1})]
    designs = (listing.designs(listing.ordered(block)) for block in some)
    return [piece for each in designs for piece in problem.splitting.pieces(each)]


def _timed(
    pieces: Sequence[Array], evaluate: Evaluate, chosen: Callable[[Array], Array]
) -> Iterator[tuple[Array, Evaluation, float]]:
    """Give designs of some pieces with their evaluation and its processor time, s."""
    for numbers in np.array_split(np.arange(len(pieces)), min(_STARTS, len(pieces))):
        begin = time.process_time()
        for number in numbers[:_CONSECUTIVE].tolist():
            designs, before = chosen(pieces[number]), time.process_time()
            evaluation = evaluate(designs)
            yield designs, evaluation, time.process_time() - before
            if time.process_time() - begin > _TRIED_S:
                break
