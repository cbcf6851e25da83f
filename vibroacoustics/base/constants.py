"""Physical constants: value, unit, source. SI throughout."""

from typing import Final

REFERENCE_PRESSURE_PA: Final = 20e-6
"""Reference sound pressure, Pa (ISO 1683)."""

REFERENCE_BY_UNIT: Final = {"Pa": REFERENCE_PRESSURE_PA, "m/s²": 1e-6, "m/s": 1e-9, "N": 1e-6}
"""Reference of a level by the unit of the quantity, in this unit (ISO 1683)."""

REFERENCE_POWER_W: Final = 1e-12
"""Reference sound power, W (ISO 1683)."""

SPEED_OF_SOUND_M_PER_S: Final = 343.0
"""Speed of sound in dry air at 20 °C, m/s (ISO 9613-1: 343.2)."""

AIR_DENSITY_KG_PER_M3: Final = 1.2
"""Density of air at 20 °C and 101.325 kPa, kg/m³ (ISO 9613-1: 1.204)."""

AIR_IMPEDANCE_PA_S_PER_M: Final = AIR_DENSITY_KG_PER_M3 * SPEED_OF_SOUND_M_PER_S
"""Density times speed of sound of air, Pa s/m."""

LOWEST_PROMINENT_TONE_HZ: Final = 89.1
"""Lowest tone that ECMA-418-1 judges, Hz: lower edge of the third octave of 100 Hz (clause 1)."""

LOWEST_AUDIBLE_TONE_HZ: Final = 90.0
"""Lowest tone whose audibility is rated, Hz (DIN 45681, clause 5.3.2; ISO/PAS 20065: 50 Hz).

Below it A-weighted noise rises so steeply that the mean noise line depends on chance: in white
noise it scatters by 10 dB from one spectrum to the next.
"""

STANDARD_GRAVITY_M_PER_S2: Final = 9.80665
"""Standard acceleration of free fall, m/s² (ISO 80000-3)."""
