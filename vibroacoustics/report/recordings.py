"""Analyses of a recording: its orders, tracked orders, and spectra over the speed."""

import numpy as np
import xarray as xr

from ..results.over_speed.avoid import recorded_speeds_to_avoid
from ..results.over_speed.level_curves import is_run_up, recorded_curves
from .analysis import Analysis, origin
from .avoid import RECORDED_RULE, recorded_avoid_table
from .blocks import Block, Bullets, Part, Pictures, Text
from .figures.channel_orders import (
    recorded_order_charts,
    speed_map_charts,
    tracked_order_charts,
)
from .limit_tables import limits_data, limits_words, order_limits_table
from .order_tables import (
    levels_data,
    orders_data,
    orders_facts,
    orders_tables,
    tracked_data,
    tracked_facts,
    tracked_table,
)


def analysis_of_orders(results: xr.Dataset) -> Analysis:
    """Return the analysis of the orders of a recording."""
    facts, tables = Bullets(tuple(orders_facts(results))), orders_tables(results)
    parts = [
        Part("figures", "Orders by channel", (Pictures(tuple(recorded_order_charts(results))),)),
        Part("orders", "Orders and levels", tuple(tables)),
        Part("settings", "Speed and resolution", (facts,)),
    ]
    data = {"orders.csv": orders_data(results)}
    shown: list[Block] = [facts, *tables]
    if "equivalent_level" in results:
        data["levels.csv"] = levels_data(results)
    if "order_limit" in results:
        data["orders_limits.csv"] = limits_data(results)
        limits: tuple[Block, ...] = (order_limits_table(results), *map(Text, limits_words(results)))
        parts.insert(0, Part("limits", "Limits", limits))
        shown += limits
    about = "Orders are multiples of the shaft frequency; amplitudes are peaks."
    return Analysis(
        "orders",
        about=about,
        parts=tuple(parts),
        shown=tuple(shown),
        tables=data,
        **origin(results, "Recording"),
    )


def analysis_of_tracks(tracked: xr.Dataset) -> Analysis:
    """Return the analysis of tracked orders."""
    facts, table = Bullets(tuple(tracked_facts(tracked))), tracked_table(tracked)
    return Analysis(
        "tracked_orders",
        about="Orders followed over the time (Vold-Kalman); amplitudes are peaks.",
        parts=(
            Part("figures", "Orders by channel", (Pictures(tuple(tracked_order_charts(tracked))),)),
            Part("orders", "Largest amplitudes", (table,)),
            Part("settings", "Speed and bandwidth", (facts,)),
        ),
        shown=(facts, table),
        tables={"tracked_orders.csv": tracked_data(tracked)},
        **origin(tracked, "Recording"),
    )


def analysis_of_map(mapped: xr.Dataset) -> Analysis:
    """Return the analysis of a recording over speed and frequency."""
    parts = [Part("maps", "Over speed and frequency", (Pictures(tuple(speed_map_charts(mapped))),))]
    if is_run_up(mapped["block_speed"]) and "block_level" in mapped:
        parts.insert(0, Part("avoid", "Speeds to avoid", tuple(_avoid(mapped))))
    about = f"Lines of {mapped.attrs['resolution_hz']:.3g} Hz, {mapped.attrs['window']} window."
    return Analysis("speed_map", about=about, parts=tuple(parts), **origin(mapped, "Recording"))


def _avoid(mapped: xr.Dataset) -> list[Block]:
    blocks: list[Block] = []
    is_pressure = mapped["channel_unit"].values == "Pa"
    for channel in map(str, mapped["channel"].values[is_pressure]):
        weighted = {one.label: one for one in recorded_curves(mapped, channel)}["A-weighted"]
        if not np.all(np.isfinite(weighted.level_db)):
            continue
        ranges = recorded_speeds_to_avoid(weighted.speed_rpm, weighted.level_db)
        table = recorded_avoid_table(channel, ranges)
        blocks.append(table or Text(f"{channel}: none by the rule below."))
    return [*blocks, Text(RECORDED_RULE, "note")]
