"""Orders and third octaves of a recording as rows of a baseline."""

from typing import Any, Final

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import level_of_power, mean_square_level, power_of_level
from ..base.units import shaft_frequency_hz
from ..base.vocabulary import NO_ANGLE_ZERO
from .narrow_spectra import BANDS

LEAST_COHERENCE: Final = 0.8
"""Coherence of an order whose phase counts; noise in five independent blocks reaches it once in 600
times."""

Row = dict[str, Any]
"""Values of `BaselineSpectrum` or `BaselineOrders`."""


def of_each_speed(results: xr.Dataset) -> xr.Dataset:
    """Results with one operating point a speed: of several branches that of the most blocks.

    Parameters
    ----------
    results : result of `analyse_orders`, or mean of several
    """
    if "block_count" not in results.coords:
        return results.drop_duplicates("speed")
    ranked = results.isel(speed=np.argsort(-results["block_count"].values, kind="stable"))
    return ranked.drop_duplicates("speed").sortby("speed")


def order_row(results: xr.Dataset, channel: str, key: tuple[str, float], apart: Row | None) -> Row:
    """Orders at a speed: the coherent mean where the phase held, else the power above the noise.

    Parameters
    ----------
    results : result of `analyse_orders`
    channel : name
    key : microphone and speed
    apart : orders taken out of the narrow band there; the RMS in an order's band stands for others
    """
    spectrum = results.sel(channel=channel, speed=key[1])
    spectrum = spectrum.isel(order=spectrum["order"].values > 0.0)
    orders = spectrum["order"].values.tolist()
    peak = spectrum["channel_order"].values
    has_mark = str(results.attrs.get("angle_zero", NO_ANGLE_ZERO)) != NO_ANGLE_ZERO
    held = (spectrum["channel_order_coherence"].values >= LEAST_COHERENCE) & has_mark
    tone = _tones(orders, apart)
    power = np.where(np.isnan(tone), spectrum["channel_order_rms"].values ** 2, tone)
    square = np.where(held, 0.5 * np.abs(peak) ** 2, power)
    phase = zip(np.angle(peak).tolist(), held.tolist(), strict=True)
    return {
        "microphone": key[0],
        "speed_rpm": key[1],
        "order": tuple(orders),
        "level_db": tuple(mean_square_level(square, REFERENCE_PRESSURE_PA).tolist()),
        "phase_rad": tuple(value if has_phase else None for value, has_phase in phase),
    }


def _tones(orders: list[float], apart: Row | None) -> Array:
    """Mean square of each order above the noise beside it, Pa²; not a number where unknown."""
    level_of_order = (
        {} if apart is None else dict(zip(apart["order"], apart["level_db"], strict=True))
    )
    level = np.array([level_of_order.get(order, np.nan) for order in orders])
    return np.asarray(REFERENCE_PRESSURE_PA**2 * power_of_level(level))


def band_row(row: Row, orders: Row, apart: Row | None, steady: xr.DataArray | None) -> Row:
    """Third octaves without the orders, also those that the narrow band did not separate.

    Parameters
    ----------
    row : third octaves of the narrow band
    orders : all that were measured there
    apart : those that are taken off the row already
    steady : levels of the whole recording by band, for bands that the row has not; none of a run-up
    """
    power = dict(zip(row["band_hz"], power_of_level(np.array(row["level_db"])), strict=True))
    orders_apart = set() if apart is None else set(apart["order"])
    remaining_power = {name: float(value) for name, value in power.items()}
    hertz = np.array(orders["order"]) * shaft_frequency_hz(row["speed_rpm"])
    tone = power_of_level(np.array(orders["level_db"]))
    in_row = np.array([order not in orders_apart for order in orders["order"]])
    for band in BANDS:
        within = (hertz >= band.lower_hz) & (hertz < band.upper_hz)
        if band.nominal_hz in power:
            off = tone[within & in_row].sum()
        elif steady is not None and band.nominal_hz in steady["band"].values:
            remaining_power[band.nominal_hz] = power_of_level(
                steady.sel(band=band.nominal_hz).item()
            )
            off = tone[within].sum()
        else:
            continue
        remaining_power[band.nominal_hz] = max(remaining_power[band.nominal_hz] - float(off), 0.0)
    rising = sorted(remaining_power)
    levels = tuple(float(level_of_power(remaining_power[name])) for name in rising)
    return row | {"band_hz": tuple(rising), "level_db": levels}
