"""A study: one machine, its operating points, options, microphones; values replaced in Python."""

from collections.abc import Callable, Mapping, Sequence
from copy import deepcopy
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np
from pydantic import model_validator

from ..base.errors import ParameterError
from ..base.vocabulary import REFERENCE_OPTION
from ..machine.option import Option
from ..machine.source import CaseKey
from .baseline import Baseline
from .consistency import check_consistent
from .reader import is_number
from .summary import html_of, study_lines
from .tables import StudyTables
from .toml_files import Written, is_table, leaves, merge

FILE: Final = Path("study.replace")
"""Stands in refusals and records for a file; names of files count from the working folder."""
SOURCE: Final = "replaced in Python"
_MACHINE: Final = ("machine", "override")


def replaced(written: Written, values: Mapping[str, Any]) -> Written:
    """Return what a study's file would say with other values.

    Parameters
    ----------
    written : content of the study's file
    values : value or table by dotted key, with units as in a file; None takes a table or value out

    Raises
    ------
    ParameterError
        A key is no text, or what is to be taken out is not there.
    """
    changes: dict[str, Any] = {}
    content = deepcopy(written.content)
    for dotted, value in values.items():
        if not isinstance(dotted, str) or not all(dotted.split(".")):
            raise ParameterError(f"{FILE}: {dotted!r}: must be a dotted key")
        keys = _keys(dotted)
        if value is None:
            _take_out(content, keys)
            continue
        in_machine = keys[: len(_MACHINE)] == _MACHINE
        _put(changes, keys, _as_in_file(value, in_machine))
    origin = written.origin | dict.fromkeys(leaves(changes), FILE)
    return Written(written.path, merge(content, changes), origin)


def _keys(dotted: str) -> tuple[str, ...]:
    """Keys in the study's file; values of the machine are in its table `machine.override`."""
    first, *further = dotted.split(".")
    inner = first == "machine" and further[:1] not in (
        ["file"],
        ["title"],
        ["override"],
        ["without"],
    )
    return (*_MACHINE, *further) if inner else (first, *further)


def _put(changes: dict[str, Any], keys: tuple[str, ...], value: Any) -> None:
    table = changes
    for key in keys[:-1]:
        table = table.setdefault(key, {})
    if is_table(table.get(keys[-1])) and is_table(value):
        value = merge(table[keys[-1]], value)
    table[keys[-1]] = value


def _take_out(content: dict[str, Any], keys: tuple[str, ...]) -> None:
    table: Any = content
    for key in keys[:-1]:
        table = table.get(key) if isinstance(table, dict) else None
    if not isinstance(table, dict) or keys[-1] not in table:
        raise ParameterError(f"{FILE}: {'.'.join(keys)} = None: there is none to take out")
    del table[keys[-1]]


def _as_in_file(value: Any, with_source: bool) -> Any:
    """A value as TOML would hold it; a number of the machine gets a source, which it needs."""
    if isinstance(value, Mapping):
        is_value = "value" in value
        return {str(key): _as_in_file(v, with_source and not is_value) for key, v in value.items()}
    if isinstance(value, np.generic | np.ndarray):
        value = value.tolist()
    if isinstance(value, tuple | list):
        return [_as_in_file(item, False) for item in value]
    if with_source and is_number(value):
        return {"value": value, "source": SOURCE}
    return str(value) if isinstance(value, Path) else value


AT_CATALOGUE_POINT: Final = "none at the catalogue's point"
"""Name of the case without a balancer at the operating point of the overall noise."""


class AsRead(NamedTuple):
    """Content of a study's file; `loading`, which is above, makes a study of it.

    Attributes
    ----------
    written : by the file
    study_of : makes a study of it
    """

    written: Written
    study_of: Callable[[Written], "Study"]


