"""The level of the machine as a catalogue or an assumption gives it."""

from typing import Annotated, Final

from pydantic import Field

from ..base.parameters import Held, Parameters

DATUM: Final = Held("are data that the model is compared to")


class OverallNoise(Parameters):
    """The A-weighted sound pressure level of the whole machine, from a catalogue or assumed."""

    level_dba: Annotated[float, DATUM] = Field(ge=0.0, le=140.0)
    speed_rpm: Annotated[float, DATUM] = Field(ge=60.0, le=60000.0)
    distance_m: Annotated[float, DATUM] = Field(ge=0.1, le=20.0)
    deviation_db: Annotated[float, DATUM] = Field(default=2.0, ge=0.1, le=10.0)
    """Standard deviation of the level."""
