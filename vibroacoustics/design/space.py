"""The design space: designs as rows of numbers in SI, and each of them as a study."""

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final

import numpy as np
from pydantic import BaseModel, ValidationError
from scipy.stats import qmc

from ..base.arrays import Array
from ..base.errors import ParameterError
from ..base.units import si_key
from ..base.vocabulary import REFERENCE_OPTION
from ..machine.combination import joined_names
from ..study.design import DesignVariable
from ..study.study import Study
from .keys import acts_on, check_key
from .variable import Variable, variable_of


def is_plain(study: Study, keys: list[str]) -> bool:
    """Whether values of these dotted keys stand in fields of their own alone."""
    redesigned = any(option.changes_machine for option in study.options.values())
    return all(_is_field(study, key, redesigned) for key in keys)


def _is_field(study: Study, key: str, redesigned: bool) -> bool:
    first, *tables, last = key.split(".")
    thing: Any = getattr(study, first)
    for name in tables:
        thing = thing.get(name) if isinstance(thing, dict) else getattr(thing, name, None)
    if first == "machine" and redesigned:
        return False
    value = getattr(thing, si_key(last)[0], None)
    return isinstance(thing, BaseModel) and isinstance(value, int | float)


def changed(study: Study, values: Mapping[str, float | int]) -> Study:
    """The study with other numbers; see `is_plain`.

    Raises
    ------
    ParameterError
        A class refuses them, in its own words.
    """
    machine: dict[str, Any] = {}
    others: dict[str, dict[str, Any]] = {"options": {}, "sources": {}}
    for key, value in values.items():
        first, *tables, last = key.split(".")
        field, factor = si_key(last)
        in_si = value if factor == 1.0 else value * factor
        if first == "machine":
            _put(machine, [*tables, field], in_si)
        else:
            others[first].setdefault(tables[0], {})[field] = in_si
    try:
        update: dict[str, Any] = {
            name: {**(present := getattr(study, name)),
                   **{key: _validated(present[key], fields) for key, fields in new.items()}}
            for name, new in others.items()
        }  # fmt: skip
        update["machine"] = _validated(study.machine, machine) if machine else study.machine
        return Study.model_validate({**dict(iter(study)), **update})
    except ValidationError as error:
        raise ParameterError(str(error.errors()[0]["msg"])) from None


def _put(table: dict[str, Any], keys: list[str], value: Any) -> None:
    for key in keys[:-1]:
        table = table.setdefault(key, {})
    table[keys[-1]] = value


def _validated(table: BaseModel, fields: Mapping[str, Any]) -> BaseModel:
    """A table with other values, also in its tables."""
    inner = {
        name: _validated(getattr(table, name), value) if isinstance(value, dict) else value
        for name, value in fields.items()
    }
    return type(table).model_validate({**dict(iter(table)), **inner})


OPTION: Final = "option"
"""Name of the variable that chooses among options; its values are their numbers."""
_RANDOM: Final = 11


