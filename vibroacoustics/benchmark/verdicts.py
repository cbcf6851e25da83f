"""Verdicts of the benchmark's scorer, which is a file apart from this package."""

from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType
from typing import NamedTuple

from ..base.errors import StorageError


class Scored(NamedTuple):
    """Verdict of the scorer on a submission.

    Attributes
    ----------
    lines : for a terminal
    failed : names of the cases that fail
    """

    lines: list[str]
    failed: list[str]


def scored(folder: Path, submission: Path) -> Scored:
    """Score a submission by the file `score.py` of the benchmark.

    Parameters
    ----------
    folder : folder of the benchmark, with `score.py` and `cases`
    submission : CSV file with the columns case, key, unit and value

    Raises
    ------
    StorageError
        The scorer or the submission cannot be read.
    """
    scorer = _scorer(folder / "score.py")
    try:
        verdicts = scorer.score(scorer.read_submission(submission), scorer.case_names())
    except scorer.RefusedError as error:
        raise StorageError(str(error)) from None
    failed = dict.fromkeys(verdict.case for verdict in verdicts if not verdict.passed)
    return Scored(scorer.summary(verdicts), list(failed))


def _scorer(path: Path) -> ModuleType:
    spec = spec_from_file_location("score", path)
    if spec is None or spec.loader is None or not path.is_file():
        raise StorageError(f"{path}: is missing; install the package again")
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
