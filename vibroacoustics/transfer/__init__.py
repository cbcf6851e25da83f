"""From forces on the housing to its velocity and to the forces in its feet."""

from .mounts import FOOT_NAMES, RigidBodyOnMounts

__all__ = ["FOOT_NAMES", "RigidBodyOnMounts"]
