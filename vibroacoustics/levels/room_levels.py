"""Levels at the listeners in a room, labelled: by air, by the feet, both ways, and their limits."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.constants import REFERENCE_POWER_W
from ..base.decibel import energy_sum, level_of_power, power_of_level
from ..base.quantiles import weighted_quantiles
from ..base.vocabulary import check, stamp
from ..machine.source import CaseKey
from .by_source import weighting_power
from .in_room import RoomSound, power_of_hemisphere
from .labelled import level
from .measured_points import BASELINE_BANDS, MIDDLE_HZ
from .room_rest import beside_model
from .structure_borne import weight_of

BAND_SHARES: Final = {"low": 0.05, "middle": 0.5, "high": 0.95}


@dataclass(frozen=True)
class AirInRoom:
    """Mean squares by air at the listeners with the values as given.

    Attributes
    ----------
    modelled : of all sources, A-weighted, shape (speed, option, listener), Pa²
    rest : of what no source explains, A-weighted, the same shape, Pa²
    alone : of each source, A-weighted, shape (speed, option, listener, source), Pa²
    band : of all of it, shape (speed, option, listener, band), Pa²
    power_band : of the machine, shape (speed, option, band), W
    noise_band : of what is no line, shape (speed, option, listener, band), Pa²
    """

    modelled: Array
    rest: Array
    alone: Array
    band: Array
    power_band: Array
    noise_band: Array

    @classmethod
    def of(
        cls,
        sound: Mapping[CaseKey, RoomSound],
        speeds: Sequence[float],
        options: Sequence[str],
        rest: Array,
        gains: Array,
        distance_m: float,
    ) -> "AirInRoom":
        """Of the modelled sound and the rest, which goes by the gains of both methods.

        Parameters
        ----------
        sound : of every case
        speeds, options : in the order of the arrays
        rest : of `rest_in_bands`, Pa²
        gains : mean square per power, shape (listener, band), Pa²/W
        distance_m : of the rest's microphone from the foot of the machine's axis
        """

        def gathered(part: str) -> Array:
            return np.array([[getattr(sound[s, o], part) for o in options] for s in speeds])

        rest_power = power_of_hemisphere(rest, distance_m)
        rest_band = rest_power[:, :, None, :] * gains
        weight = weighting_power("A", MIDDLE_HZ)
        return cls(
            gathered("total"),
            rest_band @ weight,
            np.moveaxis(gathered("alone"), 2, -1),
            gathered("band") + rest_band,
            gathered("power_band") + rest_power,
            gathered("noise_band") + rest_band,
        )

    @property
    def total(self) -> Array:
        """Of the whole machine, A-weighted, Pa²."""
        return self.modelled + self.rest


def air_variables(
    air: AirInRoom,
    speeds: Sequence[float],
    options: Sequence[str],
    listeners: Sequence[str],
    sources: Sequence[str],
) -> xr.Dataset:
    """Levels by air with the values as given."""
    cases: dict[str, Any] = {"speed": list(speeds), "option": list(options)}
    coords = {**cases, "listener": list(listeners)}
    bands = {"noise_band": [band.nominal_hz for band in BASELINE_BANDS]}
    arrays = {
        "room_level": stamp("room_level", level(air.total), coords),
        "room_source_level": stamp(
            "room_source_level", level(air.alone), {**coords, "sound_source": list(sources)}
        ),
        "room_band_level": stamp("room_band_level", level(air.band), coords | bands),
        "room_noise_band_level": stamp(
            "room_noise_band_level", level(air.noise_band), coords | bands
        ),
        "room_sound_power_level": stamp(
            "room_sound_power_level", power_level(air.power_band), cases
        ),
    }
    return check(xr.Dataset(arrays))


def line_variables(sound: Mapping[CaseKey, RoomSound], results: xr.Dataset) -> xr.Dataset:
    """Pressure of all sources together at the lines, by air with the values as given.

    Parameters
    ----------
    sound : of every case, with its lines' names
    results : with `room_level`, and all lines
    """
    coords = {**_coordinates(results["room_level"]), "line": results["line"].values}
    column = {str(name): number for number, name in enumerate(coords["line"])}
    pressure = np.zeros(tuple(map(len, coords.values())), dtype=complex)
    for s, speed in enumerate(coords["speed"]):
        for o, option in enumerate(coords["option"]):
            one = sound[float(speed), str(option)]
            pressure[s, o][:, [column[name] for name in one.line]] = one.pressure
    labelled = stamp("room_pressure_line", pressure, coords)
    return check(xr.Dataset({"room_pressure_line": labelled}))


def power_level(power_band: Array) -> Array:
    """A-weighted level of powers in `BASELINE_BANDS`, dB re 1 pW, the last axis summed."""
    power = power_band @ weighting_power("A", MIDDLE_HZ)
    return np.asarray(level_of_power(power / REFERENCE_POWER_W))


def drawn_band(air: AirInRoom, results: xr.Dataset, receiver: str) -> xr.Dataset:
    """Levels by air that 5, 50 and 95 % of the draws stay below; empty without draws.

    A draw changes what comes of the model, and what does not, at each listener as at the microphone
    of the published level.

    Parameters
    ----------
    air : at the listeners
    results : of the levels by draw at the microphones, with `room_level`
    receiver : microphone of the published level
    """
    if "level_total_by_draw" not in results:
        return xr.Dataset()
    there = results.sel(receiver=receiver)
    given = _square(there["level_modelled"].sel(weighting="A").transpose("speed", "option"))
    drawn = _square(there["level_modelled_by_draw"].transpose("draw", "speed", "option"))
    rest, rests = (beside_model(results, receiver, name) for name in ("", "_by_draw"))
    silent = rest <= 0.0
    of_model = drawn / np.where(given > 0.0, given, 1.0)
    of_rest = np.where(silent, 0.0, rests / np.where(silent, 1.0, rest))
    square = air.modelled * of_model[..., None] + air.rest * of_rest[..., None]
    weight = results["draw_weight"].isel(prior=0).values
    levels = level(np.nan_to_num(square))
    ends = weighted_quantiles(levels, weight, list(BAND_SHARES.values()))
    coords = _coordinates(results["room_level"])
    names = [f"room_level_{end}" for end in BAND_SHARES]
    arrays = {name: stamp(name, of, coords) for name, of in zip(names, ends, strict=True)}
    return check(xr.Dataset(arrays))


def plate_variables(results: xr.Dataset, per_power: Array) -> xr.Dataset:
    """Levels by the feet and the plate at the listeners; empty without a plate.

    Parameters
    ----------
    results : with the plate's powers and spans, `room_level` and, of draws, `room_level_middle`
    per_power : mean square per power, shape (speed, listener, line), Pa²/W
    """
    power = results["structure_borne_power"].transpose("speed", "option", "line").values
    frequency = results["tone_frequency"].transpose("speed", "line").values
    of_lines = power[:, :, None] * per_power[:, None]
    by_plate = level(np.einsum("solf,sf->sol", of_lines, weight_of("A", frequency)))
    span = results["structure_borne_level"].sel(weighting="A").isel(receiver=0)
    coords = _coordinates(results["room_level"])
    by_line = {**coords, "line": results["line"].values}
    arrays = {
        "room_plate_level": stamp("room_plate_level", by_plate, coords),
        "room_plate_line_level": stamp("room_plate_line_level", level(of_lines), by_line),
    }
    for end in ("low", "high"):
        of_end = results[f"structure_borne_level_{end}"].isel(receiver=0) - span
        values = by_plate + of_end.transpose("speed", "option").values[..., None]
        arrays[f"room_plate_level_{end}"] = stamp(f"room_plate_level_{end}", values, coords)
    by_air = results["room_level_middle" if "room_level_middle" in results else "room_level"]
    both = energy_sum(np.stack([by_air.values, by_plate]), axis=0)
    arrays["room_level_both_ways"] = stamp("room_level_both_ways", both, coords)
    return check(xr.Dataset(arrays))


def _coordinates(array: xr.DataArray) -> dict[str, Any]:
    return {str(name): array[name].values for name in array.dims}


def _square(levels: xr.DataArray) -> Array:
    return np.asarray(power_of_level(levels.values))
