"""A study: one machine, its operating points, options, microphones and scoring."""

from collections.abc import Mapping
from copy import deepcopy
from typing import Annotated, Any, Final

from pydantic import Field, WithJsonSchema, field_validator, model_validator

from ..base.errors import ParameterError
from ..base.parameters import Parameters
from ..base.units import orders_below, shaft_frequency_hz
from ..base.vocabulary import REFERENCE_OPTION
from ..machine.frame import Frame
from ..machine.machine import AnyMachine
from ..machine.option import AnyOption, Option
from ..machine.shell_structure import ShellStructure, ShellVariation
from ..machine.source import AnySource, CaseKey
from ..machine.stopping import Stopping
from ..machine.turning_back import TurningBack
from ..mechanics.loads import DISCHARGE_DOME, SUCTION_ANNULUS
from .baseline import MeasuredSound
from .design import Design
from .evidence import Evidence
from .radiation import RadiationSettings
from .receivers import Receiver
from .scoring import Scoring, check_given, check_scales
from .sound_power import DirectivitySettings, MapSettings, SoundPowerSettings
from .speeds import MOST_SPEEDS, speed_range
from .structure_borne import StructureBorne
from .titles import Titles
from .toml_files import Written
from .uncertainty import HeldRange, MeasuredModes, Range, Uncertainty

MOST_SPEEDS_WITH_TIME_SERIES: Final = 100
LEAST_ORDERS: Final = 2
"""Which every result holds."""
ROUNDING: Final = 1e-9
AT_CATALOGUE_POINT: Final = "none at the catalogue's point"
"""Name of the case without a balancer at the operating point of the overall noise."""


# Limits for the schema of files; `Operation` refuses them in words of its own.
_SHOWN_SPEED = WithJsonSchema({"type": "number", "minimum": 60.0, "maximum": 60000.0})
_SHOWN_SUPPLY = WithJsonSchema({"type": "number", "minimum": 1.0, "maximum": 1000.0})


class Operation(Parameters):
    speed_rpm: tuple[Annotated[float, _SHOWN_SPEED], ...] = Field(
        min_length=1, max_length=MOST_SPEEDS
    )
    """In a file also a table of start, stop and step."""
    crank_angle_samples: int = Field(default=256, ge=64, le=65536)
    maximum_order: int | None = Field(default=None, ge=2, le=1000)
    """None for as many at each speed as the highest frequency of the radiation holds."""
    keep_time_series: bool | None = None
    """Forces and moments over crank angle in the results; none for up to 100 speeds only."""
    supply_frequency_hz: tuple[Annotated[float, _SHOWN_SUPPLY], ...] | None = None
    """Of the motor's supply, one for each speed; where a source needs it."""
    point: str | None = None
    """Operating point of the machine's file, whose values hold; none for the machine's as given."""
    stopping: bool = False
    """Whether a stop from each speed is computed, where the machine has a table of that name."""
    turning_back: bool = False
    """Whether stops go on where trapped gas turns the shaft back, through the elastic shell too."""

    @field_validator("speed_rpm", mode="before")
    @classmethod
    def _range(cls, given: Any) -> Any:
        if isinstance(given, dict):
            return speed_range(given)
        return tuple(given) if isinstance(given, list) else given

    @model_validator(mode="after")
    def _speeds(self) -> "Operation":
        for speed in self.speed_rpm:
            if not 60.0 <= speed <= 60000.0:
                raise ValueError(f"speed_rpm = {speed:g} rpm: allowed 60 to 60000 rpm")
        if len(set(self.speed_rpm)) < len(self.speed_rpm):
            raise ValueError("speed_rpm lists a speed twice")
        supply = self.supply_frequency_hz
        if supply is not None and len(supply) != len(self.speed_rpm):
            raise ValueError(
                f"supply_frequency_hz: {len(supply)} values for {len(self.speed_rpm)} speeds; one "
                "is needed for each"
            )
        for frequency in supply or ():
            if not 1.0 <= frequency <= 1e3:
                raise ValueError(f"supply_frequency_hz = {frequency:g} Hz: allowed 1 to 1000 Hz")
        return self

    @property
    def keeps_time_series(self) -> bool:
        """Whether the results hold forces and moments over crank angle."""
        few = len(self.speed_rpm) <= MOST_SPEEDS_WITH_TIME_SERIES
        return few if self.keep_time_series is None else self.keep_time_series


