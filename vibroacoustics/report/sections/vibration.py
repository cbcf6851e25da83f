"""Vibration severity of the feet at every speed."""

import xarray as xr

from ...base import rounding
from ...base.registry import register
from ..blocks import Block, Text
from ..shown_speeds import chosen_speeds, few_speeds
from ..tables import Cell, DataTable, Table, data_table
from . import Section

_NOTE = (
    "Velocity of orders from 10 to 1000 Hz is the quantity of ISO 20816-1; its zones depend on the "
    "machine. Unmodelled sources are not included. All feet and axes are in vibration.csv."
)


def _blocks(results: xr.Dataset) -> list[Block]:
    shown = few_speeds(results)
    velocity = shown["foot_velocity"]
    rows = tuple(
        _row(velocity.sel(speed=speed, option=option), shown)
        for speed in velocity["speed"].values
        for option in velocity["option"].values
    )
    head = ("rpm", "Option", "mm/s RMS", "foot", "axis", "µm p-p")
    table = Table("Foot and axis of the largest velocity", head, rows, frozenset({1, 3, 4}))
    return [Text(_NOTE), *chosen_speeds(results, "vibration.csv"), table]


def _row(velocity: xr.DataArray, results: xr.Dataset) -> tuple[Cell, ...]:
    # Of equal ones the first, whatever rounding does.
    shares = (velocity / max(float(velocity.max()), 1e-300)).round(9)
    position = {name: each.item() for name, each in shares.argmax(("foot", "axis")).items()}
    worst = velocity.isel(position)
    label = {name: worst[name].item() for name in ("speed", "option", "foot", "axis")}
    micrometres = 1e6 * results["foot_displacement"].sel(label).item()
    first = (
        f"{label['speed']:g}",
        str(label["option"]),
        rounding.significant(1e3 * worst.item(), 3),
    )
    return (*first, label["foot"], label["axis"], rounding.significant(micrometres, 3))


def _applies(results: xr.Dataset) -> bool:
    return "foot_velocity" in results


def _data(results: xr.Dataset) -> dict[str, DataTable]:
    dims = ("speed", "option", "foot", "axis")
    columns = {name: results[name] for name in dims} | {
        "velocity_rms_mm_s": 1e3 * results["foot_velocity"],
        "displacement_um": 1e6 * results["foot_displacement"],
    }
    return {"vibration.csv": data_table(dims, columns)}


register(
    Section(
        "vibration", "Vibration of the feet", _blocks, _applies, position=46.5, folded=True,
        tables=_data,
    )
)  # fmt: skip
