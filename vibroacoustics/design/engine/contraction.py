"""Loads, paths and bodies of the designs with one option, each computed once and joined."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property, partial
from typing import Any

from pydantic import BaseModel

from ...base.arrays import Array
from ...base.field_reads import watched
from ...base.units import si_key
from ...machine.combination import Combination, members_by_name
from ...machine.machine import Machine
from ...machine.option import Option
from ...mechanics.ports import BodyPort
from ...study.sampling import Sample
from ...study.study import Study
from ..keys import acts_on
from ..space import OPTION, Space, is_plain
from .layout import Layout
from .machine_sample import MachineSample
from .memo import Memo, Result
from .probe import (
    LoadsOfDesign,
    Probe,
    Stand,
    loads_of_design,
    machine_of_design,
    stand_of_design,
)
from .sound_path import PathOfDesign, SoundPaths

Layouts = tuple[Layout, ...]


@dataclass
class Contraction:
    """Loads and paths of designs with one option: their products are the sound.

    Attributes
    ----------
    space : space of the designs
    option : option of all designs
    sound_paths : paths to the microphones
    machine : nominal, or a sample
    """

    space: Space
    option: str
    sound_paths: SoundPaths
    machine: MachineSample
    _paths: dict[Layouts, Memo[PathOfDesign]] = field(default_factory=dict, repr=False)
    _stands: dict[Layouts, Memo[Stand]] = field(default_factory=dict, repr=False)

    @cached_property
    def loads(self) -> Memo[LoadsOfDesign]:
        """Loads of all sources."""
        return self._memo(
            lambda study: loads_of_design(study, self.option, self._sample, self.machine.shared)
        )

    def paths(self, layout: Layouts) -> Memo[PathOfDesign]:
        """Return the paths from where loads act to the microphones."""
        ports = tuple(speed.of_ports for speed in layout)
        if ports not in self._paths:
            self._paths[ports] = self._memo(partial(self._path, layout))
        return self._paths[ports]

    def stands(self, layout: Layouts) -> Memo[Stand]:
        """Return the bodies on their mounts."""
        if layout not in self._stands:
            made = partial(stand_of_design, option=self.option, sample=self._sample, layout=layout)
            self._stands[layout] = self._memo(made)
        return self._stands[layout]

    def probe(self, design: Array) -> Probe:
        """Return loads and body of a design, shape (variable,)."""
        loads = self.loads(design)
        return Probe.of(loads, self.stands(loads.layout)(design))

    @property
    def _sample(self) -> Sample | None:
        machine = self.machine
        return (
            None if machine.deviation is None else dict(machine.without(self.space.machine_values))
        )

    def _path(self, layout: Layouts, study: Study) -> PathOfDesign:
        ports = (port for speed in layout for load in speed.random for port, _ in load.loads)
        with_bodies = any(isinstance(port, BodyPort) for port in ports)
        machine = machine_of_design(study, self.option, self._sample, with_bodies)
        path = self.sound_paths(study).path(machine)
        path.responses(layout)  # so that all that any responses read has been read
        return path

    def _memo(self, compute: Callable[[Study], Result]) -> Memo[Result]:
        names = self.space.names
        unwatched = {names.index(name) for name in self._acting if name not in self._watched}
        return Memo(names, self._study_of, compute, self.sound_paths.budget, frozenset(unwatched))

    @property
    def _acting(self) -> list[str]:
        """Keys of the variables that are values of the machine or of the option."""
        names = self.space.names
        return [name for name in names if name != OPTION and acts_on(name, self.option)]

    @cached_property
    def _watched(self) -> dict[str, tuple[str, ...]]:
        """Tables and fields of values that are plain numbers, by the key of the variable."""
        study, paths = self.space.study, {}
        redesigned = any(option.changes_machine for option in study.options.values())
        for name in self._acting:
            first, *tables, last = name.split(".")
            is_option = first == "options" and len(tables) == 1
            if not (is_option or (first == "machine" and not redesigned)):
                continue
            path = (first, *tables, si_key(last)[0])
            if is_plain(study, [name]) and not any(map(keeps_values, self._owners(path))):
                paths[name] = path
        return paths

    def _owners(self, path: tuple[str, ...]) -> Iterator[BaseModel]:
        """Give the tables through which a value is read."""
        first, *tables, _ = path
        owner: Any = self.space.study.machine
        if first == "options":
            members = members_by_name(self.option, self.space.study.options[self.option])
            owner, tables = members[tables[0]], tables[1:]
        yield owner
        for name in tables:
            owner = getattr(owner, name)
            yield owner

    def _study_of(self, design: Array) -> Study:
        """Study of a design that shows which of the values are read."""
        study = self.space.quick_study_of(design)
        inner: dict[str, dict[tuple[str, ...], str]] = {}
        for name, (first, *path) in self._watched.items():
            inner.setdefault(first, {})[tuple(path)] = name
        chosen = self.space.machine_values
        ranges = [item for item in study.ranges if (item.table, item.field) not in chosen]
        update: dict[str, object] = {"ranges": tuple(ranges)}
        if "machine" in inner:
            update["machine"] = watched(study.machine, inner["machine"])
        if "options" in inner:
            option = study.options[self.option]
            option_watched = _watched_option(self.option, option, inner["options"])
            update["options"] = {**study.options, self.option: option_watched}
        return study.model_copy(update=update)


def keeps_values(table: BaseModel) -> bool:
    """Whether a table may keep values of its fields where no reading of these is seen.

    The private attribute of every machine, its attached bodies, is set by options.
    """
    return bool(set(type(table).__private_attributes__) - set(Machine.__private_attributes__))


def _watched_option(name: str, option: Option, labels: Mapping[tuple[str, ...], str]) -> Option:
    """Watch an option, or the options that a combination joins."""

    def of_member(member: str) -> dict[tuple[str, ...], str]:
        return {path[1:]: label for path, label in labels.items() if path[0] == member}

    parts = members_by_name(name, option).items()
    members = {member: watched(part, of_member(member)) for member, part in parts}
    return option.rejoined(members) if isinstance(option, Combination) else members[name]
