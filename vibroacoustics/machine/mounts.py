"""The mounts between the machine's feet and the floor."""

from pydantic import Field

from ..base.parameters import Parameters
from .mount_stiffness import LARGEST_N_PER_M, LEAST_N_PER_M


class Mounts(Parameters):
    """Four equal grommets in a square below the shell."""

    pitch_m: float = Field(ge=0.01, le=2.0)
    """Side of the square that the grommets form."""
    lateral_stiffness_n_per_m: float = Field(ge=LEAST_N_PER_M, le=LARGEST_N_PER_M)
    vertical_stiffness_n_per_m: float = Field(ge=LEAST_N_PER_M, le=LARGEST_N_PER_M)
    loss_factor_ratio: float = Field(ge=0.0, le=1.0)
