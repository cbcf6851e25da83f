"""Physical constants: value, unit, source. SI throughout."""

from typing import Final

REFERENCE_PRESSURE_PA: Final = 20e-6
"""Reference sound pressure, Pa (ISO 1683)."""

SPEED_OF_SOUND_M_PER_S: Final = 343.0
"""Speed of sound in dry air at 20 °C, m/s (ISO 9613-1: 343.2)."""

AIR_DENSITY_KG_PER_M3: Final = 1.2
"""Density of air at 20 °C and 101.325 kPa, kg/m³ (ISO 9613-1: 1.204)."""

STANDARD_GRAVITY_M_PER_S2: Final = 9.80665
"""Standard acceleration of free fall, m/s² (ISO 80000-3)."""
