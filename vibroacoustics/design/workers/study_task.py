"""The task of a worker that evaluates designs of a study, as JSON, and pieces for all workers."""

import json
import socket
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import lru_cache, partial
from pathlib import Path

import numpy as np

from ...base.arrays import Array
from ...base.errors import ParameterError
from ...base.linear_algebra import one_thread_of_linear_algebra
from ...base.plain_bytes import canonical_json, sha256
from ...base.plugin_file import load_plugin
from ...base.processes import ParallelMap, ProcessPool
from ...base.regular_file import read_bytes
from ...radiation.given import Radiation
from ...results.provenance import software_version
from ...stages.radiation import transfer_vectors
from ...study.loading import load_study
from ...study.study import Study
from ..evaluation import Evaluate, Evaluation, Stream, evaluating
from ..problem import Problem

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


_MAXIMUM_BYTES = 10_000_000


def study_plan(study: Study, plugins: Sequence[Path]) -> dict[str, object]:
    """Return the inputs that shape designs and their values.

    A store that holds designs of another plan is refused. A longer search of the same space goes
    on where a shorter one ended.
    """
    parameters = study.parameters()
    for name in ("generations", "best", "fresh_samples", "runs", "repeats", "least_gain"):
        parameters["design"]["search"].pop(name)
    return {
        "parameters": sha256(canonical_json(parameters).encode()),
        "version": software_version(),
        "plugins": [_hash_of(path) for path in plugins],
    }


def requirement(plugins: Sequence[Path]) -> bytes:
    """Return what a worker must have, as JSON: this version of the package, and plug-ins.

    Parameters
    ----------
    plugins : files that were loaded before
    """
    files = [[str(path.resolve()), _hash_of(path)] for path in plugins]
    return canonical_json({"version": software_version(), "plugins": files}).encode()


@lru_cache(maxsize=2)
def meet(required: bytes) -> None:
    """Load the plug-ins of a `requirement` on a worker, once a process.

    Raises
    ------
    ParameterError
        A file is missing there, or is another one, or the version of the package differs.
    """
    wanted, here = json.loads(required), f"worker on {socket.gethostname()}"
    if wanted["version"] != software_version():
        raise ParameterError(f"{here}: has version {software_version()}, not {wanted['version']}")
    for name, digest in wanted["plugins"]:
        try:
            same = _hash_of(Path(name)) == digest
        except OSError:
            same = False
        if not same:
            raise ParameterError(f"{here}: plug-in {name}: is missing there, or another one")
        load_plugin(name)


def study_task(path: Path, study: Study, plugins: Sequence[Path]) -> bytes:
    """Return what a worker needs to evaluate designs of a study, as JSON.

    Parameters
    ----------
    path : path of the study's file, which the workers can read too
    study : study that was read from it
    plugins : files that were loaded before
    """
    content = {
        "study": str(path.resolve()),
        "parameters": study_hash(study),
        "requirement": requirement(plugins).decode(),
    }
    return canonical_json(content).encode()


def evaluate_task(task: bytes, radiation: Radiation = transfer_vectors) -> Evaluate:
    """Return the evaluation of the designs of a task's study, on a worker.

    Parameters
    ----------
    task : task from `study_task`
    radiation : function that gives the transfer vectors

    Raises
    ------
    ParameterError
        A file is missing there, or is another one.
    """
    content = json.loads(task)
    meet(content["requirement"].encode())
    study = load_study(content["study"])
    if study_hash(study) != content["parameters"]:
        here = f"worker on {socket.gethostname()}"
        raise ParameterError(f"{here}: {content['study']}: is another study there")
    return evaluating(Problem(study, radiation))


def study_hash(study: Study) -> str:
    """Hash of all parameters of a study."""
    return sha256(canonical_json(study.parameters()).encode())


def _hash_of(path: Path) -> str:
    return sha256(read_bytes(path, _MAXIMUM_BYTES))