@dataclass(frozen=True)
class Space:
    """Designs of a study.

    Attributes
    ----------
    study : study with the options that designs choose among, and `none`
    options : their names
    variables : variables in the order of the columns of designs; first the choice among options,
        where there is one
    """

    study: Study
    options: tuple[str, ...]
    variables: tuple[Variable, ...]

    @classmethod
    def of(cls, study: Study) -> "Space":
        """Return the space of the table `design` of a study.

        Raises
        ------
        ParameterError
            The study has no such table, or an option or a value that it names is none.
        """
        design = study.design
        if design is None:
            raise ParameterError(f"{study.source_file}: design: is missing; name what varies")
        if study.measured is not None and study.measured.sound is not None:
            raise ParameterError(
                f"{study.source_file}: design: measured.sound holds for the machine that was hit; "
                "designs are computed with transfer vectors alone"
            )
        for name in design.option:
            if name not in study.options:
                raise ParameterError(
                    f"{study.source_file}: design.option = {name}: there is no such option; "
                    f"allowed {', '.join(study.options)}"
                )
        variables = [_variable(study, *item, design.option) for item in design.variables.items()]
        if len(design.option) > 1:
            limits = 0.0, len(design.option) - 1.0
            variables.insert(0, Variable(OPTION, "", 1.0, limits, design.option))
        if not variables:
            raise ParameterError(
                f"{study.source_file}: design.variables: name at least one value that varies"
            )
        space = cls(without_others(study, design.option), design.option, tuple(variables))
        space.check_ends(space.limits, "variables")
        return space

    @property
    def names(self) -> list[str]:
        """Keys of the variables."""
        return [variable.key for variable in self.variables]

    @cached_property
    def machine_values(self) -> frozenset[tuple[str, str]]:
        """Tables and fields of the machine whose values designs choose."""
        keys = [key.split(".")[1:] for key in self.names if key.startswith("machine.")]
        return frozenset((".".join(tables), si_key(last)[0]) for *tables, last in keys)

    @cached_property
    def limits(self) -> Array:
        """Lowest and highest values in SI, shape (variable, 2)."""
        return np.array([variable.limits for variable in self.variables]).reshape(-1, 2)

    def option_of(self, design: Array) -> str:
        """Name of the option of a design, shape (variable,)."""
        chooses = len(self.options) > 1
        return self.options[round(float(design[0]))] if chooses else self.options[0]

    def written(self, design: Array) -> dict[str, Any]:
        """Values of a design as a study's file writes them, by dotted key.

        Values of options other than its own are absent.
        """
        option = self.option_of(design)
        return {
            variable.key: variable.written(value)
            for variable, value in zip(self.variables, design.tolist(), strict=True)
            if variable.key != OPTION and acts_on(variable.key, option)
        }

    def study_of(self, design: Array) -> Study:
        """The study of a design, validated as a file is, with its option and `none`."""
        return self._with_its_option(self.study.replace(self.written(design)), design)

    def quick_study_of(self, design: Array) -> Study:
        """Return the study of a design, without reading files where values are plain numbers."""
        if not self._is_plain:
            return self.study_of(design)
        try:
            return self._with_its_option(changed(self.study, self.written(design)), design)
        except ParameterError:
            return self.study_of(design)  # which says why as of a file

    @cached_property
    def _is_plain(self) -> bool:
        return is_plain(self.study, [name for name in self.names if name != OPTION])

    def _with_its_option(self, study: Study, design: Array) -> Study:
        names = dict.fromkeys((REFERENCE_OPTION, self.option_of(design)))
        return study.model_copy(update={"options": {name: study.options[name] for name in names}})

    def axes(self) -> list[Array]:
        """Values of each variable in a grid.

        Raises
        ------
        ParameterError
            A variable has no values for a grid.
        """
        try:
            return [variable.in_grid() for variable in self.variables]
        except ParameterError as error:
            raise ParameterError(f"{self.study.source_file}: {error}") from None

    def sample(self, kind: str, count: int) -> Array:
        """Designs that fill the space evenly, the same at every call, shape (design, variable).

        Parameters
        ----------
        kind : latin-hypercube or sobol
        count : number of designs
        """
        size = len(self.variables)
        if kind == "sobol":
            share = qmc.Sobol(size, rng=_RANDOM).random_base2((count - 1).bit_length())[:count]
        else:
            share = qmc.LatinHypercube(size, rng=_RANDOM).random(count)
        columns = zip(self.variables, share.T, strict=True)
        return np.stack([variable.at_share(column) for variable, column in columns], axis=1)

    def check_ends(self, limits: Array, table: str) -> None:
        """Refuse variables whose ends the study refuses, each with the others as they are given.

        Parameters
        ----------
        limits : limits of the variables, shape (variable, 2), SI
        table : name of the table in `design` that the ends are from
        """
        for variable, ends in zip(self.variables, limits.tolist(), strict=True):
            for value in dict.fromkeys(ends if variable.key != OPTION else ()):
                self._check(variable, value, table)

    def _check(self, variable: Variable, value: float, table: str) -> None:
        values = {variable.key: variable.written(value)}
        try:
            if is_plain(self.study, [variable.key]):
                with suppress(ParameterError):  # said again as of a file
                    changed(self.study, values)
                    return
            self.study.replace(values)
        except ParameterError as error:
            text = str(error).removeprefix("study.replace: ")
            raise ParameterError(
                f"{self.study.source_file}: design.{table}.{variable.key}: {text}"
            ) from None


def _variable(study: Study, key: str, entry: DesignVariable, options: Sequence[str]) -> Variable:
    check_key(key, options, f"{study.source_file}: design.variables.{key}")
    try:
        return variable_of(key, entry)
    except ParameterError as error:
        raise ParameterError(f"{study.source_file}: {error}") from None


def without_others(study: Study, options: Sequence[str]) -> Study:
    """The study without the options that no design has, where the rest can stand without them."""
    kept = {REFERENCE_OPTION, *options, *(n for name in options for n in joined_names(name))}
    try:
        return study.replace({f"options.{n}": None for n in study.options if n not in kept})
    except ParameterError:  # something else names them
        return study
