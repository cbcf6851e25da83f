"""Orders of two results beside each other: those that matter, and all of them as columns."""

from collections.abc import Iterable, Iterator
from functools import partial
from itertools import groupby
from operator import itemgetter
from typing import Final

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ...base import rounding
from ...base.arrays import Array
from ...base.constants import REFERENCE_PRESSURE_PA
from ...base.decibel import level_of_amplitude
from ...base.vocabulary import NO_ANGLE_ZERO
from ..operating_points import branch_column, branched_table, shown_points, shown_speeds
from ..tables import Columns, DataTable, Record, Table, amplitude, data_table, records

WITHIN_DB: Final = 40.0
"""Orders further below the loudest of their channel are left to the CSV."""
LOUD_DB: Final = 20.0
"""Orders no further below the strongest of their channel and speed are printed."""
CHANGED_DB: Final = 0.5
"""Difference from which orders are loud too, no further below than `WITHIN_DB`."""
MOST_ORDERS: Final = 12
"""Printed orders of a channel at a speed: the strongest."""
_RESULTS: Final = ("channel", "compared")
_SCATTER: Final = ("order_run_deviation", "order_specimen_deviation", "order_mean_uncertainty")
_COLUMNS: Final[Columns] = (
    ("Channel", "channel", str),
    ("of B", "other_channel", str),
    ("unit", "unit", str),
    ("rpm", "speed_rpm", "{:.0f}".format),
    ("of B", "other_speed_rpm", "{:.0f}".format),
    ("branch", "branch", str),
    ("Order", "order", "{:g}".format),
    ("Peak A", "amplitude_peak", amplitude),
    ("peak B", "other_amplitude_peak", amplitude),
    ("B - A, dB", "difference_db", partial(rounding.signed, decimals=2)),
    ("phase, °", "phase_difference_deg", rounding.signed),
    ("coherence", "coherence", partial(rounding.fixed, decimals=3)),
)


def is_pressure(compared: xr.Dataset) -> list[bool]:
    """Return which channels are of sound pressure."""
    return [str(unit) == "Pa" for unit in compared["channel_unit"].values]


def orders_table(compared: xr.Dataset, channel: str) -> Table:
    """Orders of a channel in both results; of sound pressure in dB re 20 µPa."""
    at_channel = compared.sel(channel=channel)
    unit, is_repeated = str(at_channel["channel_unit"].item()), "order_run_deviation" in compared
    rows = []
    for at_speed, point in shown_points(at_channel):
        for order in loud_orders(at_speed):
            at_order = at_speed.sel(order=order)
            sizes = (_size(at_order[f"{name}_order_rms"].item(), unit) for name in _RESULTS)
            changes = (
                rounding.signed(at_order["order_difference"].item(), 2),
                rounding.signed(float(np.degrees(at_order["order_phase_difference"])), 0),
            )
            fixed = ["channel_order_coherence", *(_SCATTER if is_repeated else ())]
            others = (rounding.fixed(at_order[name].item(), 2) for name in fixed)
            rows.append((point.replace(" rpm", ""), f"{order:g}×", *sizes, *changes, *others))
    of_unit = "dB re 20 µPa" if unit == "Pa" else f"RMS, {unit}"
    head = ["rpm", "Order", f"A, {of_unit}", f"B, {of_unit}", "B − A, dB", "phase, °", "coherence"]
    if is_repeated:
        head += ["runs ±, dB", "specimens ±, dB", "u of the mean, dB"]
    other = str(at_channel["compared_channel"].item())
    name = channel if other == channel else f"{channel}, of B {other}"
    caption = f"{name}: orders within {WITHIN_DB:g} dB of the strongest; coherence of the weaker"
    return Table(caption, tuple(head), tuple(rows), frozenset({0, 1}))


def known_channels(compared: xr.Dataset) -> list[str]:
    """Channels with an order that both results have, microphones first."""
    is_compared = compared["order_difference"].notnull().any(("speed", "order")).values
    pressure = np.array(is_pressure(compared), dtype=bool)
    names = [compared["channel"].values[is_compared & first] for first in (pressure, ~pressure)]
    return [str(name) for name in np.concatenate(names)]


