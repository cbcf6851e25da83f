"""Levels around the machine in its loudest third octaves, as polar charts."""

from typing import Final

import numpy as np
import xarray as xr

from ...results.stored_study import catalogue_receiver
from ..charts.marks import Chart, Line, Panel
from ..charts.needs import needs
from .directivity import compass, decibel_rings

_DEPTH_DB: Final = 30.0
_NAMES: Final = {
    "horizontal": ("x", "y", "−x", "−y"),
    "vertical": ("mic.", "z", "", "−z"),
}


@needs("polar_level")
def polar_levels(results: xr.Dataset) -> Chart:
    """A-weighted level around the machine in each of its loudest third octaves, a line an option.

    A row a band: horizontal plane, and vertical plane through the microphone.

    Parameters
    ----------
    results : of `run`; needs `polar_level` (shown_option, polar_band, polar_plane,
        polar_direction), dB
    """
    level = results["polar_level"].transpose(
        "polar_band", "polar_plane", "shown_option", "polar_direction"
    )
    degrees = np.rad2deg(np.append(level["polar_direction"].values, 2.0 * np.pi))
    panels = []
    for band, of_band in zip(level["polar_band"].values, level, strict=True):
        radius = decibel_rings(5.0 * float(np.ceil(of_band.max() / 5.0)), _DEPTH_DB)
        for plane, values in zip(map(str, level["polar_plane"].values), of_band, strict=True):
            curves = tuple(
                Line(degrees, np.append(around, around[0]), str(option))
                for option, around in zip(level["shown_option"].values, values.values, strict=True)
            )
            title = f"{band:g} Hz, {plane}"
            panels.append(Panel(compass(_NAMES[plane]), radius, curves, title, 2.4, polar=True))
    bands = ", ".join(f"{band:g}" for band in level["polar_band"].values)
    return Chart(
        "polar_levels",
        f"A-weighted level around the machine in the third octaves at {bands} Hz, in a horizontal "
        "and a vertical plane.",
        f"Modelled A-weighted level in the loudest third octaves, dB(A), "
        f"{float(results['polar_radius']):.2f} m from the centre of mass at "
        f"{float(results['shown_speed']):g} rpm, of the representative sample. The vertical plane "
        f"holds {catalogue_receiver(results)}. The middle is {_DEPTH_DB:g} dB below the edge.",
        tuple(panels),
        columns=2,
    )
