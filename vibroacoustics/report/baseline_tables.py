"""Measured orders with every option as tables."""

from typing import Final

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.units import shaft_frequency_hz
from ..base.vocabulary import REFERENCE_OPTION
from .study import few_speeds, options, speeds
from .tables import Table

MOST_ORDERS: Final = 10
"""Of the loudest, in a table."""


def order_tables(results: xr.Dataset) -> list[Table]:
    """The loudest orders at the first microphone where any were measured, with every option."""
    if "baseline_order_level" not in results:
        return []
    known = results["baseline_order_level"].notnull().any(["speed", "option", "baseline_order"])
    name = str(results["receiver"].values[known.values][0])
    here = few_speeds(results).sel(receiver=name)
    measured = here["baseline_order_level"].notnull().any(["option", "baseline_order"])
    return [
        _order_table(here.sel(speed=speed), name, speed)
        for speed, there in zip(speeds(here), measured.values.tolist(), strict=True)
        if there
    ]


def _order_table(here: xr.Dataset, name: str, speed: float) -> Table:
    here = here.isel(baseline_order=here["baseline_order_phase"].notnull().values)
    level = here["baseline_order_level"]
    measured = level.sel(option=REFERENCE_OPTION).values
    loudest = np.sort(np.argsort(-np.nan_to_num(measured, nan=-np.inf))[:MOST_ORDERS])
    changed = [option for option in options(here) if option != REFERENCE_OPTION]
    rows = tuple(
        (
            f"{order:g}",
            f"{order * shaft_frequency_hz(speed):.1f}",
            "yes" if here["baseline_order_phase"].values[at] > 0.0 else "no",
            rounding.level(float(measured[at])),
            rounding.fixed(100.0 * float(here["baseline_order_share"].values[at]), 0),
            *(rounding.level(float(level.sel(option=one).values[at])) for one in changed),
        )
        for at, order in zip(loudest, here["baseline_order"].values[loudest], strict=True)
    )
    head = ("Order", "Hz", "phase", "measured", "modelled, % of energy", *changed)
    caption = f"Measured orders at {name}, {speed:g} rpm, and with each option, dB re 20 µPa"
    return Table(caption, head, rows, frozenset({2}))
