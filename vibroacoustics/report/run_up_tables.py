"""Levels of a recorded run-up in words and as a table: overall and of the loudest orders."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.arrays import Array
from ..base.decibel import amplitude_of_level
from ..results.over_speed.loudest_channel import LoudestChannel
from ..results.over_speed.loudest_orders import LoudestOrders, a_weighted_power, loudest_orders
from .tables import Cell, Table


def loudest_sentences(loudest: LoudestChannel) -> tuple[str, ...]:
    """Return the answer: loudest channel, loudest order, and how far the channels differ."""
    curves = loudest.curves
    words = []
    level, quietest = (
        None if value is None else rounding.fixed(value)
        for value in (loudest.overall_db, loudest.quietest_db)
    )
    among = " is the loudest channel" if loudest.channels > 1 else ""
    if level is not None:
        words.append(f"{curves.channel}{among}: {level} dB(A) at {loudest.overall_rpm:.0f} rpm.")
    owner = "Its loudest order" if words else f"{curves.channel}: the loudest order"
    hertz = loudest.order * loudest.order_rpm / 60.0
    where = f"at {loudest.order_rpm:.0f} rpm ({hertz:.4g} Hz)"
    words.append(f"{owner} is {loudest.order:.4g}×: {_order_level(loudest)} {where}.")
    if level == quietest and loudest.channels > 1 and level is not None:
        words.append(f"All {loudest.channels} channels of sound pressure have this level.")
    elif level is not None and loudest.channels > 1:
        words.append(
            f"The greatest levels of the {loudest.channels} channels of sound pressure are "
            f"{quietest} to {level} dB(A)."
        )
    return tuple(words)


def _order_level(loudest: LoudestChannel) -> str:
    unit = loudest.curves.unit
    if unit == "Pa":
        return f"{rounding.fixed(loudest.order_db)} dB(A)"
    rms = float(amplitude_of_level(loudest.order_db))
    return f"{rounding.significant(rms, 3)} {unit} RMS"


_MOST_ROWS: Final = 60
"""Most rows of all channels: with many, each shows fewer orders."""


def every_loudest(results: xr.Dataset) -> list[LoudestOrders]:
    """Return overall level and loudest orders of every channel; none without the map of a run-up.

    Parameters
    ----------
    results : result of `analyse_orders`
    """
    if "order_map" not in results or results.sizes["speed"] < 2:
        return []
    gain = a_weighted_power(results["map_order"].values, results["block_speed"].values)
    return [loudest_orders(results, str(name), gain) for name in results["channel"].values]


def loudest_table(loudest: Sequence[LoudestOrders]) -> Table:
    """Return where overall level and loudest orders of each channel are greatest."""
    most = max(_MOST_ROWS // len(loudest) - 1, 1)
    rows: list[tuple[Cell, ...]] = []
    for curves in loudest:
        if curves.overall_db is not None and np.isfinite(curves.overall_db).any():
            rows.append(_row(curves, "overall", curves.overall_db, 0.0))
        ranked = np.argsort(-curves.level_db.max(axis=1), kind="stable")[:most]
        for order, level_db in zip(curves.order[ranked], curves.level_db[ranked], strict=True):
            rows.append(_row(curves, f"{order:.4g}×", level_db, order))
    head = ("Channel", "Level of", "Greatest, dB", "reference", "at rpm", "at Hz")
    caption = (
        "Greatest levels over the speed: overall (sound pressure) and of the loudest orders, each "
        "in its band"
    )
    return Table(caption, head, tuple(rows), frozenset({0, 1, 3}))


def _row(curves: LoudestOrders, name: str, level_db: Array, order: float) -> tuple[Cell, ...]:
    block = int(np.nanargmax(level_db))
    speed_rpm = float(curves.speed_rpm[block])
    frequency = rounding.significant(order * speed_rpm / 60.0, 4) if order else ""
    level = rounding.fixed(float(level_db[block]))
    return (curves.channel, name, level, curves.reference, f"{speed_rpm:.0f}", frequency)
