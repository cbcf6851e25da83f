"""What acts inside a scroll compressor: gas, keys, motor, and the elastic shell that they drive."""

from typing import Final

from pydantic import Field, model_validator

from ..base.parameters import Parameters
from ..mechanics.scroll_shaft import ScrollShaft
from .induction_motor import CapacitorMotor
from .oldham_keys import OldhamKeys
from .run_down import Stopping
from .scroll_gas import ScrollGas, ScrollWraps
from .shell_structure import ShellStructure

DRAWN: Final = frozenset(
    {
        ("gas", "polytropic_index"),
        ("gas", "equalisation_angle_rad"),
        ("keys", "clearance_m"),
        ("keys", "contact_stiffness_n_per_m1p5"),
        ("keys", "restitution_ratio"),
        ("keys", "film_damping_ns_per_m"),
        ("keys", "friction_ratio"),
        ("keys", "scroll_inertia_kg_m2"),
        ("motor", "capacitance_f"),
        ("shell", "loss_factor_ratio"),
        ("doubt", "mobility_change_db"),
        ("doubt", "frequency_factor_ratio"),
    }
)
"""Tables and fields that are drawn from their range; the others change the shell's modes."""


class Rotor(Parameters):
    inertia_kg_m2: float = Field(gt=0.0, le=1e3)
    """About the shaft's axis, of all that turns with it."""


class ShellDoubt(Parameters):
    """How the real shell may differ from the empty closed cylinder of the model."""

    mobility_change_db: float = Field(ge=-40.0, le=40.0)
    """Added to the level of every path through the shell."""
    frequency_factor_ratio: float = Field(ge=0.3, le=3.0)
    """Times every natural frequency: parts and oil inside add stiffness and mass."""


class Inside(Parameters):
    """Values of a scroll's inner sources and of the path through its shell."""

    wraps: ScrollWraps
    gas: ScrollGas
    keys: OldhamKeys
    motor: CapacitorMotor
    """At its own line frequency; the study names those of its speeds."""
    rotor: Rotor
    shell: ShellStructure
    doubt: ShellDoubt
    stopping: Stopping
    shaft: ScrollShaft


class Doubt(Parameters):
    """Range of one value of the inside, in SI."""

    table: str
    field: str
    lowest: float
    highest: float


class MeasuredModes(Parameters):
    """Modes of the shell from a universal file (dataset 55), in place of the computed ones."""

    file: str = Field(min_length=1)
    """In a study relative to the study's folder; places are about the centre of mass, z up."""
    file_unit_m: float | None = Field(default=None, gt=0.0, le=1.0)
    """Length of the unit of the places; none where the file itself tells it (dataset 164)."""


class InsideSettings(Parameters):
    """What a study asks of the inner sources."""

    inside: Inside
    doubts: tuple[Doubt, ...]
    """Ranges that the file gives, of the values that are drawn at random."""
    line_frequency_hz: tuple[float, ...] = Field(min_length=1, max_length=100)
    """Of the motor's supply, one for each speed."""
    random_samples: int = Field(default=24, ge=4, le=1000)
    seed: int = Field(default=6, ge=0, lt=2**63)
    key_revolutions: int = Field(default=8, ge=1, le=1000)
    """Over which the forces of the keys are taken."""
    modes: MeasuredModes | None = None

    @model_validator(mode="after")
    def _lines(self) -> "InsideSettings":
        for line in self.line_frequency_hz:
            if not 1.0 <= line <= 1e3:
                raise ValueError(f"line_frequency_hz = {line:g} Hz: allowed 1 to 1000 Hz")
        return self
