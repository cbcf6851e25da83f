"""Criteria of designs, which take a run each, kept in memory and on disk."""

import time
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path
from typing import Any, Final

import xarray as xr

from ...base.arrays import Array
from ...base.plain_bytes import canonical_json, sha256
from ...base.progress import no_progress
from ...base.registry import plugins
from ...pipeline.study import run
from ...results import storage
from ...study.criterion import CRITERIA
from ...study.study import Study
from ..space import Space
from .needs import Need, ResponsesByNeed
from .sound_path import SoundPath, SoundPaths

SLOW_S: Final = 0.2
"""A run that takes longer is kept on disk, too."""


@dataclass
class Scores:
    """Computes the criteria of designs with one option, each design once by a run.

    Attributes
    ----------
    space : space of the designs
    option : option of all designs
    criteria : requested criteria
    sound_paths : paths to the microphones
    """

    space: Space
    option: str
    criteria: tuple[Need, ...]
    sound_paths: SoundPaths
    _slow: bool = True

    def __call__(self, design: Array) -> ResponsesByNeed:
        """Return the criteria of a design, shape (1,); all samples of the machine share them."""
        study = self.space.quick_study_of(design)
        key = canonical_json(study.parameters()), self.option
        scores: ResponsesByNeed = self.sound_paths.criteria(key, partial(self._cached, study))
        return scores

    def _cached(self, study: Study) -> ResponsesByNeed:
        """Return criteria from memory or disk; after the first run only slow ones get a file."""
        if not self._slow:
            return _scored(study, self.option, self.criteria, self.sound_paths)
        material = _material(study, self.option, self.criteria, self.sound_paths(study))
        result, _ = storage.cached("design", material, partial(self._timed, study), study.title)
        self._slow = result.attrs["seconds"] >= SLOW_S
        return {need: result[str(number)].values for number, need in enumerate(self.criteria)}

    def _timed(self, study: Study) -> xr.Dataset:
        begin = time.perf_counter()
        scores = _scored(study, self.option, self.criteria, self.sound_paths)
        result = _dataset([scores[need] for need in self.criteria])
        result.attrs["seconds"] = time.perf_counter() - begin
        return result


def _scored(
    study: Study, option: str, criteria: Sequence[Need], sound_paths: SoundPaths
) -> dict[Need, Array]:
    """Compute criteria by a run of the pipeline, shape (1,)."""
    operation = study.operation.model_copy(update={"stopping": False, "turning_back": False})
    plain = study.model_copy(update={"ranges": (), "operation": operation})
    results = run(plain, no_progress, sound_paths.radiation)
    return {
        need: CRITERIA[need.name]().value(results).sel(option=[option]).values for need in criteria
    }


def _material(study: Study, option: str, needs: Sequence[Need], path: SoundPath) -> dict[str, Any]:
    """Return everything on which the criteria of a design depend, as JSON values."""
    unread = {"design", "title", "titles", "source_file"}
    return {
        **{name: value for name, value in study.parameters().items() if name not in unread},
        "option": option,
        "needs": [list(need) for need in needs],
        "content": path.content,
        "plugins": plugins(),
        "source": _source_hash(),
    }


@cache
def _source_hash() -> str:
    """Hash of the package: a change of it never meets an old cache."""
    files = sorted(Path(__file__).parents[2].rglob("*.py"))
    return sha256(b"".join(file.read_bytes() for file in files))


def _dataset(arrays: Sequence[Array]) -> xr.Dataset:
    """Return a dataset of arrays by their number, to be stored."""
    return xr.Dataset({
        str(number): (tuple(f"{number}_{axis}" for axis in range(array.ndim)), array)
        for number, array in enumerate(arrays)
    })  # fmt: skip
