"""Levels of a plate under the feet at the microphones, labelled."""

from typing import Final

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from ..base.arrays import Array
from ..base.constants import AIR_IMPEDANCE_PA_S_PER_M, REFERENCE_PRESSURE_PA
from ..base.decibel import energy_sum, mean_square_level
from ..base.vocabulary import WEIGHTINGS, stamped
from ..mechanics.received_sound import PlateSound
from ..study.structure_borne import StructureBorne
from .by_source import weighting_power

_CHANCE: Final = 1.6448536269514722
"""Quantile of a standard normal variable, passed once in 20."""


def mean_square_per_power(distance_m: ArrayLike, absorption_area_m2: float | None) -> Array:
    """Mean square of pressure per sound power in front of a plate: ρ c (1/(2π r²) + 4/A), Pa²/W.

    A source in a wall, and the diffuse field of the room (Kuttruff, Room Acoustics, chapter on
    diffuse fields).

    Parameters
    ----------
    distance_m : distance from the centre of the feet, shape (...)
    absorption_area_m2 : absorption area of the room; none for an open half space
    """
    diffuse = 0.0 if absorption_area_m2 is None else 4.0 / absorption_area_m2
    direct = 1.0 / (2.0 * np.pi * np.asarray(distance_m, dtype=float) ** 2)
    return np.asarray(AIR_IMPEDANCE_PA_S_PER_M * (direct + diffuse))


def structure_borne_variables(
    settings: StructureBorne, sound: PlateSound, distance_m: ArrayLike, results: xr.Dataset
) -> xr.Dataset:
    """Label the structure-borne levels, apart from airborne sound.

    Parameters
    ----------
    settings : absorption in front of the plate, and deviation of the method
    sound : sound of all cases, shapes (speed, option, line)
    distance_m : distance of each receiver from the centre of the feet, shape (receiver,)
    results : airborne levels, and the frequencies of the lines
    """
    level_total = results["level_total"]
    frequency_hz = results["tone_frequency"].transpose("speed", "line").values
    per_power = mean_square_per_power(distance_m, settings.absorption_area_m2)
    spread = spread_of_power(sound, frequency_hz, settings.deviation_db)
    power = sound.power_w[:, :, None, :] * per_power[:, None]
    by_weighting = np.stack([weight_of(name, frequency_hz) for name in WEIGHTINGS], axis=-1)
    weighted = power[..., None] * by_weighting[:, None, None]
    total = _level(weighted.sum(axis=-2))
    audible = total[..., WEIGHTINGS.index("A")]
    by_air = level_total.transpose("speed", "option", "receiver").values
    low, high = (bound[..., None] for bound in spread["total"])
    coords = {name: level_total[name].values for name in ("speed", "option", "receiver")}
    values = {
        "structure_borne_input_power": sound.input_power_w,
        "structure_borne_power": sound.power_w,
        "structure_borne_line_level": _level(weighted),
        "structure_borne_line_low": spread["line"][0],
        "structure_borne_line_high": spread["line"][1],
        "structure_borne_level": total,
        "structure_borne_level_low": audible + low,
        "structure_borne_level_high": audible + high,
        "level_both_ways": energy_sum(np.stack([by_air, audible]), axis=0),
    }
    lines = results["line"].values
    return stamped(values, {**coords, "line": lines, "weighting": list(WEIGHTINGS)})


def spread_of_power(
    sound: PlateSound, frequency_hz: Array, deviation_db: float
) -> dict[str, tuple[Array, Array]]:
    """Compute the levels that 5 % and 95 % lie below, over the mean power's, dB.

    Parameters
    ----------
    sound : sound of all cases
    frequency_hz : frequency of the lines, shape (speed, line)
    deviation_db : standard deviation of the method

    Returns
    -------
    `line`, shapes (speed, option, line), and `total`, (speed, option), whose lines spread each for
    itself
    """
    weighted = sound.power_w * weight_of("A", frequency_hz)[:, None]
    total = weighted.sum(axis=-1)
    squares = (weighted**2 * sound.variance).sum(axis=-1)
    variance = np.where(total > 0.0, squares / np.where(total > 0.0, total, 1.0) ** 2, 0.0)
    return {
        "line": level_range(sound.variance, deviation_db),
        "total": level_range(variance, deviation_db),
    }


def level_range(variance: Array, deviation_db: float) -> tuple[Array, Array]:
    """Levels that 5 % and 95 % lie below, over that of the mean power, dB, shapes (...).

    Energies are lognormal (Langley and Cotoni, J. Acoust. Soc. Am. 115 (2004) 706), and so is what
    a prediction errs by otherwise.

    Parameters
    ----------
    variance : relative variance of the power, shape (...)
    deviation_db : standard deviation of the level by all else
    """
    in_db = 10.0 / np.log(10.0)
    modal = np.log1p(np.asarray(variance, dtype=float))
    median, spread = -0.5 * in_db * modal, np.sqrt(in_db**2 * modal + deviation_db**2)
    return np.asarray(median - _CHANCE * spread), np.asarray(median + _CHANCE * spread)


def weight_of(weighting: str, frequency_hz: Array) -> Array:
    """Factor of a weighting on mean squares; none where there is no line."""
    is_line = np.nan_to_num(frequency_hz) > 0.0
    return weighting_power(weighting, np.where(is_line, frequency_hz, 1.0)) * is_line


def _level(mean_square: Array) -> Array:
    return mean_square_level(mean_square, REFERENCE_PRESSURE_PA)
