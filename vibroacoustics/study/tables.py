"""Tables of a study, each right alone."""

from typing import Any

from pydantic import Field, field_validator

from ..base.parameters import Parameters
from ..base.units import orders_below
from ..machine.combination import Combination
from ..machine.machine import AnyMachine
from ..machine.option import AnyOption
from ..machine.source import AnySource
from .baseline import MeasuredSound
from .design import Design
from .evidence_files import Evidence
from .machines import BaseFrame, StudyMachine
from .operation import Operation
from .radiation import RadiationSettings
from .rating import Rating
from .receivers import Receiver
from .record import ParameterRecord
from .room import StudyRoom
from .scoring import Scoring
from .sound_power import DirectivitySettings, MapSettings, SoundPowerSettings
from .structure_borne import StructureBorne
from .titles import Titles
from .uncertainty import HeldRange, MeasuredModes, Range, Uncertainty


class StudyTables(Parameters):
    """Tables of a study, not yet checked against one another."""

    title: str = Field(min_length=1)
    machine: AnyMachine
    operation: Operation
    options: dict[str, AnyOption]
    receivers: dict[str, Receiver] = Field(min_length=1)
    catalogue_receiver: str = ""
    """Receiver of the machine's published level; the first where the study names none."""
    catalogue_point: str | None = None
    """Operating point of the machine's file at which its overall noise holds; none for the values
    of the study."""
    catalogue_machine: AnyMachine | None = None
    """Machine at that point; none where it is the study's. Filled in by `load_study`."""
    radiation: RadiationSettings
    scoring: Scoring
    given: dict[str, dict[str, float]] = Field(default={})
    """Values of criteria that are judged, not computed, by option and criterion."""
    titles: Titles = Titles()
    """Titles in reports in place of names."""
    evidence: Evidence = Evidence()
    """Published values beside which the report sets the results."""
    sound_power: SoundPowerSettings | None = None
    map: MapSettings | None = None
    directivity: DirectivitySettings | None = None
    structure_borne: StructureBorne | None = None
    """Plate under the feet whose structure-borne sound is computed."""
    room: StudyRoom | None = None
    """Room into which the machine is put, with listeners."""
    rating: Rating | None = None
    """Windows at which the sound is rated."""
    machines: dict[str, StudyMachine] = Field(default_factory=dict)
    """Several machines that run at the same time, each an ordinary study of its own."""
    common_receivers: dict[str, Receiver] = Field(default_factory=dict)
    """Microphones at which they are heard together, about the origin of their positions."""
    base_frame: BaseFrame | None = None
    """Frame on which they all stand; the floor where there is none."""
    sources: dict[str, AnySource] = Field(default_factory=dict)
    """Sources that drive the machine beside its moving parts."""
    uncertainty: Uncertainty = Uncertainty()
    shell_modes: MeasuredModes | None = None
    """Measured modes of the shell, in place of the computed ones."""
    ranges: tuple[Range, ...] = ()
    """Ranges of the machine's values that are sampled at random."""
    held_ranges: tuple[HeldRange, ...] = ()
    """Ranges of the values that are not sampled, with the reason."""
    design: Design | None = None
    """Variables of a sweep or a search; a run takes the nominal options."""
    measured: MeasuredSound | None = None
    """Measured sound of the machine, in place of its published level."""
    records: tuple[ParameterRecord, ...] = ()
    coarsened: tuple[str, ...] = ()
    """Settings that were made coarser for a first look, and the error that is expected."""
    left_out: tuple[str, ...] = Field(default=(), exclude=True)
    """A line on what runs without: what failed when the study was read, sources not wanted."""
    source_file: str = ""

    @field_validator("options", "receivers", "machines", "common_receivers")
    @classmethod
    def _named(cls, names: dict[str, Any]) -> dict[str, Any]:
        if not all(name.strip() for name in names):
            raise ValueError("a name is blank")
        return names

    @field_validator("options")
    @classmethod
    def _rejoined(cls, options: dict[str, Any]) -> dict[str, Any]:
        """Give combinations the present values of the options that they join."""
        return {
            name: option.rejoined(options) if isinstance(option, Combination) else option
            for name, option in options.items()
        }

    @property
    def catalogue_speed_rpm(self) -> float:
        """Speed of the machine's overall noise; the first one where its file gives none."""
        published = self.machine.overall_noise
        return self.operation.speed_rpm[0] if published is None else published.speed_rpm

    def highest_order(self, speed_rpm: float) -> int:
        """The highest shaft order that is taken along at a speed."""
        if self.operation.maximum_order is not None:
            return self.operation.maximum_order
        return orders_below(self.radiation.maximum_frequency_hz, speed_rpm)

    @property
    def drives_shell(self) -> bool:
        """Whether a source loads the joints of an elastic shell."""
        return any(source.drives_shell for source in self.sources.values())
