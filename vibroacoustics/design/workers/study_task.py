"""The task of a worker that evaluates designs of a study, as JSON: where its file is, and hashes.

A worker reads the study and the plug-ins from the same paths, and refuses others than those of
whoever asks: of another content, or another version of the package.
"""

import json
import socket
from collections.abc import Sequence
from functools import lru_cache
from pathlib import Path

from ...base.errors import ParameterError
from ...base.plain_bytes import canonical_json, sha256
from ...base.plugin_file import load_plugin
from ...base.regular_file import read_bytes
from ...radiation.given import Radiation
from ...results.provenance import software_version
from ...stages.radiation import transfer_vectors
from ...study.loading import load_study
from ...study.study import Study
from ..evaluation import Evaluate, evaluating
from ..problem import Problem

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
