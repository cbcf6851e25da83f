"""Uncertainty: ranges of values, and how many sets of values are sampled from them."""

from pydantic import Field

from ..base.parameters import Parameters


class Range(Parameters):
    """Range of one value of the machine, in SI."""

    table: str
    """Dotted, from the machine."""
    field: str
    lowest: float
    highest: float
    integer: bool = False
    """Whether it is a whole number."""
    independent_of: tuple[str, ...] = ()
    """Sampled values that this one would follow from if its file gave it no range."""

    @property
    def name(self) -> str:
        """Dotted name of the value, from the machine."""
        return f"{self.table}.{self.field}"


class HeldRange(Range):
    """Range of a value that is not sampled, and why."""

    reason: str


class Uncertainty(Parameters):
    """Random samples of values, and the model discrepancy: standard deviations of levels.

    A sample's discrepancy is common to all options, speeds and microphones.
    """

    random_samples: int = Field(default=24, ge=4, le=1000)
    seed: int = Field(default=6, ge=0, lt=2**63)
    path_deviation_db: float = Field(default=8.0, ge=0.0, le=30.0)
    """Deviation that is common to all sources."""
    source_deviation_db: float = Field(default=5.0, ge=0.0, le=30.0)
    """Deviation of each source."""
    band_deviation_db: float = Field(default=6.0, ge=0.0, le=30.0)
    """Deviation of each third octave of a source; the correlation falls as exp(-octaves)."""
    added_deviation_db: float = Field(default=8.0, ge=0.0, le=30.0)
    """Deviation of what an option adds to the sound of a source."""


class MeasuredModes(Parameters):
    """Modes of the shell from a universal file (dataset 55), in place of the computed ones."""

    file: str = Field(min_length=1)
    """File, in a study relative to the study's folder; positions are about the centre of mass, z
    up."""
    file_unit_m: float | None = Field(default=None, gt=0.0, le=1.0)
    """Length of the unit of the places; none where the file itself states it (dataset 164)."""
