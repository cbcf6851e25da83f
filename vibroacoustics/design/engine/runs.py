"""Designs that take a run each, computed once and kept in memory and on disk."""

import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cache, partial
from pathlib import Path
from typing import Any, Final

import numpy as np
import xarray as xr

from ...base.arrays import Array
from ...base.hashing import canonical_json, sha256
from ...base.progress import no_progress
from ...base.registry import plugins
from ...pipeline.study import run
from ...results import storage
from ...study.criterion import CRITERIA
from ...study.study import Study
from ..space import Space
from .deviating import Gains
from .machine_sample import MachineSample
from .on_mounts import lines_of_speed, seen_of
from .probe import Probe, probe
from .seen import Need, Seen
from .sound_way import SoundWay, Ways

SLOW_S: Final = 0.2
"""A run that takes longer is kept on disk, too."""


@dataclass
class CachedRuns:
    """Computes designs with one option, each once.

    Attributes
    ----------
    space : of the designs
    option : of all of them
    needs : what is asked
    ways : to the microphones
    machine : nominal, or a sample
    gains : of the sample by speed; none of the nominal machine
    unmodelled : noise by speed, shape (pair, receiver, band), Pa²; none where not asked for
    """

    space: Space
    option: str
    needs: tuple[Need, ...]
    ways: Ways
    machine: MachineSample
    gains: tuple[Gains | None, ...]
    unmodelled: tuple[Array | None, ...]
    _known: dict[bytes, Seen] = field(default_factory=dict, repr=False)
    _slow: bool = True

    def __call__(self, design: Array) -> Seen:
        """What is seen of a design, shape (1, ...).

        Raises
        ------
        ParameterError, SolverError
            It cannot be built, or not run.
        """
        key = design.tobytes()
        if key not in self._known:
            self._known[key] = self._cached(self.space.quick_study_of(design))
        return self._known[key]

    def _cached(self, study: Study) -> Seen:
        """From memory or disk; from the first run on only slow ones are worth a file."""
        way = self.ways(study)
        if not self._slow:
            return self._seen(study)
        material = _material(study, self.option, self.needs, way) | _of_sample(self.machine)
        noise = [part.tobytes() for part in self.unmodelled if part is not None]
        material["unmodelled"] = sha256(b"".join(noise))
        result, _ = storage.cached("design", material, lambda: self._timed(study), study.title)
        self._slow = result.attrs["seconds"] >= SLOW_S
        return {need: result[str(number)].values for number, need in enumerate(self.needs)}

    def _timed(self, study: Study) -> xr.Dataset:
        begin = time.perf_counter()
        seen = self._seen(study)
        result = _dataset([seen[need] for need in self.needs])
        result.attrs["seconds"] = time.perf_counter() - begin
        return result

    def _seen(self, study: Study) -> Seen:
        """What is seen of one design, shape (1, ...)."""
        made = probe_of(self.space, study, self.option, self.ways, self.machine)
        speeds = study.operation.speed_rpm
        beside = list(zip(self.gains, self.unmodelled, strict=True))
        seen = seen_of_probe(self.needs, made, speeds, self.ways(study), beside)
        criteria = [need for need in self.needs if need.what == "criterion"]
        if not criteria:
            return seen
        key = canonical_json(study.parameters()), self.option
        scored = partial(_scored, study, self.option, criteria, self.ways)
        return seen | self.ways.criteria(key, scored)


def probe_of(space: Space, study: Study, option: str, ways: Ways, machine: MachineSample) -> Probe:
    """Return the probe of a design of a nominal machine or of a sample.

    Raises
    ------
    ParameterError, SolverError
        The design cannot be built, or not run.
    """
    sample = None if machine.deviation is None else machine.without(space.machine_values)
    return probe(study, option, ways, sample, machine.shared)


def _of_sample(machine: MachineSample) -> dict[str, Any]:
    """Everything that a sample adds to what shapes a design, as JSON values."""
    if machine.deviation is None:
        return {}
    values = {".".join(key): value for key, value in machine.values.items()}
    arrays = machine.deviation.gain, machine.deviation.added
    return {"sample": values, "deviation": sha256(b"".join(one.tobytes() for one in arrays))}


def _scored(study: Study, option: str, criteria: Sequence[Need], ways: Ways) -> dict[Need, Array]:
    """Values of criteria, of a run of the pipeline, shape (1,)."""
    operation = study.operation.model_copy(update={"stopping": False, "turning_back": False})
    plain = study.model_copy(update={"ranges": (), "operation": operation})
    results = run(plain, no_progress, ways.radiation)
    return {
        need: CRITERIA[need.name]().value(results).sel(option=[option]).values for need in criteria
    }


def _material(study: Study, option: str, needs: Sequence[Need], way: SoundWay) -> dict[str, Any]:
    """Everything that shapes what is seen of a design, as JSON values."""
    settings = study.parameters()
    kept = ("machine", "operation", "options", "sources")
    return {
        **{name: settings[name] for name in kept},
        "option": option,
        "needs": [list(need) for need in needs],
        "way": [way.key, way.content],
        "plugins": plugins(),
        "source": _source_hash(),
    }


@cache
def _source_hash() -> str:
    """Hash of the package: a change of it never meets an old cache."""
    files = sorted(Path(__file__).parents[2].rglob("*.py"))
    return sha256(b"".join(file.read_bytes() for file in files))


def _dataset(seen: Sequence[Array]) -> xr.Dataset:
    """Arrays by their number, to be stored."""
    return xr.Dataset({
        str(number): (tuple(f"{number}_{axis}" for axis in range(one.ndim)), one)
        for number, one in enumerate(seen)
    })  # fmt: skip


def seen_of_probe(
    needs: Sequence[Need],
    made: Probe,
    speeds_rpm: Sequence[float],
    way: SoundWay,
    beside: Sequence[tuple[Gains | None, Array | None]],
) -> dict[Need, Array]:
    """What is seen of one design by its probe, shape (1, ...)."""
    each = zip(speeds_rpm, made.frequency_hz, made.order, strict=True)
    lines = [lines_of_speed(*one, way, *two) for one, two in zip(each, beside, strict=True)]
    groups = [{name: np.asarray(a)[None] for name, a in one.items()} for one in made.groups()]
    simple = [need for need in needs if need.what != "criterion"]
    return seen_of(simple, lines, groups[:-1], groups[-1], 1)
