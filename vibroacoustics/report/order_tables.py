"""Orders of a recording, and their comparison, as plain text and CSV."""

from collections.abc import Iterator

import numpy as np
import xarray as xr

from . import rounding
from .tables import Table, to_csv, to_text

_MOST_SPEEDS = 6
"""Operating points in the text; all are in the CSV."""


def orders_text(results: xr.Dataset) -> str:
    """Where the speed comes from, the orders at some operating points, levels of sound pressure."""
    facts = [
        f"speed: {results.attrs['speed_source']}",
        f"resolution: {results.attrs['resolution_order']:.3g} orders (noise bandwidth), blocks of "
        f"{results.attrs['revolutions_per_block']} revolutions, {results.attrs['window']} window",
    ]
    if "fault_time" in results:
        facts.append(_faults_line(results["fault_time"]))
    tables = [_orders_table(results)]
    if "equivalent_level" in results:
        tables.append(_levels_table(results))
    return "\n".join([*facts, "", *(to_text(table) for table in tables)])


def orders_csv(results: xr.Dataset) -> bytes:
    """Every order of every channel at every operating point."""
    head = (
        "channel", "unit", "speed_rpm", "order", "frequency_hz", "amplitude_peak",
        "phase_deg", "rms_in_band", "coherence",
    )  # fmt: skip
    return to_csv(head, _order_rows(results))


def comparison_of_orders_text(compared: xr.Dataset) -> str:
    """Table of both results' orders and their differences."""
    rows = tuple(
        (
            str(name),
            str(other_name),
            f"{speed:.0f}",
            f"{other_speed:.0f}",
            f"{order:g}",
            rounding.significant(float(peak)),
            rounding.significant(float(other_peak)),
            rounding.signed(float(difference), 2),
            rounding.signed(float(phase), 1),
        )
        for name, other_name, _, speed, other_speed, order, peak, other_peak, difference, phase in (
            _compared_rows(compared)
        )
    )
    head = (
        "Channel", "other", "rpm", "other rpm", "Order", "Peak", "other peak", "dB", "phase, °"
    )  # fmt: skip
    caption = "Other result against this one: level and phase of each order"
    return to_text(Table(caption, head, rows, frozenset({0, 1})), widest_first=32)


def comparison_of_orders_csv(compared: xr.Dataset) -> bytes:
    """Every pair of orders."""
    head = (
        "channel", "other_channel", "unit", "speed_rpm", "other_speed_rpm", "order",
        "amplitude_peak", "other_amplitude_peak", "difference_db", "phase_difference_deg",
    )  # fmt: skip
    return to_csv(head, _compared_rows(compared))


def _faults_line(times: xr.DataArray) -> str:
    kinds = [str(name).split()[1] for name in times["fault"].values]
    counts = ", ".join(f"{kinds.count(kind)} {kind}" for kind in sorted(set(kinds)))
    shown = ", ".join(
        f"{kind} at {time:.3f} s" for kind, time in zip(kinds[:5], times.values, strict=False)
    )
    return f"tacho faults: {counts} ({shown}{', …' if len(kinds) > 5 else ''})"


def _order_rows(results: xr.Dataset) -> Iterator[tuple[str | float, ...]]:
    lines = results["channel_order"].transpose("channel", "speed", "order")
    for channel in lines:
        name, unit = str(channel["channel"].item()), str(channel["channel_unit"].item())
        for at_speed in channel:
            speed = float(at_speed["speed"])
            for value in at_speed:
                order = float(value["order"])
                at = {"channel": name, "speed": speed, "order": order}
                yield (
                    name,
                    unit,
                    speed,
                    order,
                    order * speed / 60.0,
                    float(abs(value)),
                    float(np.degrees(np.angle(value.item()))),
                    float(results["channel_order_rms"].sel(at)),
                    float(results["channel_order_coherence"].sel(at)),
                )


def _orders_table(results: xr.Dataset) -> Table:
    speeds = results["speed"].values
    shown = set(
        speeds[np.unique(np.linspace(0, speeds.size - 1, _MOST_SPEEDS).round().astype(int))]
    )
    rows = tuple(
        (
            str(name),
            str(unit),
            f"{speed:.0f}",
            f"{order:g}",
            rounding.significant(float(peak)),
            rounding.fixed(float(phase), 1),
            rounding.significant(float(rms)),
            rounding.fixed(float(coherence), 3),
        )
        for name, unit, speed, order, _, peak, phase, rms, coherence in _order_rows(results)
        if speed in shown
    )
    head = ("Channel", "unit", "rpm", "Order", "Peak", "phase, °", "RMS in band", "coherence")
    caption = "Orders: coherent mean over the blocks at a speed, against crank angle zero"
    if len(shown) < speeds.size:
        caption += f"; {len(shown)} of {speeds.size} speeds, all in the CSV"
    return Table(caption, head, rows, frozenset({0, 1}))


def _levels_table(results: xr.Dataset) -> Table:
    names = ("equivalent_level", "fast_maximum_level", "slow_maximum_level")
    rows = tuple(
        (str(channel), str(weighting), *cells)
        for channel in results["channel"].values
        for weighting in results["weighting"].values
        for cells in [
            [
                rounding.fixed(float(results[name].sel(channel=channel, weighting=weighting)))
                for name in names
            ]
        ]
        if cells[0] != rounding.NOTHING
    )
    head = ("Channel", "weighting", "Leq, dB", "LFmax, dB", "LSmax, dB")
    return Table("Sound pressure levels, dB re 20 µPa", head, rows, frozenset({0, 1}))


def _compared_rows(compared: xr.Dataset) -> Iterator[tuple[str | float, ...]]:
    lines = compared["channel_order"].transpose("channel", "speed", "order")
    for channel in lines:
        for at_speed in channel:
            for value in at_speed:
                at = {name: value[name].item() for name in ("channel", "speed", "order")}
                yield (
                    str(at["channel"]),
                    str(value["compared_channel"].item()),
                    str(value["channel_unit"].item()),
                    float(at["speed"]),
                    float(value["compared_speed"]),
                    float(at["order"]),
                    float(abs(value)),
                    float(abs(compared["compared_order"].sel(at))),
                    float(compared["order_difference"].sel(at)),
                    float(np.degrees(compared["order_phase_difference"].sel(at))),
                )
