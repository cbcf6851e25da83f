"""Levels of two results at a microphone: in all, and by third octave."""

from typing import NamedTuple

import numpy as np
import xarray as xr

from ...base import rounding
from ...base.arrays import Array
from ...results.figure_limits import PRESSURE, Compared
from ..order_tables import shown_speeds
from ..tables import Table


class Levels(NamedTuple):
    """Levels of one result at a microphone; uncertainty of the mean where several runs tell it."""

    total_dba: float
    total_uncertainty_db: float
    band_hz: Array
    band_db: Array
    band_uncertainty_db: Array


def levels_tables(compared: Compared) -> list[Table]:
    """A table for each microphone and speed at which both results have levels."""
    rows = [
        (str(channel), float(speed))
        for channel, unit in zip(
            compared.orders["channel"].values, compared.orders["channel_unit"].values, strict=True
        )
        for speed in sorted(shown_speeds(compared.orders))
        if str(unit) == "Pa"
    ]
    return [table for one in rows if (table := _table(compared, *one)) is not None]


def levels_at(compared: Compared, channel: str, speed: float) -> tuple[Levels, Levels] | None:
    """Levels of both at a microphone; none where one has none at such a speed."""
    there = compared.orders.sel(channel=channel, speed=speed)
    other, other_speed = str(there["compared_channel"].item()), float(there["compared_speed"])
    names = {"channel": (channel, speed), "compared_channel": (other, other_speed)}
    both = [
        _of_study(result, option, *names[key])
        if "force_order" in result
        else _of_recording(result, *names[key])
        for _, result, option, key in compared.sides()
    ]
    first, second = both
    return None if first is None or second is None else (first, second)


def _of_study(result: xr.Dataset, option: str, channel: str, speed: float) -> Levels | None:
    receiver = channel.removeprefix(PRESSURE)
    total = float(result["level_total"].sel(option=option, receiver=receiver, speed=speed))
    nothing = np.zeros(0)
    if "modelled_band_level" not in result or speed not in result["path_speed"].values:
        return Levels(total, float("nan"), nothing, nothing, nothing)
    bands = result["modelled_band_level"].sel(option=option, receiver=receiver, path_speed=speed)
    known = bands.values > rounding.LEVEL_FLOOR_DB
    hertz = bands["band"].values[known]
    return Levels(total, float("nan"), hertz, bands.values[known], np.full(hertz.size, np.nan))


def _of_recording(result: xr.Dataset, channel: str, _: float) -> Levels | None:
    """Of all of a recording, which must be at one speed."""
    if "equivalent_level" not in result or result.sizes["speed"] > 1:
        return None
    there = result.sel(channel=channel)
    total, bands = (
        there["equivalent_level"].sel(weighting="A"),
        there["band_level"].sel(weighting="Z"),
    )
    spread = [
        there[name].sel(weighting=weighting).values
        if name in there
        else np.full(np.shape(values), np.nan)
        for name, weighting, values in (
            ("equivalent_mean_uncertainty", "A", total.values),
            ("band_mean_uncertainty", "Z", bands.values),
        )
    ]
    return Levels(float(total), float(spread[0]), bands["band"].values, bands.values, spread[1])


def _table(compared: Compared, channel: str, speed: float) -> Table | None:
    both = levels_at(compared, channel, speed)
    if both is None:
        return None
    rows = [_row("all, dB(A)", *((one.total_dba, one.total_uncertainty_db) for one in both))]
    for band in np.intersect1d(both[0].band_hz, both[1].band_hz):
        at = [int(np.flatnonzero(one.band_hz == band)[0]) for one in both]
        pairs = [
            (float(one.band_db[row]), float(one.band_uncertainty_db[row]))
            for one, row in zip(both, at, strict=True)
        ]
        rows.append(_row(f"{band:g} Hz", *pairs))
    if len(rows) == 1:  # no third octave in common; levels in all are in other tables
        return None
    is_known = any(row[-1] != rounding.NOTHING for row in rows)
    head = ("Band", "A", "B", "B − A, dB", "u of the mean, dB")
    caption = (
        f"{channel}, {speed:.0f} rpm: A-weighted level in all and third octaves, unweighted, dB re "
        "20 µPa; third octaves of a study are those of the modelled sound"
    )
    if is_known:
        return Table(caption, head, tuple(rows))
    return Table(caption, head[:-1], tuple(row[:-1] for row in rows))


def _row(name: str, first: tuple[float, float], second: tuple[float, float]) -> tuple[str, ...]:
    """Levels with their uncertainties, not a number where these are not known."""
    known = [spread for _, spread in (first, second) if np.isfinite(spread)]
    return (
        name,
        rounding.level(first[0]),
        rounding.level(second[0]),
        rounding.signed(second[0] - first[0]),
        rounding.fixed(float(np.linalg.norm(known)), 2) if known else rounding.NOTHING,
    )
