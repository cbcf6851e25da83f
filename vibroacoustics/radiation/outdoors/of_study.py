"""Ground and barrier of a study about the machine's centre of mass."""

from typing import Final

from ...base.errors import ParameterError
from ...machine.shell import Shell
from ...study.surroundings import Surroundings
from ..arrays import Array
from .barrier import Barrier
from .green import Outdoors

_LEAST_GAP_M: Final = 0.3
"""Distance from the machine to a barrier, whose echo to the machine is neglected."""


def outdoors_of(shell: Shell, surroundings: Surroundings) -> Outdoors | None:
    """Ground and barrier; none on a floor alone or in free field."""
    if not surroundings.is_outdoors:
        return None
    ground, barrier_settings = surroundings.ground, surroundings.barrier
    barrier = None
    if barrier_settings is not None:
        sign = -1 if barrier_settings.side[0] == "-" else 1
        axis, top_m = (
            "xyz".index(barrier_settings.side[1]),
            shell.floor_z_m + barrier_settings.height_m,
        )
        barrier = Barrier(axis, sign, sign * barrier_settings.distance_m, top_m)
    resistivity = None if ground is None else ground.resistivity_pa_s_per_m2
    return Outdoors(shell.floor_z_m, resistivity, barrier)


def check_barrier(outdoors: Outdoors | None, corners: Array) -> None:
    """Refuse a barrier that is not clear of the machine and its cabinet.

    Parameters
    ----------
    outdoors : with or without a barrier
    corners : lower and upper one of what stands there, shape (2, 3), m

    Raises
    ------
    ParameterError
        It is too near.
    """
    barrier = None if outdoors is None else outdoors.barrier
    if barrier is None:
        return
    gap = float((barrier.sign * (barrier.position_m - corners[:, barrier.axis])).min())
    if gap < _LEAST_GAP_M:
        raise ParameterError(
            f"radiation.surroundings.barrier: the machine is {1e3 * gap:.4g} mm off it; needed at "
            f"least {1e3 * _LEAST_GAP_M:g} mm"
        )
