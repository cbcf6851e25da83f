"""Orders of two results beside each other as plain text and CSV."""

from collections.abc import Iterable, Iterator
from itertools import groupby
from typing import Final, NamedTuple

import numpy as np
import xarray as xr

from ...base import rounding
from ...base.decibel import level_of_amplitude
from ...base.vocabulary import NO_ANGLE_ZERO
from ..order_tables import WIDEST_CHANNEL, amplitude, labels_of_orders, shown_speeds
from ..tables import Table, to_csv, to_text
from .orders import WITHIN_DB

LOUD_DB: Final = 20.0
"""Orders no further below the strongest of their channel and speed are printed."""
CHANGED_DB: Final = 0.5
"""So are those that differ by more, no further below than `WITHIN_DB`."""
MOST_ORDERS: Final = 12
"""Of a channel at a speed, the strongest."""


class _ComparedOrder(NamedTuple):
    """A row of compared_orders.csv; the fields are its head."""

    channel: str
    other_channel: str
    unit: str
    speed_rpm: float
    other_speed_rpm: float
    order: float
    amplitude_peak: float
    other_amplitude_peak: float
    difference_db: float
    phase_difference_deg: float
    coherence: float


def comparison_of_orders_text(compared: xr.Dataset) -> str:
    """Table of the orders that matter of those that both results have, with their differences."""
    every = list(_compared_rows(compared))
    shown = shown_speeds(compared)
    rows = tuple(
        (
            row.channel,
            row.other_channel,
            row.unit,
            f"{row.speed_rpm:.0f}",
            f"{row.other_speed_rpm:.0f}",
            f"{row.order:g}",
            amplitude(row.amplitude_peak),
            amplitude(row.other_amplitude_peak),
            rounding.signed(row.difference_db, 2),
            rounding.signed(row.phase_difference_deg, 1),
            rounding.fixed(row.coherence, 3),
        )
        for row in _that_matter(row for row in every if row.speed_rpm in shown)
    )
    head = (
        "Channel", "of B", "unit", "rpm", "of B", "Order", "Peak A", "peak B", "B - A, dB",
        "phase, °", "coherence",
    )  # fmt: skip
    facts = [*(_compared_fact(compared, name) for name in ("first", "second")), ""]
    caption = "B against A: level and phase of each order; coherence is the lower of both"
    if len(rows) < len(every):
        caption += (
            f"; {len(rows)} of {len(every)} rows, those within {LOUD_DB:g} dB of the strongest or "
            f"with more than {CHANGED_DB:g} dB between A and B; all in the CSV"
        )
    table = Table(caption, head, rows, frozenset({0, 1, 2}))
    return "\n".join([*facts, to_text(table, WIDEST_CHANNEL)])


def comparison_of_orders_csv(compared: xr.Dataset) -> bytes:
    """Every pair of orders."""
    return to_csv(_ComparedOrder._fields, _compared_rows(compared))


def _compared_fact(compared: xr.Dataset, name: str) -> str:
    """What one of the results is, and where its phases count from."""
    angle_zero = compared.attrs[f"{name}_angle_zero"]
    fact = f"{compared.attrs[name]}; crank angle zero: {angle_zero}"
    return f"{fact}, peaks from the RMS in the bands" if angle_zero == NO_ANGLE_ZERO else fact


def _compared_rows(compared: xr.Dataset) -> Iterator[_ComparedOrder]:
    for at in labels_of_orders(compared):
        of_order = compared.sel(at)
        yield _ComparedOrder(
            channel=str(at["channel"]),
            other_channel=str(of_order["compared_channel"].item()),
            unit=str(of_order["channel_unit"].item()),
            speed_rpm=float(at["speed"]),
            other_speed_rpm=float(of_order["compared_speed"]),
            order=float(at["order"]),
            amplitude_peak=abs(complex(of_order["channel_order"].item())),
            other_amplitude_peak=abs(complex(of_order["compared_order"].item())),
            difference_db=float(of_order["order_difference"]),
            phase_difference_deg=float(np.degrees(of_order["order_phase_difference"])),
            coherence=float(of_order["channel_order_coherence"]),
        )


def _that_matter(rows: Iterable[_ComparedOrder]) -> Iterator[_ComparedOrder]:
    """Of each channel and speed the orders that are strong, or strong enough and different."""
    for _, group in groupby(rows, key=lambda row: (row.channel, row.speed_rpm)):
        known = [row for row in group if np.isfinite(row.difference_db)]
        strongest = max((_peak(row) for row in known), default=0.0)
        chosen = [row for row in known if _matters(row, strongest)]
        printed = {row.order for row in sorted(chosen, key=_peak, reverse=True)[:MOST_ORDERS]}
        yield from (row for row in chosen if row.order in printed)


def _matters(row: _ComparedOrder, strongest: float) -> bool:
    below_db = -level_of_amplitude(_peak(row) / strongest) if strongest > 0.0 else 0.0
    differs = abs(row.difference_db) > CHANGED_DB
    return bool(below_db <= LOUD_DB or (differs and below_db <= WITHIN_DB))


def _peak(row: _ComparedOrder) -> float:
    """The larger of both."""
    return max(row.amplitude_peak, row.other_amplitude_peak)
