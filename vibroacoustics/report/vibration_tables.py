"""Vibration severity of the channels of a recording, as a table, over the speed and as data."""

from collections.abc import Iterator

import numpy as np
import xarray as xr

from ..base import rounding
from ..results.over_speed.level_curves import is_run_up
from .charts.marks import Axis, Chart, Line, Panel
from .tables import DataTable, Table, columns_of

_HEAD = ("Channel", "mm/s RMS", "largest block, mm/s", "at rpm", "largest block, µm p-p", "at rpm")


def vibration_table(results: xr.Dataset) -> Table:
    """Return velocity and displacement of every channel of vibration.

    Parameters
    ----------
    results : result of `analyse_orders` with `velocity_rms`
    """
    low, high = results.attrs["velocity_band_hz"]
    edge, omitted = (results.attrs[f"velocity_{name}"] for name in ("edge_hz", "omitted_s"))
    caption = (
        f"Vibration severity, {low:g} to {high:g} Hz (quantity of ISO 20816-1; no zones); tones at "
        f"both ends count whole, none beyond by {edge:.2g} Hz, of blocks 1 Hz; mm/s RMS omits the "
        f"first and last {omitted:.2g} s"
    )
    rows = tuple(_row(results.sel(channel=name)) for name in _channels(results))
    return Table(caption, _HEAD, rows)


def _channels(results: xr.Dataset) -> list[str]:
    velocity = results["velocity_rms"]
    return [str(name) for name in velocity["channel"].values[np.isfinite(velocity.values)]]


def _row(of_channel: xr.Dataset) -> tuple[str, ...]:
    name = str(of_channel["channel"].item())
    row = [name, rounding.significant(1e3 * of_channel["velocity_rms"].item(), 3)]
    for variable, factor in (("block_velocity_rms", 1e3), ("block_displacement", 1e6)):
        values = of_channel[variable].values if variable in of_channel else np.empty(0)
        if not np.isfinite(values).any():
            row += ["–", "–"]
            continue
        largest = int(np.nanargmax(values))
        row.append(rounding.significant(factor * float(values[largest]), 3))
        row.append(f"{of_channel['block_speed'].values[largest]:.0f}")
    return tuple(row)


def vibration_charts(results: xr.Dataset) -> Iterator[Chart]:
    """Give the velocity of all channels over the speed of a run-up; nothing at a steady one."""
    if "block_velocity_rms" not in results or not is_run_up(results["block_speed"]):
        return
    speed = results["block_speed"].values
    rising = np.argsort(speed, kind="stable")
    lines = tuple(
        Line(
            speed[rising],
            1e3 * results["block_velocity_rms"].sel(channel=name).values[rising],
            name,
        )
        for name in _channels(results)
    )
    panel = Panel(Axis("Speed, rpm"), Axis("Velocity, mm/s RMS"), lines)
    words = "Velocity, 10 to 1000 Hz, of each block over the speed"
    yield Chart("velocity_over_speed", words, words, (panel,))


def vibration_data(results: xr.Dataset) -> DataTable:
    """Return velocity and displacement of every channel, overall (no block) and by block."""
    rows: list[tuple[str | float, ...]] = []
    for name in _channels(results):
        here = results.sel(channel=name)
        rows.append((name, "", "", "", 1e3 * here["velocity_rms"].item(), ""))
        if "block_velocity_rms" not in results:
            continue
        columns = [here[each].values for each in (
            "block_time", "block_speed", "block_velocity_rms", "block_displacement",
        )]  # fmt: skip
        for number, (time_s, rpm, velocity, displacement) in enumerate(zip(*columns, strict=True)):
            if np.isfinite(velocity):
                rows.append((name, number, time_s, rpm, 1e3 * velocity, 1e6 * displacement))
    head = ("channel", "block", "time_s", "speed_rpm", "velocity_rms_mm_s", "displacement_um")
    return columns_of(head, rows)
