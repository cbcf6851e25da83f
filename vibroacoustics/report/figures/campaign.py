"""Many recordings as one: mean, its interval and the range of the runs, by order and by band."""

from collections.abc import Iterator
from typing import Final

import numpy as np
import xarray as xr

from ...base.arrays import Array
from ...base.constants import REFERENCE_PRESSURE_PA
from ...base.decibel import level_of_amplitude
from ..charts.axes import level_axis, stacked
from ..charts.layout import COLOURS, shortened
from ..charts.marks import Axis, Chart, Line, Mark, Panel, Points, frequency_axis
from ..file_names import numbered
from .levels_over_speed import FEW_POINTS

_MOST_ORDERS: Final = 6
"""Orders that have a panel over the speed: the loudest."""
_RANGE_DB: Final = 60.0
_GREY: Final = "#777777"
_KEY: Final = "Line: energy mean; shaded: its 95 % interval; dashed: lowest and highest run."


def order_level(rms: xr.DataArray) -> xr.DataArray:
    """Return levels of root mean squares: dB re 20 µPa of sound pressure, re 1 unit of others."""
    unit = (rms["channel_unit"] == "Pa") * (REFERENCE_PRESSURE_PA - 1.0) + 1.0
    return rms.copy(data=level_of_amplitude((rms / unit).transpose(*rms.dims).values))


def reference(unit: str) -> str:
    """Return words for the reference of a level."""
    return "dB re 20 µPa" if unit == "Pa" else f"dB re 1 {unit}"


def campaign_charts(mean: xr.Dataset) -> list[Chart]:
    """Return for each channel its orders, and of sound pressure third octaves.

    Parameters
    ----------
    mean : result of `mean_of_runs`
    """
    charts = []
    for channel, file in numbered(mean, "channel"):
        of_channel = mean.sel(channel=channel)
        unit = str(of_channel["channel_unit"].item())
        over_speed = mean.sizes["speed"] > 1
        charts.append((_over_speed if over_speed else _orders)(of_channel, channel, unit, file))
        if unit == "Pa" and "run_band_level" in mean:
            charts.append(_bands(of_channel, channel, file))
    return charts


def _orders(mean: xr.Dataset, channel: str, unit: str, file: str) -> Chart:
    """Return orders at one speed."""
    case = mean.isel(speed=0)
    level_db, runs_db = (
        order_level(case[name]).values for name in ("channel_order_rms", "run_order_rms")
    )
    ends = _ends(level_db, case["order_mean_interval"].values)
    order, (low, high) = case["order"].values, (runs_db.min(axis=0), runs_db.max(axis=0))
    marks = (
        Points(order, low, "lowest and highest run", None, _GREY, "_", 12.0),
        Points(order, high, "", None, _GREY, "_", 12.0),
        Points(order, level_db, "energy mean, 95 % interval", ends, COLOURS[0], "o", 5.0),
    )
    x = Axis("Shaft order", limits=(0.0, float(order.max()) + 0.5))
    y = level_axis(f"Level in the band, {reference(unit)}", runs_db, _RANGE_DB)
    return Chart(
        f"orders_{file}",
        f"Orders of {channel}: mean, its interval and the range of the runs.",
        f"Orders of {channel} at {case['speed'].item():.0f} rpm over {mean.sizes['run']} runs.",
        (Panel(x, y, marks, shortened(channel, 60), 2.8),),
    )


def _over_speed(mean: xr.Dataset, channel: str, unit: str, file: str) -> Chart:
    """Return the loudest orders over the speed, a panel each."""
    level_db, runs_db = (order_level(mean[name]) for name in ("channel_order_rms", "run_order_rms"))
    loudest = np.argsort(-level_db.max("speed").values, kind="stable")[:_MOST_ORDERS]
    panels = []
    for number in sorted(loudest):
        of_runs = runs_db.isel(order=number).values
        lines = _lines(
            mean["speed"].values,
            level_db.isel(order=number).values,
            mean["order_mean_interval"].isel(order=number).values,
            of_runs,
        )
        y = level_axis(reference(unit), of_runs, _RANGE_DB)
        title = f"{shortened(channel, 50)}, order {mean['order'].values[number]:g}"
        panels.append(Panel(Axis("Speed, rpm"), y, tuple(lines), title, 1.8))
    return Chart(
        f"orders_{file}",
        f"Orders of {channel} over the speed: mean, its interval and the range of the runs.",
        f"Loudest orders of {channel} over the speed, {mean.sizes['run']} runs. {_KEY}",
        stacked(panels),
        wide=True,
        legend=False,
    )


def _bands(mean: xr.Dataset, channel: str, file: str) -> Chart:
    """Return unweighted third octaves."""
    case = mean.sel(weighting="Z")
    level_db, runs_db = case["band_level"].values, case["run_band_level"].values
    lines = _lines(case["band"].values, level_db, case["band_mean_interval"].values, runs_db)
    x = frequency_axis("Third-octave band, Hz", case["band"].values)
    y = level_axis("Level, dB re 20 µPa, unweighted", runs_db, _RANGE_DB)
    return Chart(
        f"bands_{file}",
        f"Third octaves of {channel}: mean, its interval and the range of the runs.",
        f"Third octaves of {channel}, {mean.sizes['run']} runs. {_KEY}",
        (Panel(x, y, tuple(lines), shortened(channel, 60), 2.8),),
        legend=False,
    )


def _lines(x: Array, level_db: Array, interval_db: Array, runs_db: Array) -> Iterator[Mark]:
    """Yield lowest and highest run, and the mean with its interval."""
    marker = "o" if x.size <= FEW_POINTS else ""
    for end in (runs_db.min(axis=0), runs_db.max(axis=0)):
        yield Line(x, end, "", None, _GREY, "--", "", 0.9)
    yield Line(x, level_db, "", _ends(level_db, interval_db), COLOURS[0], "-", marker)


def _ends(level_db: Array, interval_db: Array) -> tuple[Array, Array]:
    """Ends of the interval; the mean itself where the runs do not give one."""
    reach = np.nan_to_num(interval_db)
    return level_db - reach, level_db + reach