class Study(StudyTables):
    """One machine, its operating points, options, microphones and scoring: what `run` computes.

    From `load_study`; frozen, in SI units, with the unit in the name of each value.

    Examples
    --------
    >>> study = va.load_study("pipelines/copeland_thesis.toml")
    >>> study.operation.speed_rpm
    (2900.0, 3500.0)
    >>> study.replace({"operation.speed_rpm": [2900.0]}).operation.speed_rpm
    (2900.0,)
    """

    __slots__ = ("_read",)

    @model_validator(mode="after")
    def _consistent(self) -> "Study":
        check_consistent(self)
        return self

    def __repr__(self) -> str:
        return "\n".join(study_lines(self))

    __str__ = __repr__

    def _repr_html_(self) -> str:
        return html_of(study_lines(self))

    @property
    def catalogue_case(self) -> CaseKey:
        """Speed and name of the case whose level the overall noise is."""
        elsewhere = self.catalogue_machine is not None
        name = AT_CATALOGUE_POINT if elsewhere else REFERENCE_OPTION
        return self.catalogue_speed_rpm, name

    @property
    def baseline(self) -> Baseline | None:
        """Measured levels of the machine without an option, where there are some."""
        return None if self.measured is None else self.measured.baseline

    def option_of(self, case: CaseKey) -> Option:
        """Option of a case: the reference at the point of the overall noise too."""
        name = REFERENCE_OPTION if case[1] == AT_CATALOGUE_POINT else case[1]
        return self.options[name]

    def replace(self, values: Mapping[str, Any]) -> "Study":
        """The study with other values, validated as a study file is validated.

        Parameters
        ----------
        values : value by dotted key, as a study file writes it: with the unit in the key, which
            need not be the one of the file; a table in place of a value is merged into the study's;
            None takes a value or a table out. `machine.` leads to the machine's values: a number,
            or `{"value": …, "source": …, "range": […]}`

        Raises
        ------
        ParameterError
            See `load_study`; or the study was not read from a file, or changed by `model_copy`.

        Examples
        --------
        >>> study = va.load_study("pipelines/copeland_thesis.toml")
        >>> changed = study.replace({
        ...     "operation.speed_rpm": [2900.0],
        ...     "options.pendulum-side.length_mm": 30.0,
        ...     "options.twin-oldham": None,
        ...     "machine.mounts.vertical_stiffness_n_per_mm": 40.0,
        ... })
        >>> changed.options["pendulum-side"].length_m
        0.03
        >>> study.replace({"operation.speed_rpm": [10.0]})
        Traceback (most recent call last):
            ...
        vibroacoustics.base.errors.ParameterError: ...speed_rpm = 10 rpm: allowed 60 to 60000 rpm
        """
        written, study_of = self._as_read()
        return study_of(replaced(written, values)).leaving_out(self.left_out)

    def as_written(self) -> dict[str, Any]:
        """Return what its file says, with those that it extends; numbers and units as there."""
        return deepcopy(self._as_read().written.content)

    def _as_read(self) -> AsRead:
        read: AsRead | None = getattr(self, "_read", None)
        if read is None:
            raise ParameterError("study: was not read by load_study; load it, then replace values")
        return read

    def remember(self, written: Written, study_of: Callable[[Written], "Study"]) -> "Study":
        """The study itself, which remembers what its file says and who read it; copies do not."""
        object.__setattr__(self, "_read", AsRead(written, study_of))
        return self

    def marked_coarse(self, words: tuple[str, ...]) -> "Study":
        """The study, with what was made coarser in it."""
        return self._marked(coarsened=words)

    def leaving_out(self, lines: Sequence[str]) -> "Study":
        """Return the study with further lines on what it runs without."""
        further = tuple(line for line in lines if line not in self.left_out)
        return self._marked(left_out=(*self.left_out, *further)) if further else self

    def _marked(self, **fields: tuple[str, ...]) -> "Study":
        marked = self.model_copy(update=fields)
        read: AsRead | None = getattr(self, "_read", None)
        return marked if read is None else marked.remember(*read)

    def parameters(self) -> dict[str, Any]:
        """All parameters as plain JSON values."""
        return self.model_dump(mode="json")
