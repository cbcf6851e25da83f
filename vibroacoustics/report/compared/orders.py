"""Orders of two results beside each other, in levels and amplitudes."""

from typing import Final

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ...base import rounding
from ...base.arrays import Array
from ...base.constants import REFERENCE_PRESSURE_PA
from ...base.decibel import level_of_amplitude
from ..order_tables import amplitude, shown_speeds
from ..tables import Table

WITHIN_DB: Final = 40.0
"""Orders further below the loudest of their channel are left to the CSV."""


def is_pressure(compared: xr.Dataset) -> list[bool]:
    """Which channels are of sound pressure."""
    return [str(unit) == "Pa" for unit in compared["channel_unit"].values]


def orders_table(compared: xr.Dataset, channel: str) -> Table:
    """Orders of a channel in both results; of sound pressure in dB re 20 µPa."""
    there = compared.sel(channel=channel)
    unit, drawn = str(there["channel_unit"].item()), "order_run_deviation" in compared
    rows = []
    for speed in sorted(shown_speeds(compared)):
        at_speed = there.sel(speed=speed)
        for order in loud_orders(at_speed):
            one = at_speed.sel(order=order)
            rows.append(
                (
                    f"{speed:.0f}",
                    f"{order:g}×",
                    _size(float(one["channel_order_rms"]), unit),
                    _size(float(one["compared_order_rms"]), unit),
                    rounding.signed(float(one["order_difference"]), 2),
                    rounding.signed(float(np.degrees(one["order_phase_difference"])), 0),
                    rounding.fixed(float(one["channel_order_coherence"]), 2),
                    *(_scatter(one) if drawn else ()),
                )
            )
    of_unit = "dB re 20 µPa" if unit == "Pa" else f"RMS, {unit}"
    head = ["rpm", "Order", f"A, {of_unit}", f"B, {of_unit}", "B − A, dB", "phase, °", "coherence"]
    if drawn:
        head += ["runs ±, dB", "specimens ±, dB", "u of the mean, dB"]
    other = str(there["compared_channel"].item())
    name = channel if other == channel else f"{channel}, of B {other}"
    caption = f"{name}: orders within {WITHIN_DB:g} dB of the strongest; coherence of the weaker"
    return Table(caption, tuple(head), tuple(rows), frozenset({0, 1}))


def known_channels(compared: xr.Dataset) -> list[str]:
    """Channels with an order that both results have, microphones first."""
    known = compared["order_difference"].notnull().any(("speed", "order")).values
    names = [
        (not pressure, str(name))
        for name, pressure, has in zip(
            compared["channel"].values, is_pressure(compared), known, strict=True
        )
        if has
    ]
    return [name for _, name in sorted(names, key=lambda one: one[0])]


def summary(compared: xr.Dataset) -> str:
    """How far the results are apart where they are loud."""
    difference = compared["order_difference"].values
    loud = _loud(compared)
    if not loud.any():
        return "The results have no order in common that stands out of rounding."
    size = np.where(loud, np.abs(difference), -1.0)
    worst = np.unravel_index(int(size.argmax()), size.shape)
    channel, speed, order = (
        compared[dim].values[at]
        for dim, at in zip(("channel", "speed", "order"), worst, strict=True)
    )
    middle = rounding.fixed(float(np.median(size[loud])), 2)
    return (
        f"Of {int(loud.sum())} orders within {WITHIN_DB:g} dB of the strongest of their channel at "
        f"their speed, B differs from A by {middle} dB in the middle, most in order {order:g} of "
        f"{channel} at {speed:.0f} rpm, {rounding.signed(float(difference[worst]))} dB."
    )


def loud_orders(at_speed: xr.Dataset) -> Array:
    """Known orders of a channel at a speed that are within a range of its strongest."""
    return np.asarray(at_speed["order"].values[_loud(at_speed)])


def _loud(compared: xr.Dataset) -> NDArray[np.bool_]:
    """Known orders within a range of the strongest of channel and speed, shape (..., order)."""
    rms = np.maximum(compared["channel_order_rms"].values, compared["compared_order_rms"].values)
    strongest = rms.max(axis=-1, keepdims=True)
    ratio = rms / np.where(strongest > 0.0, strongest, 1.0)
    known = np.isfinite(compared["order_difference"].values)
    return np.asarray(known & (level_of_amplitude(ratio) > -WITHIN_DB))


def _size(rms: float, unit: str) -> str:
    if unit == "Pa":
        return rounding.level(float(level_of_amplitude(rms / REFERENCE_PRESSURE_PA)))
    return amplitude(rms)


def _scatter(one: xr.Dataset) -> list[str]:
    names = ("run_deviation", "specimen_deviation", "mean_uncertainty")
    return [rounding.fixed(float(one[f"order_{name}"]), 2) for name in names]
