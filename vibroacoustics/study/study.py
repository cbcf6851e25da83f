"""A study: one machine, its operating points, options, microphones and scoring."""

from collections.abc import Callable, Mapping, Sequence
from copy import deepcopy
from typing import Any, Final, NamedTuple

from pydantic import model_validator

from ..base.errors import ParameterError
from ..base.vocabulary import REFERENCE_OPTION
from ..machine.option import Option
from ..machine.source import CaseKey
from .baseline import Baseline
from .consistency import check_consistent
from .replacing import replaced
from .summary import html_of, study_lines
from .tables import StudyTables
from .toml_files import Written

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
