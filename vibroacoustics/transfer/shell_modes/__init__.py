"""Elastic modes of the compressor's closed shell: frequencies, surface motion, what drives them."""

from .cylinder import diaphragm_frequencies_hz, donnell_frequencies_hz
from .loads import JOINT_LOADS, JointLoads, PointForces, joint_forces
from .mobility import (
    mobility,
    modal_forces,
    modal_mobility,
    static_flexibility,
    velocity_per_force,
)
from .modes import ElasticShell, ShellMode, elastic_shell
from .sampled import SampledMode

__all__ = [
    "JOINT_LOADS",
    "ElasticShell",
    "JointLoads",
    "PointForces",
    "SampledMode",
    "ShellMode",
    "diaphragm_frequencies_hz",
    "donnell_frequencies_hz",
    "elastic_shell",
    "joint_forces",
    "mobility",
    "modal_forces",
    "modal_mobility",
    "static_flexibility",
    "velocity_per_force",
]
