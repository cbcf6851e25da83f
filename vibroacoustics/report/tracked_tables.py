"""Tracked orders as plain text and CSV."""

from collections.abc import Iterator
from typing import Final, NamedTuple

import numpy as np
import xarray as xr

from ..base import rounding
from .tables import Table, to_csv, to_text

_WIDEST_CHANNEL: Final = 32


class _Peak(NamedTuple):
    """Where an order of a channel is largest."""

    channel: str
    unit: str
    order: float
    peak: float
    time_s: float
    speed_rpm: float


def tracked_text(tracked: xr.Dataset) -> str:
    """Where the speed comes from, and where each order is largest."""
    rows = tuple(
        (
            row.channel,
            row.unit,
            f"{row.order:g}",
            rounding.significant(row.peak),
            f"{row.time_s:.2f}",
            f"{row.speed_rpm:.0f}",
        )
        for row in _peaks(tracked)
    )
    head = ("Channel", "unit", "Order", "Largest peak", "at s", "at rpm")
    table = Table("Tracked orders: where each is largest", head, rows, frozenset({0, 1}))
    attrs = tracked.attrs
    facts = [
        f"speed: {attrs['speed_source']}",
        f"bandwidth: {attrs['bandwidth_hz']:g} Hz, {attrs['poles']} poles; noise within it grows "
        f"by up to {attrs['noise_gain']:.2g}",
        "",
    ]
    return "\n".join([*facts, to_text(table, _WIDEST_CHANNEL)])


def tracked_csv(tracked: xr.Dataset) -> bytes:
    """Amplitude and phase of every tracked order of every channel over the time."""
    head = ("channel", "unit", "order", "time_s", "speed_rpm", "amplitude_peak", "phase_deg")
    return to_csv(head, _rows(tracked))


def _peaks(tracked: xr.Dataset) -> Iterator[_Peak]:
    for channel in tracked["channel"].values:
        for order in tracked["order"].values:
            size = abs(tracked["tracked_order"].sel(channel=channel, order=order))
            at = size.isel(track_time=int(np.argmax(size.values)))
            yield _Peak(
                str(channel),
                str(at["channel_unit"].item()),
                float(order),
                float(at),
                float(at["track_time"]),
                float(at["track_speed"]),
            )


def _rows(tracked: xr.Dataset) -> Iterator[tuple[str | float, ...]]:
    times, speeds = tracked["track_time"].values, tracked["track_speed"].values
    for channel in tracked["channel"].values:
        of_channel = tracked["tracked_order"].sel(channel=channel)
        unit = str(of_channel["channel_unit"].item())
        for order in of_channel["order"].values:
            values = of_channel.sel(order=order).values
            sizes, phases = np.abs(values), np.rad2deg(np.angle(values))
            for row in zip(times, speeds, sizes, phases, strict=True):
                yield (str(channel), unit, float(order), *map(float, row))
