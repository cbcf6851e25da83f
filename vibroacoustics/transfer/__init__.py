"""Transfer from forces on the housing to its velocity and to the forces in its feet."""

from .machine import MachineOnMounts, on_mounts

__all__ = ["MachineOnMounts", "on_mounts"]
