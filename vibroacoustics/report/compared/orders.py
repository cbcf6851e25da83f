"""Orders of two results beside each other, in levels and amplitudes."""

from typing import Final

import numpy as np
import xarray as xr

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
    sizes, worst = [], (0.0, "")
    for channel in known_channels(compared):
        there = compared.sel(channel=channel)
        for speed in there["speed"].values:
            at_speed = there.sel(speed=speed)
            for order in loud_orders(at_speed):
                difference = float(at_speed["order_difference"].sel(order=order))
                sizes.append(abs(difference))
                words = f"order {order:g} of {channel} at {speed:.0f} rpm"
                worst = max(worst, (abs(difference), f"{words}, {rounding.signed(difference)} dB"))
    if not sizes:
        return "The results have no order in common that stands out of rounding."
    middle = rounding.fixed(float(np.median(sizes)), 2)
    text = (
        f"Of {len(sizes)} orders within {WITHIN_DB:g} dB of the strongest of their channel, B "
        f"differs from A by {middle} dB in the middle"
    )
    return f"{text}, most in {worst[1]}." if worst[1] else f"{text}."


def loud_orders(at_speed: xr.Dataset) -> Array:
    """Known orders of a channel at a speed that are within a range of its strongest."""
    rms = np.maximum(at_speed["channel_order_rms"].values, at_speed["compared_order_rms"].values)
    known = np.isfinite(at_speed["order_difference"].values)
    loud = level_of_amplitude(rms / max(float(rms.max()), 1e-300)) > -WITHIN_DB
    return np.asarray(at_speed["order"].values[known & loud])


def _size(rms: float, unit: str) -> str:
    if unit == "Pa":
        return rounding.level(float(level_of_amplitude(rms / REFERENCE_PRESSURE_PA)))
    return amplitude(rms)


def _scatter(one: xr.Dataset) -> list[str]:
    names = ("run_deviation", "specimen_deviation", "mean_uncertainty")
    return [rounding.fixed(float(one[f"order_{name}"]), 2) for name in names]
