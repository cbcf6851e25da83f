"""Tracked orders as plain text and CSV."""

from typing import Final

import xarray as xr

from ..base import rounding
from .order_tables import WIDEST_CHANNEL
from .tables import Columns, Record, dataset_csv, phase_deg, records, table_of, to_text

_COLUMNS: Final[Columns] = (
    ("Channel", "channel", str),
    ("unit", "unit", str),
    ("Order", "order", "{:g}".format),
    ("Largest peak", "peak", rounding.significant),
    ("at s", "time_s", "{:.2f}".format),
    ("at rpm", "speed_rpm", "{:.0f}".format),
)


def tracked_text(tracked: xr.Dataset) -> str:
    """Where the speed comes from, and where each order is largest."""
    caption = "Tracked orders: where each is largest"
    table = table_of(caption, _peaks(tracked), _COLUMNS, frozenset({0, 1}))
    attrs = tracked.attrs
    facts = [
        f"speed: {attrs['speed_source']}",
        f"bandwidth: {attrs['bandwidth_hz']:g} Hz, {attrs['poles']} poles; noise within it grows "
        f"by up to {attrs['noise_gain']:.2g}",
        "",
    ]
    return "\n".join([*facts, to_text(table, WIDEST_CHANNEL)])


def tracked_csv(tracked: xr.Dataset) -> bytes:
    """Amplitude and phase of every tracked order of every channel over the time."""
    columns = {
        "channel": tracked["channel"],
        "unit": tracked["channel_unit"],
        "order": tracked["order"],
        "time_s": tracked["track_time"],
        "speed_rpm": tracked["track_speed"],
        "amplitude_peak": abs(tracked["tracked_order"]),
        "phase_deg": phase_deg(tracked["tracked_order"]),
    }
    return dataset_csv(("channel", "order", "track_time"), columns)


def _peaks(tracked: xr.Dataset) -> list[Record]:
    """Where each order of a channel is largest."""
    size = abs(tracked["tracked_order"])
    at = size.isel(track_time=size.argmax("track_time"))
    columns = {
        "channel": tracked["channel"],
        "unit": tracked["channel_unit"],
        "order": tracked["order"],
        "peak": at,
        "time_s": at["track_time"],
        "speed_rpm": at["track_speed"],
    }
    return records(("channel", "order"), columns)
