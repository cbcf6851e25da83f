"""A study: one machine, its operating points, options, microphones and scoring."""

from collections.abc import Mapping
from copy import deepcopy
from typing import Any, Final

from pydantic import Field, field_validator, model_validator

from ..base.errors import ParameterError
from ..base.parameters import Parameters
from ..base.units import orders_below
from ..base.vocabulary import REFERENCE_OPTION
from ..machine.machine import AnyMachine
from ..machine.option import AnyOption, Option
from ..machine.source import AnySource, CaseKey
from .baseline import MeasuredSound
from .consistency import check_consistent
from .design import Design
from .evidence import Evidence
from .operation import Operation
from .radiation import RadiationSettings
from .receivers import Receiver
from .record import ParameterRecord
from .room import StudyRoom
from .scoring import Scoring
from .sound_power import DirectivitySettings, MapSettings, SoundPowerSettings
from .structure_borne import StructureBorne
from .titles import Titles
from .toml_files import Written
from .uncertainty import HeldRange, MeasuredModes, Range, Uncertainty

AT_CATALOGUE_POINT: Final = "none at the catalogue's point"
"""Name of the case without a balancer at the operating point of the overall noise."""


class Study(Parameters):
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

    __slots__ = ("_written",)

    title: str = Field(min_length=1)
    machine: AnyMachine
    operation: Operation
    options: dict[str, AnyOption]
    receivers: dict[str, Receiver] = Field(min_length=1)
    catalogue_receiver: str = ""
    """Of the machine's overall noise; the first where the machine's file gives none."""
    catalogue_point: str | None = None
    """Operating point of the machine's file at which its overall noise holds; none for the values
    of the study."""
    catalogue_machine: AnyMachine | None = None
    """At that point; none where it is the study's. Filled in by `load_study`."""
    radiation: RadiationSettings
    scoring: Scoring
    given: dict[str, dict[str, float]] = Field(default={})
    """Values of criteria that are judged, not computed, by option and criterion."""
    titles: Titles = Titles()
    """What reports show in place of names."""
    evidence: Evidence = Evidence()
    """Published values beside which the report sets the results."""
    sound_power: SoundPowerSettings | None = None
    map: MapSettings | None = None
    directivity: DirectivitySettings | None = None
    structure_borne: StructureBorne | None = None
    """Plate under the feet whose sound is computed beside that by air."""
    room: StudyRoom | None = None
    """Room into which the machine is put, with listeners."""
    sources: dict[str, AnySource] = Field(default_factory=dict)
    """Who drives the machine beside its moving parts."""
    uncertainty: Uncertainty = Uncertainty()
    shell_modes: MeasuredModes | None = None
    """Measured modes of the shell, in place of the computed ones."""
    ranges: tuple[Range, ...] = ()
    """Of the machine's values that are drawn at random."""
    held_ranges: tuple[HeldRange, ...] = ()
    """Of those that are not, with the reason."""
    design: Design | None = None
    """What a sweep or a search varies; a run takes the options as they are given."""
    measured: MeasuredSound | None = None
    """What was measured of the machine's sound, in place of its overall noise."""
    records: tuple[ParameterRecord, ...] = ()
    coarsened: tuple[str, ...] = ()
    """What was made coarser for a first look, and the error that is expected."""
    source_file: str = ""

    @field_validator("options", "receivers")
    @classmethod
    def _named(cls, given: dict[str, Any]) -> dict[str, Any]:
        if not all(name.strip() for name in given):
            raise ValueError("a name is blank")
        return given

    @model_validator(mode="after")
    def _consistent(self) -> "Study":
        check_consistent(self)
        return self

    @property
    def catalogue_case(self) -> CaseKey:
        """Speed and name of the case whose level the overall noise is."""
        elsewhere = self.catalogue_machine is not None
        name = AT_CATALOGUE_POINT if elsewhere else REFERENCE_OPTION
        return self.catalogue_speed_rpm, name

    @property
    def catalogue_speed_rpm(self) -> float:
        """Speed of the machine's overall noise; the first one where its file gives none."""
        published = self.machine.overall_noise
        return self.operation.speed_rpm[0] if published is None else published.speed_rpm

    def option_of(self, case: CaseKey) -> Option:
        """Option of a case: the reference at the point of the overall noise too."""
        name = REFERENCE_OPTION if case[1] == AT_CATALOGUE_POINT else case[1]
        return self.options[name]

    def highest_order(self, speed_rpm: float) -> int:
        """The highest shaft order that is taken along at a speed."""
        if self.operation.maximum_order is not None:
            return self.operation.maximum_order
        return orders_below(self.radiation.maximum_frequency_hz, speed_rpm)

    @property
    def drives_shell(self) -> bool:
        """Whether a source loads the joints of an elastic shell."""
        return any(source.drives_shell for source in self.sources.values())

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
            As `load_study`; or the study was not read from a file, or changed by `model_copy`.

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
        from .loading import study_of
        from .replacing import replaced

        return study_of(replaced(self._as_read(), values))

    def as_written(self) -> dict[str, Any]:
        """What its file says, with those that it extends; numbers as there, in their units."""
        return deepcopy(self._as_read().content)

    def _as_read(self) -> Written:
        written: Written | None = getattr(self, "_written", None)
        if written is None:
            raise ParameterError("study: was not read by load_study; load it, then replace values")
        return written

    def remember(self, written: Written) -> "Study":
        """The study itself, which remembers what its file says; copies do not."""
        object.__setattr__(self, "_written", written)
        return self

    def marked_coarse(self, words: tuple[str, ...]) -> "Study":
        """The study, with what was made coarser in it."""
        marked = self.model_copy(update={"coarsened": words})
        written: Written | None = getattr(self, "_written", None)
        return marked if written is None else marked.remember(written)

    def parameters(self) -> dict[str, Any]:
        """All parameters as plain JSON values."""
        return self.model_dump(mode="json")
