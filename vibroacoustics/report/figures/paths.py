"""Bars of the leading paths of sound, and of the forces into the feet."""

import numpy as np
import xarray as xr

from ...base.vocabulary import REFERENCE_OPTION
from ...results.stored_study import catalogue_receiver
from ...results.titles import chosen
from ..charts.layout import COLOURS, wrapped
from ..charts.marks import Axis, Bars, Chart, Panel, named_axis
from ..charts.needs import needs
from ..file_names import numbered
from ..sections.paths.tables import at_path_speed, foot_forces, leading, path_speed, path_words


@needs("path_share")
def path_shares(results: xr.Dataset, receiver: str | None = None) -> Chart:
    """Shares of the ten leading paths of the modelled A-weighted energy, a bar a path.

    Without a balancer, at the speed of the published level or the nearest that is kept.

    Parameters
    ----------
    results : of `run`; needs `path_share` (path_speed, option, path, receiver)
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
