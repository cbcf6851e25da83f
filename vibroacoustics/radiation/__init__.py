"""From the shell's velocity to the pressure at the microphones."""

from .sound_field import SoundField
from .transfer_vectors import cache_key_material, interpolate_transfer_vector, transfer_vectors

__all__ = ["SoundField", "cache_key_material", "interpolate_transfer_vector", "transfer_vectors"]