def summary(compared: xr.Dataset) -> str:
    """Say how far the results are apart where they are loud."""
    difference = compared["order_difference"].values
    loud = _loud(compared)
    if not loud.any():
        return "The results have no order in common that stands out of rounding."
    size = np.where(loud, np.abs(difference), -1.0)
    worst = np.unravel_index(int(size.argmax()), size.shape)
    channel, speed, order = (
        compared[dim].values[index]
        for dim, index in zip(("channel", "speed", "order"), worst, strict=True)
    )
    middle = rounding.fixed(float(np.median(size[loud])), 2)
    return (
        f"B differs from A by {middle} dB (median of {int(loud.sum())} orders within "
        f"{WITHIN_DB:g} dB of the strongest of their channel at their speed). The largest "
        f"difference is that of order {order:g} of {channel} at {speed:.0f} rpm: "
        f"{rounding.signed(float(difference[worst]))} dB."
    )


def loud_orders(at_speed: xr.Dataset) -> Array:
    """Known orders of a channel at a speed that are within a range of its strongest."""
    return np.asarray(at_speed["order"].values[_loud(at_speed)])


def _loud(compared: xr.Dataset) -> NDArray[np.bool_]:
    """Known orders within a range of the strongest of channel and speed, shape (..., order)."""
    rms = np.maximum(compared["channel_order_rms"].values, compared["compared_order_rms"].values)
    strongest = rms.max(axis=-1, keepdims=True)
    ratio = rms / np.where(strongest > 0.0, strongest, 1.0)
    is_compared = np.isfinite(compared["order_difference"].values)
    return np.asarray(is_compared & (level_of_amplitude(ratio) > -WITHIN_DB))


def _size(rms: float, unit: str) -> str:
    if unit == "Pa":
        return rounding.level(float(level_of_amplitude(rms / REFERENCE_PRESSURE_PA)))
    return amplitude(rms)


def matching_orders(compared: xr.Dataset) -> Table:
    """Return the orders that matter of those that both results have, with their differences."""
    every = records(compared_data(compared))
    shown = shown_speeds(compared)
    rows = list(_that_matter(row for row in every if row["speed_rpm"] in shown))
    caption = "B against A: level and phase of each order; coherence is the lower of both"
    if len(rows) < len(every):
        caption += (
            f"; {len(rows)} of {len(every)} rows, those within {LOUD_DB:g} dB of the strongest or "
            f"with more than {CHANGED_DB:g} dB between A and B; all in the CSV"
        )
    return branched_table(caption, rows, _COLUMNS, frozenset({0, 1, 2}), compared)


def compared_facts(compared: xr.Dataset) -> list[str]:
    """Say what the results are, and where their phases count from."""
    zeros = [(compared.attrs[name], compared.attrs[f"{name}_angle_zero"]) for name in
             ("first", "second")]  # fmt: skip
    from_bands = ", peaks from the RMS in the bands"
    return [f"{name}; crank angle zero: {zero}{from_bands if zero == NO_ANGLE_ZERO else ''}"
            for name, zero in zeros]  # fmt: skip


def compared_data(compared: xr.Dataset) -> DataTable:
    """Return every pair of orders."""
    columns = {
        "channel": compared["channel"],
        "other_channel": compared["compared_channel"],
        "unit": compared["channel_unit"],
        "speed_rpm": compared["speed"],
        "other_speed_rpm": compared["compared_speed"],
        **branch_column(compared),
        "order": compared["order"],
        "amplitude_peak": abs(compared["channel_order"]),
        "other_amplitude_peak": abs(compared["compared_order"]),
        "difference_db": compared["order_difference"],
        "phase_difference_deg": np.rad2deg(1.0) * compared["order_phase_difference"],
        "coherence": compared["channel_order_coherence"],
    }
    return data_table(("channel", "speed", "order"), columns)


def _that_matter(rows: Iterable[Record]) -> Iterator[Record]:
    """Return the strong orders of each channel and speed, and weaker ones that differ."""
    for _, group in groupby(rows, key=itemgetter("channel", "speed_rpm")):
        compared_rows = [row for row in group if np.isfinite(row["difference_db"])]
        strongest = max((_peak(row) for row in compared_rows), default=0.0)
        chosen = [row for row in compared_rows if _matters(row, strongest)]
        printed = {row["order"] for row in sorted(chosen, key=_peak, reverse=True)[:MOST_ORDERS]}
        yield from (row for row in chosen if row["order"] in printed)


def _matters(row: Record, strongest: float) -> bool:
    below_db = -level_of_amplitude(_peak(row) / strongest) if strongest > 0.0 else 0.0
    differs = abs(row["difference_db"]) > CHANGED_DB
    return bool(below_db <= LOUD_DB or (differs and below_db <= WITHIN_DB))


def _peak(row: Record) -> float:
    """The larger of both."""
    return float(max(row["amplitude_peak"], row["other_amplitude_peak"]))