class ParameterRecord(Parameters):
    """Where a value comes from: one row of the assumptions table."""

    file: str
    field: str
    value: str
    unit: str
    source: str
    lowest: float | None = None
    highest: float | None = None

    @property
    def assumed(self) -> bool:
        return self.source.startswith("assumed")


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
    catalogue_receiver: str
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
        reference = self.options.get(REFERENCE_OPTION)
        if reference is None or reference.kind != REFERENCE_OPTION:
            raise ValueError('options: an option named none with kind = "none" is required')
        for name, option in self.options.items():
            self._check_fits(name, option)
        check_given(self.given, self.options)
        check_scales(self.scoring, self.given, self.options)
        if self.catalogue_receiver not in self.receivers:
            raise ValueError(
                f"catalogue_receiver = {self.catalogue_receiver}: not among the receivers "
                f"({', '.join(self.receivers)})"
            )
        microphone = self.receivers[self.catalogue_receiver]
        distance = self.machine.shell.distance_m(
            microphone.x_m, microphone.y_m, microphone.height_m
        )
        published = self.machine.overall_noise
        if not 0.95 <= distance / published.distance_m <= 1.05:
            raise ValueError(
                f"catalogue_receiver = {self.catalogue_receiver}: stands {distance:.3g} m from the "
                f"shell; the overall noise holds at {published.distance_m:g} m"
            )
        if self.measured is not None:
            for problem in self.measured.problems(list(self.receivers), self.operation.speed_rpm):
                raise ValueError(problem)
        self._check_orders()
        self._check_sources()
        surroundings = self.radiation.surroundings
        if self.sound_power and (
            surroundings.walls or surroundings.cabinet or surroundings.is_outdoors
        ):
            raise ValueError(
                "sound_power: ISO 3744 measures over a hard floor alone; radiation.surroundings "
                f"has {'ground or a barrier' if surroundings.is_outdoors else 'walls or a cabinet'}"
            )
        return self

    @property
    def catalogue_case(self) -> CaseKey:
        """Speed and name of the case whose level the overall noise is."""
        elsewhere = self.catalogue_machine is not None
        name = AT_CATALOGUE_POINT if elsewhere else REFERENCE_OPTION
        return self.machine.overall_noise.speed_rpm, name

    def option_of(self, case: CaseKey) -> Option:
        """Option of a case: the reference at the point of the overall noise too."""
        name = REFERENCE_OPTION if case[1] == AT_CATALOGUE_POINT else case[1]
        return self.options[name]

    def highest_order(self, speed_rpm: float) -> int:
        """The highest shaft order that is taken along at a speed."""
        if self.operation.maximum_order is not None:
            return self.operation.maximum_order
        return orders_below(self.radiation.maximum_frequency_hz, speed_rpm)

    def _check_orders(self) -> None:
        """Refuse more orders than the radiation or the crank angles can tell apart."""
        speeds = {*self.operation.speed_rpm, self.machine.overall_noise.speed_rpm}
        fastest, slowest = max(speeds), min(speeds)
        orders, samples = self.highest_order(slowest), self.operation.crank_angle_samples
        if 2 * orders >= samples:
            given = self.operation.maximum_order is not None
            twice = f"maximum_order = {orders}" if given else f"{orders} orders at {slowest:g} rpm"
            raise ValueError(
                f"operation.crank_angle_samples = {samples}: must be above {2 * orders}, "
                f"twice {twice}"
            )
        order = max(self.highest_order(fastest), LEAST_ORDERS)
        highest, allowed = order * shaft_frequency_hz(fastest), self.radiation.maximum_frequency_hz
        if highest > allowed * (1.0 + ROUNDING):
            raise ValueError(
                f"radiation.maximum_frequency_hz = {allowed:g} Hz: order {order} reaches "
                f"{highest:g} Hz; raise it, or lower operation.maximum_order"
            )

    def _check_sources(self) -> None:
        """Refuse sources that the machine, or what an option makes of it, cannot have."""
        if "moving_parts" in self.sources:
            raise ValueError("sources.moving_parts: are always there; choose another name")
        changed = {
            f"options.{name}.change: ": option.applied_to(self.machine)
            for name, option in self.options.items()
            if option.applied_to(self.machine) is not self.machine
        }
        for name, source in self.sources.items():
            for where, machine in {"": self.machine, **changed}.items():
                if reason := source.why_not(machine):
                    raise ValueError(f"{where}sources.{name}.kind = {source.kind}: {reason}")
        published, operation = self.machine.overall_noise.speed_rpm, self.operation
        if operation.supply_frequency_hz and published not in operation.speed_rpm:
            raise ValueError(
                "operation.speed_rpm: must include the speed of the overall noise, "
                f"{published:g} rpm, whose supply_frequency_hz is not known otherwise"
            )
        twice = 2.0 * max(self.operation.supply_frequency_hz or (0.0,))
        if self.sources and twice > self.radiation.maximum_frequency_hz:
            raise ValueError(
                f"radiation.maximum_frequency_hz = {self.radiation.maximum_frequency_hz:g} Hz: "
                f"twice the supply frequency is {twice:g} Hz"
            )
        bends = self.machine.has_table(ShellStructure) and self.machine.has_table(ShellVariation)
        if self.drives_shell and not bends:
            raise ValueError(
                "sources: drive an elastic shell; the machine has no tables structure and variation"
            )
        if self.drives_shell and self.shell_modes is not None and self.machine.has_table(Frame):
            raise ValueError(
                "shell_modes: measured modes do not hold the wall's flexibility at the welds of a "
                'frame; leave it out: machine.without = ["frame"]'
            )
        if self.shell_modes is not None and self._gas_flows_into():
            raise ValueError(
                "shell_modes: measured modes do not tell what gas in the shell does to its wall; "
                f"leave the gas out: machine.without = {self._gas_flows_into()}"
            )
        if self.operation.stopping and not self.machine.has_table(Stopping):
            raise ValueError("operation.stopping: the machine has no table stopping")
        self._check_turning_back()

    def _check_turning_back(self) -> None:
        if not self.operation.turning_back:
            return
        if not self.operation.stopping:
            raise ValueError("operation.turning_back: needs operation.stopping = true")
        if not self.machine.has_table(TurningBack):
            raise ValueError("operation.turning_back: the machine has no table turning_back")

    def _gas_flows_into(self) -> list[str]:
        read = {name for one in self.sources.values() for name in one.tables_read(self.machine)}
        return sorted(read & {DISCHARGE_DOME, SUCTION_ANNULUS})

    @property
    def drives_shell(self) -> bool:
        """Whether a source loads the joints of an elastic shell."""
        return any(source.drives_shell for source in self.sources.values())

    def _check_fits(self, name: str, option: Option) -> None:
        """Refuse an option that the machine has no part for, or that changes what all share."""
        needed = option.needs
        if needed is not None and self.machine.capability(needed) is None:
            raise ValueError(
                f"options.{name}.kind = {option.kind}: needs {needed.words}; the machine is "
                f"{self.machine.kind}"
            )
        changed = option.applied_to(self.machine)
        for table in ("shell", "overall_noise"):
            if getattr(changed, table) != getattr(self.machine, table):
                raise ValueError(
                    f"options.{name}.change.{table}: all options radiate from one shell and share "
                    "one overall noise; make a study of its own"
                )

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
