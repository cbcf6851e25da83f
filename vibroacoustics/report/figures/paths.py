"""Bars of the leading paths of sound, and of the forces into the feet."""

from typing import Final

import numpy as np
import xarray as xr

from ...base import rounding
from ...base.arrays import Array
from ...base.remembered import remembered
from ...base.vocabulary import REFERENCE_OPTION
from ...results.labels import DOF_WORDS
from ...results.stored_study import catalogue_receiver, quoted_speed, source_name
from ...results.titles import chosen
from ..charts.layout import COLOURS, wrapped
from ..charts.marks import Axis, Bars, Chart, Panel, named_axis
from ..charts.needs import needs
from ..file_names import numbered

LEADING: Final = 10
"""Paths that are shown."""
PARTS_OF_PATH: Final = ("path_source", "path_port", "path_direction")
_KINDS: Final = {"f": "force along", "m": "moment about"}


def path_speed(results: xr.Dataset) -> float:
    """Speed at which paths are shown: of the published level, or the nearest to it."""
    speeds = results["path_speed"].values
    return float(speeds[np.argmin(np.abs(speeds - quoted_speed(results)))])


@remembered
def at_path_speed(results: xr.Dataset, receiver: str) -> xr.Dataset:
    """Paths to a microphone at the speed that is shown."""
    names = [name for name in results.data_vars if "path_speed" in results.variables[name].dims]
    return results[names].sel(path_speed=path_speed(results), receiver=receiver)


def path_words(results: xr.Dataset, row: int) -> tuple[str, str]:
    """Source of a path, and where it acts in which direction, in plain words."""
    source, port, direction = (str(results.variables[name].values[row]) for name in PARTS_OF_PATH)
    kind = _KINDS.get(direction[0]) if len(direction) == 2 else None
    words = DOF_WORDS.get(direction) or (f"{kind} {direction[1]}" if kind else direction)
    return source_name(results, source), f"{port.replace('_', ' ')} {words}"


def leading(share: Array, count: int = LEADING) -> list[int]:
    """Rows of the paths with the largest shares, of whatever sign; of those above nothing."""
    order = np.argsort(-np.abs(share), kind="stable")[:count]
    return [int(row) for row in order if abs(share[row]) >= 0.0005]


def foot_orders(results: xr.Dataset, speed: float) -> list[int]:
    """Those of the first two orders at which a foot is pressed."""
    forces = abs(_forces(results, speed, [1, 2]).sum("source")).max(("foot", "axis"))
    return [int(order) for order in forces["order"].values[forces.values > rounding.FORCE_FLOOR]]


def foot_forces(results: xr.Dataset, speed: float) -> xr.DataArray:
    """Complex peaks without a balancer, over source, foot, axis and order, N."""
    return _forces(results, speed, foot_orders(results, speed))


def _forces(results: xr.Dataset, speed: float, orders: list[int]) -> xr.DataArray:
    coordinates = {"speed": speed, "option": REFERENCE_OPTION, "order": orders}
    return results["foot_force_order"].sel(coordinates)


@needs("path_share")
def path_shares(results: xr.Dataset, receiver: str | None = None) -> Chart:
    """Shares of the ten leading paths of the modelled A-weighted energy, a bar a path.

    Without a balancer, at the speed of the published level or the nearest that is kept.

    Parameters
    ----------
    results : results of `run`; needs `path_share` (path_speed, option, path, receiver)
    receiver : a microphone; default: the catalogue's
    """
    name = chosen(results, "receiver", receiver or catalogue_receiver(results))
    share = at_path_speed(results, name)["path_share"].values
    rows = leading(share)
    sizes, position = 100.0 * share[rows], np.arange(len(rows))
    bars = (
        Bars(position[sizes >= 0.0], sizes[sizes >= 0.0], colour=COLOURS[3]),
        Bars(position[sizes < 0.0], sizes[sizes < 0.0], colour=COLOURS[1]),
    )
    labels = [wrapped(": ".join(path_words(results, row)), 34) for row in rows]
    x, height = Axis("Share of the modelled energy, %"), 0.7 + 0.33 * max(len(rows), 1)
    return Chart(
        f"paths_{dict(numbered(results, 'receiver'))[name]}",
        f"Shares of the leading paths of the modelled A-weighted energy at {name} as bars, to the "
        "left where a path works against the others; the numbers are in paths.csv.",
        f"{name}, {path_speed(results):g} rpm, option {REFERENCE_OPTION}: shares add up to 100 % "
        "over all paths; to the left what works against the others.",
        (Panel(x, named_axis(labels), bars, height=height),),
    )


def foot_bars(results: xr.Dataset, speed: float) -> Chart:
    """Peak forces into the feet at the first and second order."""
    forces = abs(foot_forces(results, speed).sum("source")).transpose("order", "axis", "foot")
    feet = [wrapped(str(name).replace("_", " ")) for name in forces["foot"].values]
    thick, position = 0.8 / forces.sizes["axis"], np.arange(len(feet))
    panels = tuple(
        Panel(
            Axis("Force into the foot, N peak", limits=(0.0, None)),
            named_axis(feet),
            tuple(
                Bars(position + (number - 1) * thick, along, 0.0, f"along {along['axis'].item()}",
                     None, COLOURS[1 + number], thick)
                for number, along in enumerate(of_order)
            ),
            f"{of_order['order'].item():g}×",
            0.7 + 0.35 * len(feet),
        )
        for of_order in forces
    )  # fmt: skip
    return Chart(
        "paths_feet",
        "Peak force into each foot along x, y and z at the first and second order as bars; the "
        "numbers are in feet.csv.",
        f"{speed:g} rpm, option {REFERENCE_OPTION}: force into each foot, peak.",
        panels,
    )
