"""Radiation: from the shell's velocity to the pressure at the microphones."""

from .patterns import SurfaceMotion
from .sound_field import SoundField
from .transfer_vectors import cache_key_material, interpolate_transfer_vector, transfer_vectors

__all__ = [
    "SoundField",
    "SurfaceMotion",
    "cache_key_material",
    "interpolate_transfer_vector",
    "transfer_vectors",
]
