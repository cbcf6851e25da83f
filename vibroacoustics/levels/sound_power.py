"""Sound power level from sound pressure levels on a surface around the source: ISO 3744:2010.

LW = mean Lp - K1 - K2 + 10 lg(S/S0). The method takes the intensity as p²/(rho c), straight out of
the surface: near a small source at a low frequency, and where the sound passes a flat side at an
angle, the result is too high (docs/sound_power.md shows by how much).
"""

from typing import Final

import numpy as np

from ..base.arrays import Array
from ..base.decibel import level_of_power, power_of_level
from ..base.errors import ParameterError
from ..study.sound_power import HEMISPHERES, MINIMUM_BACKGROUND_MARGIN_DB, SoundPowerSettings

REFERENCE_SURFACE_M2: Final = 1.0
"""S0 of equation (18)."""
NEGLIGIBLE_BACKGROUND_MARGIN_DB: Final = 15.0
"""Margin above which K1 is 0 (8.2.3)."""
LARGEST_ENVIRONMENT_CORRECTION_DB: Final = 4.0
"""A test environment with a larger K2A does not qualify (4.3.2)."""


def background_correction_db(margin_db: Array | float) -> Array:
    """K1 = -10 lg(1 - 10^(-0.1 ΔL)), dB (equation 16 and 8.2.3).

    Parameters
    ----------
    margin_db : ΔL, mean level with the source in operation minus that of the background, dB

    Returns
    -------
    0 above 15 dB. Below 6 dB the value at 6 dB, 1.3 dB: the sound power level that follows is
    then an upper bound and has to be reported as one.
    """
    margin = np.asarray(margin_db, dtype=float)
    limited = np.maximum(margin, MINIMUM_BACKGROUND_MARGIN_DB)
    correction = -level_of_power(1.0 - power_of_level(-limited))
    return np.where(margin > NEGLIGIBLE_BACKGROUND_MARGIN_DB, 0.0, correction)


def environment_correction(surface_m2: float, absorption_area_m2: Array | float) -> Array:
    """K2 = 10 lg(1 + 4 S/A), dB, of a room with the absorption area A (equation A.2)."""
    return np.asarray(level_of_power(1.0 + 4.0 * surface_m2 / np.asarray(absorption_area_m2)))


def environment_correction_db(surface_m2: float, absorption_area_m2: float) -> float:
    """K2 of the room of a test stand, dB.

    Raises
    ------
    ParameterError
        K2 exceeds 4 dB: the room does not qualify (4.3.2).
    """
    correction = float(environment_correction(surface_m2, absorption_area_m2))
    if correction > LARGEST_ENVIRONMENT_CORRECTION_DB:
        least = 4.0 * surface_m2 / (power_of_level(LARGEST_ENVIRONMENT_CORRECTION_DB) - 1.0)
        raise ParameterError(
            f"sound_power.absorption_area_m2 = {absorption_area_m2:g} m²: K2 is {correction:.1f} "
            f"dB on a surface of {surface_m2:.3g} m²; ISO 3744 allows 4 dB, from {least:.3g} m²"
        )
    return correction


def sound_power_level(
    mean_level_db: Array | float,
    surface_m2: float,
    background_correction: Array | float = 0.0,
    environment_correction: Array | float = 0.0,
) -> Array:
    """LW in dB re 1 pW (equations 17 and 18).

    Parameters
    ----------
    mean_level_db : energy mean over the positions, dB re 20 µPa; any weighting is that of the
        result: A-weighted levels give LWA
    surface_m2 : area of the measurement surface, m²
    background_correction, environment_correction : K1 and K2, dB; 0 in a simulation, which has
        neither background nor room beyond its own walls
    """
    corrected = np.asarray(mean_level_db) - background_correction - environment_correction
    return np.asarray(corrected + level_of_power(surface_m2 / REFERENCE_SURFACE_M2))


def stand_corrections_db(settings: SoundPowerSettings, surface_m2: float) -> tuple[float, float]:
    """K1 and K2 of the test stand that a study is compared with, dB; 0 where it states nothing.

    The microphones there read K1 + K2 more than the simulation's, which has neither.
    """
    margin, area = settings.background_margin_db, settings.absorption_area_m2
    background = 0.0 if margin is None else float(background_correction_db(margin))
    return background, 0.0 if area is None else environment_correction_db(surface_m2, area)


def hemisphere_area_m2(radius_m: float) -> float:
    """2 pi r², over a floor (7.2.3)."""
    return 2.0 * float(np.pi) * radius_m**2


def box_area_m2(length_m: float, width_m: float, height_m: float, distance_m: float) -> float:
    """Area of the parallelepiped around a reference box on a floor (7.2.4, equation 9), m².

    Parameters
    ----------
    length_m, width_m, height_m : edges of the reference box
    distance_m : from the reference box to the measurement surface
    """
    long, wide = length_m + 2.0 * distance_m, width_m + 2.0 * distance_m
    return long * wide + 2.0 * (height_m + distance_m) * (wide + long)


def surface_area_m2(
    settings: SoundPowerSettings, length_m: float, width_m: float, height_m: float
) -> float:
    """Area of a study's measurement surface over a floor, around a reference box of these edges."""
    if settings.arrangement in HEMISPHERES:
        return hemisphere_area_m2(settings.radius_m)
    return box_area_m2(length_m, width_m, height_m, settings.distance_m)
