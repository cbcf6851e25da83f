"""Force into the feet by foot and direction, and what makes it."""

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.vocabulary import REFERENCE_OPTION
from .tables import Table


def foot_orders(results: xr.Dataset, speed: float) -> list[int]:
    """Those of the first two orders at which a foot is pressed."""
    forces = abs(_forces(results, speed, [1, 2]).sum("source")).max(("foot", "axis"))
    return [int(one) for one in forces["order"].values[forces.values > rounding.FORCE_FLOOR]]


def foot_forces(results: xr.Dataset, speed: float) -> xr.DataArray:
    """Complex peaks without a balancer, over source, foot, axis and order, N."""
    return _forces(results, speed, foot_orders(results, speed))


def foot_table(results: xr.Dataset, speed: float) -> Table:
    """Peak force of each foot along each axis, and of what presses it most by itself."""
    forces = foot_forces(results, speed)
    rows = [
        (
            str(foot).replace("_", " "),
            str(axis),
            *(cell for order in there["order"].values for cell in _cells(there.sel(order=order))),
        )
        for foot in forces["foot"].values
        for axis in forces["axis"].values
        for there in [forces.sel(foot=foot, axis=axis)]
    ]
    orders = forces["order"].values
    head = [text for order in orders for text in (f"{order:g}×, N", f"{order:g}×, largest part")]
    words = frozenset({0, 1, *range(3, 2 + len(head), 2)})
    caption = f"{speed:g} rpm, option {REFERENCE_OPTION}: force into each foot, peak"
    return Table(caption, ("Foot", "along", *head), tuple(rows), words)


def _forces(results: xr.Dataset, speed: float, orders: list[int]) -> xr.DataArray:
    at = {"speed": speed, "option": REFERENCE_OPTION, "order": orders}
    return results["foot_force_order"].sel(at)


def _cells(there: xr.DataArray) -> tuple[str, str]:
    """Force of all that moves, and the largest of one of them alone."""
    alone = np.abs(there.values)
    first = int(np.argmax(alone))
    if alone[first] < rounding.FORCE_FLOOR:
        return "0", rounding.NOTHING
    source = str(there["source"].values[first]).replace("_", " ")
    total = rounding.significant(float(np.abs(there.values.sum())))
    return total, f"{source}, {rounding.significant(float(alone[first]))} N alone"
