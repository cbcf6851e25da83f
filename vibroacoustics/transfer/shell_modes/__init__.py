"""Elastic modes of the compressor's closed shell: frequencies, surface motion, what drives them."""

from .loads import JOINT_LOADS, JointLoads, joint_forces
from .mobility import modal_forces, patch_forces, velocity_per_force
from .modes import ElasticShell, ShellMode, elastic_shell
from .sampled import SampledMode

__all__ = [
    "JOINT_LOADS",
    "ElasticShell",
    "JointLoads",
    "SampledMode",
    "ShellMode",
    "elastic_shell",
    "joint_forces",
    "modal_forces",
    "patch_forces",
    "velocity_per_force",
]
