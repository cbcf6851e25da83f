"""Files of `track`, `map` and `tones`: the dataset, its table, page and figures."""

from pathlib import Path
from typing import Final

import xarray as xr

from .. import report
from ..report.charts.picture import picture
from .outputs import write_analysis
from .tone_tables import tones_csv, tones_html

TRACKED_NAME: Final = "tracked_orders.nc"
SPEED_MAP_NAME: Final = "speed_map.nc"
SPEED_MAP_REPORT_NAME: Final = "speed_map.html"
TONES_NAME: Final = "tones.nc"
TONES_REPORT_NAME: Final = "tones.html"


def write_tracked(tracked: xr.Dataset, folder: str | Path) -> Path:
    """Write tracked orders with table and figures; see `write_analysis`."""
    table = {"tracked_orders.csv": report.tracked_csv(tracked)}
    pictures = map(picture, report.tracked_order_charts(tracked))
    return write_analysis(tracked, folder, TRACKED_NAME, table, pictures)


def write_speed_map(mapped: xr.Dataset, folder: str | Path) -> Path:
    """Write a speed-frequency map with page and figures; see `write_analysis`."""
    charts = report.speed_map_charts(mapped)
    page = {SPEED_MAP_REPORT_NAME: report.speed_map_html(mapped, charts)}
    return write_analysis(mapped, folder, SPEED_MAP_NAME, page, map(picture, charts))


def write_tones(tones: xr.Dataset, folder: str | Path) -> Path:
    """Write tones with table and page; see `write_analysis`."""
    files = {"tones.csv": tones_csv(tones), TONES_REPORT_NAME: tones_html(tones)}
    return write_analysis(tones, folder, TONES_NAME, files)
