"""Levels of amplitudes on maps: of sound pressure re 20 µPa, of other units re 1 of the unit."""

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..base.decibel import level_of_amplitude, sound_pressure_level


def map_level(peak: Array | ComplexArray, unit: str) -> tuple[Array, str]:
    """Level of peak amplitudes of any shape, dB, and its label with the reference."""
    if unit == "Pa":
        return sound_pressure_level(peak), "dB re 20 µPa"
    return np.asarray(level_of_amplitude(np.abs(peak))), f"dB re 1 {unit} peak"
