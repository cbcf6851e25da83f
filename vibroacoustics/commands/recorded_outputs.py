"""What `track` and `map` leave on disk: the dataset, its table and figures."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Final

import xarray as xr

from .. import report
from ..report.figures import Picture
from ..results import storage

TRACKED_NAME: Final = "tracked_orders.nc"
SPEED_MAP_NAME: Final = "speed_map.nc"


def write_tracked(tracked: xr.Dataset, folder: str | Path) -> Path:
    """Write tracked orders with table and figures, each whole or not at all; the dataset last.

    Returns
    -------
    path of the dataset
    """
    table = {"tracked_orders.csv": report.tracked_csv(tracked)}
    return _write(tracked, Path(folder), TRACKED_NAME, table, report.tracked_order_figures(tracked))


def write_speed_map(mapped: xr.Dataset, folder: str | Path) -> Path:
    """Write a speed-frequency map with its figures; see `write_tracked`."""
    return _write(mapped, Path(folder), SPEED_MAP_NAME, {}, report.speed_map_figures(mapped))


def _write(
    results: xr.Dataset,
    folder: Path,
    name: str,
    tables: Mapping[str, bytes],
    pictures: Sequence[Picture],
) -> Path:
    files = {**tables, **{f"{picture.name}.png": picture.png for picture in pictures}}
    for file, content in files.items():
        storage.write_bytes(folder / file, content)
    return storage.write_results(results, folder / name)
