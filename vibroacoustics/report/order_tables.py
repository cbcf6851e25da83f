"""Tables of orders and levels of a recording."""

from collections.abc import Iterator
from functools import partial
from itertools import product
from typing import Final

import numpy as np
import xarray as xr

from ..base import rounding
from ..results.number import number
from .bands import fixed
from .tables import (
    Cell,
    Columns,
    DataTable,
    Table,
    columns_of,
    data_table,
    phase_deg,
    records,
    table_of,
)

_MOST_SPEEDS: Final = 6
"""Operating points in the text; all are in the CSV."""
_MOST_FAULTS: Final = 5
"""Faults of the tacho that are listed; all are counted."""
_LEAST_COHERENCE: Final = 0.8
"""Of an order whose phase is told; noise in five independent blocks reaches it once in 600 times,
0.2^(5 - 1)."""
_LEVELS: Final = ("equivalent_level", "fast_maximum_level", "slow_maximum_level")


_DIMENSIONS: Final = ("channel", "speed", "order")


def amplitude(value: float) -> str:
    """Four digits of any unit: accelerations in m/s² and displacements in m alike."""
    return f"{value:.4g}"


_COLUMNS: Final[Columns] = (
    ("Channel", "channel", str),
    ("unit", "unit", str),
    ("rpm", "speed_rpm", "{:.0f}".format),
    ("blocks", "blocks", "{:.0f}".format),
    ("Order", "order", "{:g}".format),
    ("Peak", "amplitude_peak", amplitude),
    ("phase, °", "known_phase_deg", rounding.fixed),
    ("RMS in band", "rms_in_band", amplitude),
    ("coherence", "coherence", partial(rounding.fixed, decimals=3)),
)


def orders_facts(results: xr.Dataset) -> list[str]:
    """Where the speed comes from, and how finely orders are resolved."""
    attrs = results.attrs
    facts = [
        f"speed: {attrs['speed_source']}",
        f"crank angle zero: {attrs['angle_zero']}",
        f"resolution: {attrs['resolution_order']:.3g} orders (noise bandwidth), blocks of "
        f"{attrs['revolutions_per_block']} revolutions, {attrs['window']} window",
    ]
    if "fault_time" in results:
        facts.append(_faults_line(results["fault_time"]))
    if "left_out" in attrs:
        facts.append(f"left out: {attrs['left_out']}")
    return facts


def orders_tables(results: xr.Dataset) -> list[Table]:
    """Orders at some operating points, and levels of sound pressure where there are some."""
    tables = [_orders_table(results)]
    if "equivalent_level" in results:
        tables.append(_levels_table(results))
    return tables


def orders_data(results: xr.Dataset) -> DataTable:
    """Every order of every channel at every operating point."""
    return data_table(_DIMENSIONS, _orders(results))


def levels_data(results: xr.Dataset) -> DataTable:
    """Leq, LFmax, LSmax and third-octave levels of every channel of sound pressure.

    Column `left_out_s`: what is left out at either end of the recording; `bands`: "sums" of the
    lines within a third octave, or "filters" of IEC 61260-1.
    """
    names = ("leq_db", "lfmax_db", "lsmax_db", "left_out_s", "bands")
    bands = [f"leq_{band:g}_hz_db" for band in results["band"].values]
    rows: list[list[str | float]] = []
    for channel, weighting in _level_rows(results):
        levels = results.sel(channel=channel, weighting=weighting)
        rows.append(
            [
                channel,
                weighting,
                *(float(levels[name]) for name in _LEVELS),
                _left_out_s(results, weighting),
                str(results.attrs.get("band_method", "sums")),
                *map(float, levels.band_level),
            ]
        )
    return columns_of(("channel", "weighting", *names, *bands), rows)


def _left_out_s(results: xr.Dataset, weighting: str) -> float:
    """What a level leaves out at either end: the run-in of the weighting's filter."""
    return 0.0 if weighting == "Z" else float(results.attrs.get("levels_left_out_s", 0.0))


