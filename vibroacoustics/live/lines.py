"""Lines and noise of every case, and the energy that stays as it is when a slider moves."""

from dataclasses import dataclass
from typing import Final

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ..base.arrays import Array, ComplexArray
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import power_of_level
from ..base.units import shaft_frequency_hz
from ..base.weighting import WEIGHTING
from ..sound import Ingredients, ingredients

QUIET: Final = 1e-6
"""A line with less than this part of the energy at every microphone with every option, weighted by
A and not, is not drawn; it stays in the energy of the rest."""


@dataclass(frozen=True)
class Lines:
    """Lines of all options at one speed, rising in frequency.

    Attributes
    ----------
    frequency_hz : shape (line,)
    order : not a number where it is none, shape (line,)
    pressure : complex peaks, shape (option, receiver, line), Pa
    modelled : complex peaks without what was measured, shape (option, receiver, line), Pa
    measured : complex peaks of the orders of a baseline, shape (receiver, line), Pa; zero where
        there is none
    has_phase : whether its phase is known, of the same shape
    continuous : A-weighted mean square of the total beside these lines, shape (option, receiver),
        Pa²
    modelled_continuous : A-weighted mean square of the modelled sound beside them, same shape, Pa²
    noise : mean square of the noise in third octaves, shape (option, receiver, band), Pa²
    """

    frequency_hz: Array
    order: Array
    pressure: ComplexArray
    modelled: ComplexArray
    measured: ComplexArray
    has_phase: NDArray[np.bool_]
    continuous: Array
    modelled_continuous: Array
    noise: Array

    @property
    def of_model(self) -> Array:
        """A-weighted mean square of the modelled lines, shape (option, receiver), Pa²."""
        return _squares(self.modelled, self.frequency_hz)


def lines_at(results: xr.Dataset, speed: float, bands: Array, always: frozenset[float]) -> Lines:
    """Lines and noise at a speed.

    Parameters
    ----------
    results : results of a run
    speed : one of theirs, rpm
    bands : exact middles of the third octaves, Hz, shape (band,)
    always : orders that are kept, however quiet
    """
    sounds = [
        [ingredients(results, str(option), str(name), speed) for name in results["receiver"].values]
        for option in results["option"].values
    ]
    hertz = {
        name: frequency
        for row in sounds
        for sound in row
        for name, frequency in zip(sound.lines.name, sound.lines.frequency_hz, strict=True)
    }
    for order in always:
        hertz.setdefault(f"order {order:g}", order * shaft_frequency_hz(speed))
    names = sorted(hertz, key=lambda name: hertz[name])
    pressure = np.array([[_pressure(sound, names) for sound in row] for row in sounds])
    at_speed = results.sel(speed=speed)
    modelled = _modelled(at_speed, names)
    frequency = np.array([hertz[name] for name in names])
    orders = np.array([_order(name) for name in names])
    kept = _loud(pressure, frequency) | np.isin(orders, list(always))
    pressure, modelled = pressure[..., kept], modelled[..., kept]
    frequency, orders = frequency[kept], orders[kept]
    total = at_speed["level_total"].transpose("option", "receiver").values
    level = at_speed["level_modelled"].sel(weighting="A").transpose("option", "receiver").values
    noise = np.array([[_noise(sound, bands) for sound in row] for row in sounds])
    return Lines(
        frequency,
        orders,
        pressure,
        modelled,
        *_measured(at_speed, orders),
        _energy(total) - _squares(pressure, frequency),
        _energy(level) - _squares(modelled, frequency),
        noise,
    )


def _pressure(sound: Ingredients, names: list[str]) -> ComplexArray:
    by_name = dict(zip(sound.lines.name, sound.lines.pressure_pa, strict=True))
    return np.array([by_name.get(name, 0.0) for name in names], dtype=complex)


def _modelled(at_speed: xr.Dataset, names: list[str]) -> ComplexArray:
    """Peaks of all sources together, zero where a line was measured alone, (option, receiver,
    line)."""
    pressure = at_speed["pressure_line"].sum("sound_source").transpose("option", "receiver", "line")
    return np.asarray(pressure.reindex(line=names, fill_value=0.0).values)


def _measured(at_speed: xr.Dataset, orders: Array) -> tuple[ComplexArray, NDArray[np.bool_]]:
    """Peaks of a baseline's orders and whether their phase is known, (receiver, line)."""
    if "baseline_order_pressure" not in at_speed:
        shape = at_speed.sizes["receiver"], orders.size
        return np.zeros(shape, dtype=complex), np.zeros(shape, dtype=bool)
    of_orders = at_speed[["baseline_order_pressure", "baseline_order_phase"]]
    of_lines = of_orders.transpose("receiver", "baseline_order").reindex(baseline_order=orders)
    peak, phase = (of_lines[str(name)].values for name in of_orders)
    return np.where(np.isnan(peak), 0.0, peak), phase == 1.0


def _order(name: str) -> float:
    return float(name.removeprefix("order ")) if name.startswith("order ") else np.nan


def _noise(sound: Ingredients, bands: Array) -> Array:
    square = np.zeros(bands.size)
    for centre, pressure in zip(sound.bands.centre_hz, sound.bands.pressure_pa, strict=True):
        square[np.argmin(np.abs(np.log(bands / centre)))] += pressure**2
    return square


def _loud(pressure: ComplexArray, frequency_hz: Array) -> NDArray[np.bool_]:
    """Whether a line matters anywhere, shape (line,)."""
    square = np.abs(pressure) ** 2
    loud = np.zeros(frequency_hz.size, dtype=bool)
    for weighted in (square, square * _a_power(frequency_hz)):
        total = weighted.sum(axis=-1, keepdims=True)
        loud |= np.any(weighted > QUIET * total, axis=(0, 1))
    return loud


def _squares(pressure: ComplexArray, frequency_hz: Array) -> Array:
    return np.asarray(0.5 * np.abs(pressure) ** 2 @ _a_power(frequency_hz))


def _a_power(frequency_hz: Array) -> Array:
    return power_of_level(WEIGHTING["A"](frequency_hz))


def _energy(level_db: Array) -> Array:
    return REFERENCE_PRESSURE_PA**2 * power_of_level(level_db)
