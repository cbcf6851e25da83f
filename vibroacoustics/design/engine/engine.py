"""Responses of any designs of a space, and criteria that take a run each."""

import time
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path
from typing import Any, Final

import numpy as np
import xarray as xr

from ...base.arrays import Array
from ...base.plain_bytes import canonical_json, sha256
from ...base.progress import no_progress
from ...base.registry import plugins
from ...base.units import si_key
from ...machine.combination import members_by_name
from ...machine.machine import Machine
from ...machine.option import Option
from ...pipeline.study import run
from ...results import storage
from ...study.criterion import CRITERIA
from ...study.study import Study
from ..keys import acts_on
from ..space import OPTION, Space
from .closed_form import CLOSED_FORMS, of_many
from .contraction import Contraction
from .deviating import Gains
from .hearing import HEARING
from .machine_sample import MachineSample
from .needs import Need, ResponsesByNeed
from .option_engine import ARRAYS, OptionEngine, Outcome
from .recognition import Explorer, Route
from .samples import Samples
from .sound_path import SoundPath, SoundPaths
from .terms import Basis

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


class Engine:
    """Computes designs: by linear algebra where probes show that it is exact, else by runs.

    Parameters
    ----------
    space : space of the designs
    limits : limits of the variables with their tolerances, shape (variable, 2), SI
    needs : requested responses
    sound_paths : paths to the microphones
    machine : nominal, or a sample
    gains : gains of the sample by speed; none for the nominal machine
    template : engine of the same space with another sample, whose variables act alike
    """

    def __init__(
        self,
        space: Space,
        limits: Array,
        needs: Sequence[Need],
        sound_paths: SoundPaths,
        machine: MachineSample,
        gains: tuple[Gains | None, ...],
        template: "Engine | None" = None,
    ) -> None:
        self.space = space
        self.limits = limits
        self.needs = tuple(dict.fromkeys(needs))
        self.sound_paths = sound_paths
        self.machine = machine
        self.gains = gains
        self.template = template
        self._of_options: dict[str, OptionEngine] = {}

    def outcome(self, values: Array) -> Outcome:
        """Compute the responses of designs, shape (design, variable) in SI, and why some failed."""
        if len(self.space.options) == 1:
            return self.of_option(self.space.options[0]).outcome(values)
        result = Outcome()
        for number, option in enumerate(self.space.options):
            rows = np.flatnonzero(np.rint(values[:, 0]) == number)
            if not rows.size:
                continue
            part = self.of_option(option).outcome(values[rows])
            result.take(rows, part.results, len(values))
            result.failed |= {int(rows[row]): reason for row, reason in part.failed.items()}
        return result

    def routes(self, option: str) -> dict[str, Route]:
        """Return the route of each variable in designs with an option, by its key."""
        _, routes = self.of_option(option).recognised
        return dict(zip(self.space.names, routes, strict=True))

    def of_option(self, option: str) -> OptionEngine:
        """Return the engine of designs with one option."""
        if option not in self._of_options:
            self._of_options[option] = self._made(option)
        return self._of_options[option]

    def _made(self, option: str) -> OptionEngine:
        space = self.space
        figures = {need.name for need in self.needs if need.what == "figure"}
        speeds = space.study.operation.speed_rpm
        contraction = Contraction(space, option, self.sound_paths, self.machine)
        samples = Samples(contraction.probe)
        limits = self.limits.copy()
        if space.names[:1] == [OPTION]:
            limits[0] = space.options.index(option)
        unmodelled = self._unmodelled(option)
        explorer = Explorer(samples, limits, speeds, ARRAYS | figures, self.template is not None)
        criteria = tuple(need for need in self.needs if need.what == "criterion")
        design = space.study.design
        is_active = design is not None and design.search.method == "active"
        variables = dict(enumerate(space.variables))
        idle = [
            number
            for number, variable in variables.items()
            if variable.key == OPTION or not acts_on(variable.key, option)
        ]
        linear = [
            number
            for number, variable in variables.items()
            if number not in idle and not variable.takes_words
        ]
        forms = _closed_forms(space, option)
        if criteria or is_active:
            linear, forms = [], ()
        template = None if self.template is None else self.template.of_option(option)
        return OptionEngine(
            explorer,
            contraction,
            self.needs,
            tuple(linear),
            tuple(idle),
            forms,
            Scores(space, option, criteria, self.sound_paths),
            self.gains,
            unmodelled,
            template,
        )

    def _unmodelled(self, option: str) -> tuple[Array | None, ...]:
        """Unmodelled noise by speed, shape (pair, receiver, band), Pa²; none if not asked for."""
        if not any(need in HEARING for need in self.needs):
            return (None,) * len(self.gains)
        return tuple(np.moveaxis(self.machine.unmodelled(option).thirds, 1, 0))


def _closed_forms(space: Space, option: str) -> tuple[Basis, ...]:
    """Closed forms of an option, or of those that it joins, of variables that are its values."""
    joined = space.study.options[option]
    machine = joined.applied_to(space.study.machine)
    members = members_by_name(option, joined).items()
    return tuple(form for member in members for form in _closed_form(space, *member, machine))


def _closed_form(space: Space, option: str, member: Option, machine: Machine) -> tuple[Basis, ...]:
    form = CLOSED_FORMS.get(member.kind)
    if form is None:
        return ()
    columns = {
        si_key(variable.key.removeprefix(f"options.{option}."))[0]: number
        for number, variable in enumerate(space.variables)
        if variable.key.startswith(f"options.{option}.")
    }
    of_form = {field: columns[field] for field in form.fields if field in columns}
    if not of_form:
        return ()
    present = {field: getattr(member, field) for field in form.fields}

    def functions(values: Array, speed_rpm: float) -> Array:
        def of_design(row: Array) -> Array:
            changed = dict(zip(of_form, row.tolist(), strict=True))
            return form().functions({**present, **changed}, machine, speed_rpm)

        return of_many(of_design, values, form.size)

    return (Basis("a closed form", tuple(of_form.values()), functions, form.size, True),)
