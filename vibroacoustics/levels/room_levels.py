"""Levels at the listeners in a room, labelled: airborne, structure-borne, both, and limits."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.constants import REFERENCE_POWER_W, REFERENCE_PRESSURE_PA
from ..base.decibel import energy_sum, level_of_power, power_of_level
from ..base.vocabulary import stamped
from ..machine.source import CaseKey
from .by_source import membership, weighting_power
from .in_room import RoomSound, power_of_hemisphere
from .labelled import level
from .measured_points import BASELINE_BANDS, MIDDLE_HZ
from .nominal import NominalSound
from .structure_borne import weight_of

_A: Array = weighting_power("A", MIDDLE_HZ)


def rest_in_bands(results: xr.Dataset, receiver: str) -> Array:
    """Mean squares beside the model at a microphone, shape (speed, option, band), Pa².

    In `BASELINE_BANDS`. Their spectrum is that of unmodelled noise and, where third octaves were
    measured, what these are over the model; their A-weighted sum is what the level of the machine
    is over that of the model.

    Parameters
    ----------
    results : variables of the levels
    receiver : at which the machine's noise is published
    """
    unmodelled = results["unmodelled_band_level"].sel(receiver=receiver)
    unmodelled_pa2 = _square(unmodelled.transpose("speed", "option", "noise_band"))
    if "baseline_band_level" in results:
        levels = results["baseline_band_level"].sel(receiver=receiver)
        measured = _square(levels.transpose("speed", "option", "baseline_band"))
        excess = np.maximum(measured - _modelled(results, receiver), 0.0)
        unmodelled_pa2 = np.where(np.isfinite(measured), excess, unmodelled_pa2)
    wanted = beside_model(results, receiver)
    loud = unmodelled_pa2 @ _A
    factor = np.where(loud > 0.0, wanted / np.where(loud > 0.0, loud, 1.0), 0.0)
    return np.asarray(unmodelled_pa2 * factor[..., None])


def beside_model(results: xr.Dataset, receiver: str) -> Array:
    """A-weighted mean squares of the machine less those of the model, (speed, option), Pa²."""
    total, modelled = results["level_total"], results["level_modelled"].sel(weighting="A")
    squares = [
        _square(each.sel(receiver=receiver).transpose("speed", "option"))
        for each in (total, modelled)
    ]
    return np.maximum(squares[0] - squares[1], 0.0)


def _modelled(results: xr.Dataset, receiver: str) -> Array:
    """Mean squares of the model at a microphone in bands, shape (speed, option, band), Pa²."""
    pressure = results["pressure_line"].sel(receiver=receiver).sum("sound_source")
    square = 0.5 * np.abs(pressure.transpose("speed", "option", "line").values) ** 2
    frequency = results["tone_frequency"].transpose("speed", "line").values
    levels = results["noise_band_level"].sel(receiver=receiver)
    bands = _square(levels.transpose("speed", "option", "noise_band"))
    for number, row in enumerate(np.nan_to_num(frequency)):
        bands[number] += square[number] @ membership(row, BASELINE_BANDS)
    return bands


def _square(level: xr.DataArray) -> Array:
    return np.asarray(REFERENCE_PRESSURE_PA**2 * power_of_level(level.values))


@dataclass(frozen=True)
class AirInRoom:
    """Mean squares of airborne sound at the listeners with nominal values.

    Attributes
    ----------
    modelled : mean square of all sources, A-weighted, shape (speed, option, listener), Pa²
    unmodelled : mean square of unmodelled noise, A-weighted, the same shape, Pa²
    alone : mean square of each source, A-weighted, shape (speed, option, listener, source), Pa²
    band : mean square of all of it, shape (speed, option, listener, band), Pa²
    power_band : power of the machine, shape (speed, option, band), W
    noise_band : mean square of all that is no line, shape (speed, option, listener, band), Pa²
    coords : along these axes, by name
    """

    modelled: Array
    unmodelled: Array
    alone: Array
    band: Array
    power_band: Array
    noise_band: Array
    coords: Mapping[str, Any] = field(default_factory=dict)

    @classmethod
    def of(
        cls,
        nominal: NominalSound,
        listeners: Sequence[str],
        sound: Mapping[CaseKey, RoomSound],
        results: xr.Dataset,
        gains: Array,
    ) -> "AirInRoom":
        """Add the rest, which goes by the gains of both methods, to the modelled sound.

        Parameters
        ----------
        nominal : sound at the microphones
        listeners : names
        sound : sound of every case
        results : levels at the microphones
        gains : mean square per power, shape (listener, band), Pa²/W
        """
        study, axes, receiver = nominal.study, nominal.axes, nominal.study.catalogue_receiver
        unmodelled = rest_in_bands(results, receiver)
        rest_power = power_of_hemisphere(unmodelled, study.receivers[receiver].distance_m)
        rest_band = rest_power[:, :, None, :] * gains
        coords = {
            "speed": list(axes.speeds),
            "option": list(axes.options),
            "listener": list(listeners),
            "sound_source": list(axes.sources),
        }
        return cls(
            axes.gathered(sound, "total"),
            rest_band @ weighting_power("A", MIDDLE_HZ),
            np.moveaxis(axes.gathered(sound, "alone"), 2, -1),
            axes.gathered(sound, "band") + rest_band,
            axes.gathered(sound, "power_band") + rest_power,
            axes.gathered(sound, "noise_band") + rest_band,
            coords,
        )

    @property
    def total(self) -> Array:
        """Mean square of the machine, A-weighted, Pa²."""
        return self.modelled + self.unmodelled


def room_variables(
    air: AirInRoom,
    sound: Mapping[CaseKey, RoomSound],
    results: xr.Dataset,
    statistics: xr.Dataset,
    plate_per_power: Callable[[Array], Array],
) -> xr.Dataset:
    """Label airborne levels at the listeners and, where there is a plate, structure-borne ones.

    Parameters
    ----------
    air : mean squares of airborne sound
    sound : sound of every case
    results : nominal levels at the microphones, those of samples, and of the plate
    statistics : `room_level` of the samples; empty without samples
    plate_per_power : see `plate_variables`
    """
    levels = air_variables(air)
    levels = levels.merge(line_variables(sound, results.merge(levels)))
    levels = levels.drop_vars("room_level" if statistics else []).merge(statistics)
    return levels.merge(plate_variables(results.merge(levels), plate_per_power))


def air_variables(air: AirInRoom) -> xr.Dataset:
    """Label the airborne levels with nominal values."""
    values = {
        "room_level": level(air.total),
        "room_source_level": level(air.alone),
        "room_band_level": level(air.band),
        "room_noise_band_level": level(air.noise_band),
        "room_sound_power_level": power_level(air.power_band),
    }
    return stamped(
        values, {**air.coords, "noise_band": [band.nominal_hz for band in BASELINE_BANDS]}
    )


def line_variables(sound: Mapping[CaseKey, RoomSound], results: xr.Dataset) -> xr.Dataset:
    """Airborne pressure of all sources at the lines, with nominal values."""
    coords = {**_coordinates(results["room_level"]), "line": results["line"].values}
    column = {str(name): number for number, name in enumerate(coords["line"])}
    pressure = np.zeros(tuple(map(len, coords.values())), dtype=complex)
    for s, speed in enumerate(coords["speed"]):
        for o, option in enumerate(coords["option"]):
            of_case = sound[float(speed), str(option)]
            pressure[s, o][:, [column[name] for name in of_case.line]] = of_case.pressure
    return stamped({"room_pressure_line": pressure}, coords)


def power_level(power_band: Array) -> Array:
    """A-weighted level of powers in `BASELINE_BANDS`, dB re 1 pW, the last axis summed."""
    power = power_band @ weighting_power("A", MIDDLE_HZ)
    return np.asarray(level_of_power(power / REFERENCE_POWER_W))


def plate_variables(results: xr.Dataset, plate_per_power: Callable[[Array], Array]) -> xr.Dataset:
    """Label the structure-borne levels at the listeners; empty without a plate.

    Parameters
    ----------
    results : with the plate's powers and spans, and `room_level`
    plate_per_power : mean square per power of the plate, of frequencies, shape
        (listener, frequency), Pa²/W
    """
    if "structure_borne_power" not in results:
        return xr.Dataset()
    power = results["structure_borne_power"].transpose("speed", "option", "line").values
    frequency = results["tone_frequency"].transpose("speed", "line").values
    hertz = np.where(np.nan_to_num(frequency) > 0.0, frequency, MIDDLE_HZ[0])
    per_power = np.array([plate_per_power(row) for row in hertz])
    of_lines = power[:, :, None] * per_power[:, None]
    by_plate = level(np.einsum("solf,sf->sol", of_lines, weight_of("A", frequency)))
    span = results["structure_borne_level"].sel(weighting="A").isel(receiver=0)
    values = {"room_plate_level": by_plate, "room_plate_line_level": level(of_lines)}
    for end in ("low", "high"):
        of_end = results[f"structure_borne_level_{end}"].isel(receiver=0) - span
        difference = of_end.transpose("speed", "option").values[..., None]
        values[f"room_plate_level_{end}"] = by_plate + difference
    by_air = results["room_level"]
    values["room_level_both_ways"] = energy_sum(np.stack([by_air.values, by_plate]), axis=0)
    return stamped(values, {**_coordinates(by_air), "line": results["line"].values})


def _coordinates(array: xr.DataArray) -> dict[str, Any]:
    return {str(name): array[name].values for name in array.dims}
