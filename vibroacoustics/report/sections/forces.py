"""Force over a revolution, what the options report, and force, foot force and level by order."""

import numpy as np
import xarray as xr

from ...base.registry import register
from ...results import labels
from ...results.stored_study import words
from ..blocks import Block, Pictures, Text
from ..drawing.picture import section_picture
from ..figures.orders import foot_force_orders, force_orders, force_over_revolution, level_orders
from ..shown_speeds import chosen_speeds
from ..tables import DataTable, columns_of, data_table
from . import Section


def figures_data(results: xr.Dataset) -> dict[str, DataTable]:
    """Return every reported figure by option and speed."""
    words_of_figures, figures = words(results), results["reported_figure"]
    columns = {name: figures[name] for name in ("option", "figure", "speed")}
    rows = [
        (
            option,
            name,
            labels.name(name, words_of_figures),
            labels.unit(name, words_of_figures) or "1",
            speed,
            value,
        )
        for option, name, speed, value in zip(
            *data_table(tuple(columns), {**columns, "value": figures}).values(), strict=True
        )
        if np.isfinite(value)
    ]
    head = ("option", "figure", "words", "unit", "speed_rpm", "value")
    return {"figures.csv": columns_of(head, rows)}


def _blocks(results: xr.Dataset) -> list[Block]:
    note = "Figures of machine, sources and options at all speeds are in figures.csv."
    section = section_picture(results)
    pictures = [Pictures((section,))] if section else []
    missing = "Forces over crank angle are not in these results: operation.keep_time_series."
    kept = "force" in results
    force = Pictures((force_over_revolution(results),)) if kept else Text(missing)
    return [force, *pictures, Text(note, "note")]


register(Section("forces", "Force over a revolution", _blocks, position=50.0, tables=figures_data))


def _orders(results: xr.Dataset) -> list[Block]:
    return [
        Text(f"{words(results)['orders']} A missing marker means a value too small to show."),
        *chosen_speeds(results, "results.nc"),
        Pictures((force_orders(results), foot_force_orders(results), level_orders(results))),
    ]


register(Section("orders", "Orders", _orders, position=40.0))
