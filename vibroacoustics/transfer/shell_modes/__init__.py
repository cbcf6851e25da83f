"""Elastic modes of the compressor's closed shell: frequencies, surface motion, what drives them."""

from .cylinder import diaphragm_frequencies_hz, donnell_frequencies_hz
from .loads import JOINT_LOADS, JointLoads, PointForces
from .mobility import mobility, modal_forces, modal_mobility, static_flexibility
from .modes import ElasticShell, ShellMode, elastic_shell

__all__ = [
    "JOINT_LOADS",
    "ElasticShell",
    "JointLoads",
    "PointForces",
    "ShellMode",
    "diaphragm_frequencies_hz",
    "donnell_frequencies_hz",
    "elastic_shell",
    "mobility",
    "modal_forces",
    "modal_mobility",
    "static_flexibility",
]
