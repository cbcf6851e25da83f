"""Orders of two results beside each other: those that matter, and all of them as columns."""

from collections.abc import Iterable, Iterator
from functools import partial
from itertools import groupby
from operator import itemgetter
from typing import Final

import numpy as np
import xarray as xr

from ...base import rounding
from ...base.decibel import level_of_amplitude
from ...base.vocabulary import NO_ANGLE_ZERO
from ..order_tables import amplitude, shown_speeds
from ..tables import Columns, DataTable, Record, Table, data_table, records, table_of
from .orders import WITHIN_DB

LOUD_DB: Final = 20.0
"""Orders no further below the strongest of their channel and speed are printed."""
CHANGED_DB: Final = 0.5
"""So are those that differ by more, no further below than `WITHIN_DB`."""
MOST_ORDERS: Final = 12
"""Of a channel at a speed, the strongest."""


_COLUMNS: Final[Columns] = (
    ("Channel", "channel", str),
    ("of B", "other_channel", str),
    ("unit", "unit", str),
    ("rpm", "speed_rpm", "{:.0f}".format),
    ("of B", "other_speed_rpm", "{:.0f}".format),
    ("Order", "order", "{:g}".format),
    ("Peak A", "amplitude_peak", amplitude),
    ("peak B", "other_amplitude_peak", amplitude),
    ("B - A, dB", "difference_db", partial(rounding.signed, decimals=2)),
    ("phase, °", "phase_difference_deg", rounding.signed),
    ("coherence", "coherence", partial(rounding.fixed, decimals=3)),
)


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
    return table_of(caption, rows, _COLUMNS, frozenset({0, 1, 2}))


def compared_facts(compared: xr.Dataset) -> list[str]:
    """Say what the results are, and where their phases count from."""
    return [_compared_fact(compared, name) for name in ("first", "second")]


def _compared_fact(compared: xr.Dataset, name: str) -> str:
    """What one of the results is, and where its phases count from."""
    angle_zero = compared.attrs[f"{name}_angle_zero"]
    fact = f"{compared.attrs[name]}; crank angle zero: {angle_zero}"
    return f"{fact}, peaks from the RMS in the bands" if angle_zero == NO_ANGLE_ZERO else fact


def compared_data(compared: xr.Dataset) -> DataTable:
    """Return every pair of orders."""
    columns = {
        "channel": compared["channel"],
        "other_channel": compared["compared_channel"],
        "unit": compared["channel_unit"],
        "speed_rpm": compared["speed"],
        "other_speed_rpm": compared["compared_speed"],
        "order": compared["order"],
        "amplitude_peak": abs(compared["channel_order"]),
        "other_amplitude_peak": abs(compared["compared_order"]),
        "difference_db": compared["order_difference"],
        "phase_difference_deg": np.rad2deg(1.0) * compared["order_phase_difference"],
        "coherence": compared["channel_order_coherence"],
    }
    return data_table(("channel", "speed", "order"), columns)


def _that_matter(rows: Iterable[Record]) -> Iterator[Record]:
    """Of each channel and speed the orders that are strong, or strong enough and different."""
    for _, group in groupby(rows, key=itemgetter("channel", "speed_rpm")):
        known = [row for row in group if np.isfinite(row["difference_db"])]
        strongest = max((_peak(row) for row in known), default=0.0)
        chosen = [row for row in known if _matters(row, strongest)]
        printed = {row["order"] for row in sorted(chosen, key=_peak, reverse=True)[:MOST_ORDERS]}
        yield from (row for row in chosen if row["order"] in printed)


def _matters(row: Record, strongest: float) -> bool:
    below_db = -level_of_amplitude(_peak(row) / strongest) if strongest > 0.0 else 0.0
    differs = abs(row["difference_db"]) > CHANGED_DB
    return bool(below_db <= LOUD_DB or (differs and below_db <= WITHIN_DB))


def _peak(row: Record) -> float:
    """The larger of both."""
    return float(max(row["amplitude_peak"], row["other_amplitude_peak"]))
