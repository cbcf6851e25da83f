"""Levels besides the microphones, labelled: map, sound power, k-Wave against the closed form."""

from typing import Final

import numpy as np
import xarray as xr

from ..base.decibel import energy_mean, energy_sum, sound_pressure_level
from ..base.vocabulary import VARIABLES, WEIGHTINGS, stamp, stamped
from ..base.weighting import WEIGHTING
from ..study.sound_power import SoundPowerSettings
from .sound_power import sound_power_level, stand_corrections_db, surface_area_m2

UNIT_VELOCITY_PEAK: Final = np.sqrt(2.0) * 1e-3
"""1 mm/s (1 mrad/s) root mean square as a peak."""


def measurement_surface_m2(settings: SoundPowerSettings, surface: xr.DataArray) -> float:
    """Area of the measurement surface around the reference box of `surface_transfer_vector`."""
    edges = (surface.attrs[f"reference_{name}_m"] for name in ("length", "width", "height"))
    return surface_area_m2(settings, *edges)


def unit_sound_power(
    surface_transfer_vector: xr.DataArray, settings: SoundPowerSettings, surface_m2: float
) -> xr.DataArray:
    """Sound power level (dof, frequency) of a housing that moves at 1 mm/s or 1 mrad/s rms, dB.

    Parameters
    ----------
    surface_transfer_vector : (position, dof, frequency), at the positions of an arrangement
    settings : the study's; its arrangement, K1 and K2 of its test stand go into the attributes
    surface_m2 : area of its measurement surface, m²
    """
    background, environment = stand_corrections_db(settings, surface_m2)
    ordered = surface_transfer_vector.transpose("position", "dof", "frequency")
    mean = energy_mean(sound_pressure_level(UNIT_VELOCITY_PEAK * ordered.values), axis=0)
    labelled = stamp(
        "unit_sound_power_level",
        sound_power_level(mean, surface_m2),
        {name: ordered[name].values for name in ("dof", "frequency")},
        arrangement=settings.arrangement,
    )
    return labelled.assign_attrs(
        surface_m2=surface_m2,
        test_stand_background_correction_db=background,
        test_stand_environment_correction_db=environment,
    )


def sound_power_variables(
    pressure: xr.DataArray,
    order_frequency: xr.DataArray,
    settings: SoundPowerSettings,
    surface: xr.DataArray,
) -> xr.Dataset:
    """Sound power level of every order and of all orders together, by weighting.

    Parameters
    ----------
    pressure : at the positions of the measurement surface, with the dimensions speed, option,
        order and receiver, complex peaks, Pa
    order_frequency : (speed, order), Hz
    settings : settings of the arrangement
    surface : `surface_transfer_vector`, whose attributes hold the reference box
    """
    ordered = pressure.transpose("speed", "option", "order", "receiver")
    mean = energy_mean(sound_pressure_level(ordered.values), axis=3)
    power = sound_power_level(mean, measurement_surface_m2(settings, surface))
    hertz = order_frequency.values[:, None, :]
    weighted = np.stack([power + WEIGHTING[name](hertz) for name in WEIGHTINGS], axis=-1)
    total = energy_sum(weighted[:, :, 1:], axis=2)  # order 0 is no sound
    coords = {name: ordered[name].values for name in ("speed", "option", "order")}
    arrays = {"order_sound_power_level": weighted, "sound_power_level": total}
    labelled = stamped(arrays, {**coords, "weighting": np.array(WEIGHTINGS)})
    for array in labelled.data_vars.values():
        array.attrs["arrangement"] = settings.arrangement
    return labelled


def map_level(pressure: xr.DataArray) -> xr.Dataset:
    """Level of the first order on the map, from its pressure."""
    dims = VARIABLES["map_level"].dims
    level = sound_pressure_level(pressure.transpose(*dims).values)
    return stamped({"map_level": level}, {name: pressure[name].values for name in dims})


def line_difference(pressure: xr.DataArray, closed_form: xr.DataArray) -> xr.Dataset:
    """1x level with k-Wave's Green's function against that with the closed form.

    Parameters
    ----------
    pressure, closed_form : pressures of the first order, with the dimensions speed, option and
        receiver, complex peaks, Pa
    """
    dims = VARIABLES["line_difference"].dims
    computed, exact = (
        sound_pressure_level(field.transpose(*dims).values) for field in (pressure, closed_form)
    )
    coords = {name: pressure[name].values for name in dims}
    return stamped({"line_difference": computed - exact}, coords)
