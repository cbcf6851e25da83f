"""Pages of a recording, of the same blocks as the report: its orders, its spectra over speed."""

from collections.abc import Sequence

import numpy as np
import xarray as xr

from ..results.over_speed.avoid import recorded_speeds_to_avoid
from ..results.over_speed.level_curves import is_run_up, recorded_curves
from .avoid import RECORDED_RULE, recorded_avoid_table
from .blocks import Block, Bullets, Pictures, Text
from .charts.marks import Chart
from .html import html
from .limit_tables import order_limits_table
from .order_tables import orders_facts, orders_tables
from .page import Page, Part


def orders_html(results: xr.Dataset, charts: Sequence[Chart]) -> bytes:
    """The page.

    Parameters
    ----------
    results : orders of a recording
    charts : of its channels
    """
    parts = [
        Part("figures", "Orders by channel", (Pictures(tuple(charts)),)),
        Part("orders", "Orders and levels", tuple(orders_tables(results))),
        Part("settings", "Speed and resolution", (Bullets(tuple(orders_facts(results))),)),
    ]
    if "order_limit" in results:
        parts.insert(0, Part("limits", "Limits", (order_limits_table(results),)))
    attrs = results.attrs
    about = "Orders are multiples of the shaft frequency; amplitudes are peaks."
    return html(Page(str(attrs["title"]), "Recording", attrs["created_utc"], tuple(parts), about))


def speed_map_html(mapped: xr.Dataset, charts: Sequence[Chart]) -> bytes:
    """The page.

    Parameters
    ----------
    mapped : of `speed_frequency_map`
    charts : of its channels
    """
    parts = [Part("maps", "Over speed and frequency", (Pictures(tuple(charts)),))]
    if is_run_up(mapped["block_speed"]) and "block_level" in mapped:
        parts.insert(0, Part("avoid", "Speeds to avoid", tuple(_avoid(mapped))))
    about = f"Lines of {mapped.attrs['resolution_hz']:.3g} Hz, {mapped.attrs['window']} window."
    attrs = mapped.attrs
    return html(Page(str(attrs["title"]), "Recording", attrs["created_utc"], tuple(parts), about))


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
