"""What every machine has: mass, mounts, shell, noise, the errors of its source document.

Heights are those of the machine's frame: z up, zero at the centre of mass at rest.
"""

from pydantic import Field

from .base import Parameters
from .housing import Housing
from .mounts import Mounts
from .oscillation import Oscillation
from .shell import Shell
from .suspension import Suspension

PART_MASS = Field(gt=0.0, le=100.0)


class OverallNoise(Parameters):
    """The A-weighted sound pressure level of the whole machine, from a catalogue or assumed."""

    level_dba: float = Field(ge=0.0, le=140.0)
    speed_rpm: float = Field(ge=60.0, le=60000.0)
    distance_m: float = Field(ge=0.1, le=20.0)


class Erratum(Parameters):
    """An error in the source document: what is printed, what is right."""

    item: str
    printed: str
    finding: str


class CommonMachine(Parameters):
    """Fields of all machines; each kind of machine adds those of its mechanism."""

    name: str = Field(min_length=1)
    housing: Housing
    """What moves on the mounts as one rigid body; moving parts included, a suspended block not."""
    mounts: Mounts
    shell: Shell
    overall_noise: OverallNoise
    suspension: Suspension | None = None
    """Springs between the block with the mechanism and the shell; none where both are one."""
    errata: tuple[Erratum, ...] = ()

    @property
    def oscillation(self) -> Oscillation | None:
        """The mass that slides to and fro; none where nothing does."""
        return None
