"""From forces on the housing to its velocity and to the forces in its feet."""

from ..machine.feet import FOOT_NAMES
from ..mechanics.bushings import Bushing, RigidBody
from .isolation import Isolation
from .machine import MachineOnMounts, on_mounts
from .tube import tube_stiffness

__all__ = [
    "FOOT_NAMES",
    "Bushing",
    "Isolation",
    "MachineOnMounts",
    "RigidBody",
    "on_mounts",
    "tube_stiffness",
]