def _faults_line(times: xr.DataArray) -> str:
    kinds = [str(name).split()[1] for name in times["fault"].values]
    counts = ", ".join(f"{kinds.count(kind)} {kind}" for kind in sorted(set(kinds)))
    shown = [f"{kind} at {time:.3f} s" for kind, time in zip(kinds, times.values, strict=True)]
    more = ["…"] if len(shown) > _MOST_FAULTS else []
    return f"tacho faults: {counts} ({', '.join(shown[:_MOST_FAULTS] + more)})"


def _orders(results: xr.Dataset) -> dict[str, xr.DataArray]:
    """Columns of orders.csv."""
    peak = results["channel_order"]
    return {
        "channel": results["channel"],
        "unit": results["channel_unit"],
        "speed_rpm": results["speed"],
        "blocks": results["block_count"],
        "order": results["order"],
        "frequency_hz": results["order"] * results["speed"] / 60.0,
        "amplitude_peak": abs(peak),
        "phase_deg": phase_deg(peak),
        "rms_in_band": results["channel_order_rms"],
        "coherence": results["channel_order_coherence"],
    }


def _orders_table(results: xr.Dataset) -> Table:
    shown = shown_speeds(results)
    columns = _orders(results)
    known = columns["phase_deg"].where(columns["coherence"] >= _LEAST_COHERENCE)
    every = records(data_table(_DIMENSIONS, {**columns, "known_phase_deg": known}))
    caption = (
        "Orders: peak and phase of the coherent mean over the blocks at a speed; RMS in a band of "
        f"{results.attrs['band_order']:.3g} orders"
    )
    if len(shown) < results.sizes["speed"]:
        caption += f"; {len(shown)} of {results.sizes['speed']} speeds, all in the CSV"
    rows = [row for row in every if row["speed_rpm"] in shown]
    return table_of(caption, rows, _COLUMNS, frozenset({0, 1}))


def shown_speeds(results: xr.Dataset) -> set[float]:
    """Some operating points, from the lowest to the highest."""
    speeds = results["speed"].values
    indices = np.linspace(0, speeds.size - 1, _MOST_SPEEDS).round().astype(int)
    return set(speeds[indices].tolist())


def _level_rows(results: xr.Dataset) -> Iterator[tuple[str, str]]:
    """Channel and weighting of levels of sound pressure."""
    pressure = results["channel_unit"] == "Pa"
    return product(
        map(str, results["channel"].values[pressure.values]), map(str, results["weighting"].values)
    )


def _levels_table(results: xr.Dataset) -> Table:
    rows: list[tuple[Cell, ...]] = []
    for channel, weighting in _level_rows(results):
        at = {"channel": channel, "weighting": weighting}
        rows.append((channel, weighting, *(number(results, each, fixed, **at) for each in _LEVELS)))
    head = ("Channel", "weighting", "Leq, dB", "LFmax, dB", "LSmax, dB")
    method = "IEC 61260-1 filters" if results.attrs.get("band_method") == "filters" else "band sums"
    caption = (
        "Sound pressure levels, dB re 20 µPa; A and C leave out the first and last "
        f"{_left_out_s(results, 'A'):.3g} s, the filters' run-in; third octaves in levels.csv by "
        f"{method}"
    )
    return Table(caption, head, tuple(rows), frozenset({0, 1}))


_TRACKED_COLUMNS: Final[Columns] = (
    ("Channel", "channel", str),
    ("unit", "unit", str),
    ("Order", "order", "{:g}".format),
    ("Largest peak", "peak", rounding.significant),
    ("at s", "time_s", "{:.2f}".format),
    ("at rpm", "speed_rpm", "{:.0f}".format),
)


def tracked_table(tracked: xr.Dataset) -> Table:
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
    rows = records(data_table(("channel", "order"), columns))
    caption = "Tracked orders: where each is largest"
    return table_of(caption, rows, _TRACKED_COLUMNS, frozenset({0, 1}))


def tracked_data(tracked: xr.Dataset) -> DataTable:
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
    return data_table(("channel", "order", "track_time"), columns)


def tracked_facts(tracked: xr.Dataset) -> list[str]:
    """Where the speed comes from, and what passes around each order."""
    attrs = tracked.attrs
    return [
        f"speed: {attrs['speed_source']}",
        f"bandwidth: {attrs['bandwidth_hz']:g} Hz, {attrs['poles']} poles; noise within it grows "
        f"by up to {attrs['noise_gain']:.2g}",
    ]
