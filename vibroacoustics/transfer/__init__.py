"""From forces on the housing to its velocity and to the forces in its feet."""

from .bushings import Bushing, RigidBody
from .isolation import Isolation
from .machine import largest_foot_force_n, on_mounts
from .mounts import FOOT_NAMES, RigidBodyOnMounts
from .suspended_block import SuspendedBlock
from .tube import tube_stiffness

__all__ = [
    "FOOT_NAMES",
    "Bushing",
    "Isolation",
    "RigidBody",
    "RigidBodyOnMounts",
    "SuspendedBlock",
    "largest_foot_force_n",
    "on_mounts",
    "tube_stiffness",
]
