"""Levels around the machine as polar charts: at unit velocity, and in its loudest bands."""

from collections.abc import Iterator
from typing import Final

import numpy as np
import xarray as xr

from ...base.arrays import Array
from ...results.stored_study import catalogue_receiver
from ..charts.axes import ticks_at
from ..charts.layout import COLOURS
from ..charts.marks import Axis, Chart, Line, Panel
from ..charts.needs import needs
from .maps import DEPTH_DB, dof_title, names, silent_dofs, unit_level_db

_HORIZONTAL: Final = ("x", "y", "−x", "−y")
_VERTICAL: Final = ("x, y", "z", "−x, −y", "−z")


@needs(
    "directivity_transfer_vector", from_="`radiate` of a study with a table radiation.directivity"
)
def directivity(radiated: xr.Dataset) -> Chart:
    """Vertical and horizontal cuts of each motion that radiates, dB at 1 mm/s or 1 mrad/s.

    At the highest 1x line.

    Parameters
    ----------
    radiated : result of `radiate`; needs `directivity_transfer_vector`
        (polar_angle, azimuth, dof, line_frequency), Pa s/m
    """
    field = radiated["directivity_transfer_vector"].isel(line_frequency=-1)
    field = field.transpose("dof", "polar_angle", "azimuth")
    frequency, dofs = float(field["line_frequency"]), names(field, "dof")
    silent = silent_dofs(field.values, dofs)
    angles = (field["polar_angle"].values, field["azimuth"].values)
    cuts = [
        panel
        for dof, values in zip(dofs, field.values, strict=True)
        if dof not in silent
        for panel in _cuts(dof_title(dof), unit_level_db(values), *angles)
    ]
    left_out = f" Silent and left out: {', '.join(silent)}." if silent else ""
    return Chart(
        "directivity",
        f"Directivity at {frequency:.1f} Hz: vertical and horizontal cuts for every degree of "
        "freedom that radiates.",
        f"Level around the machine at {frequency:.1f} Hz when the housing moves at 1 mm/s or turns "
        "at 1 mrad/s (root mean square) in one degree of freedom: planes xz and yz, and the cone "
        f"nearest to the horizon (xy). The middle is {DEPTH_DB:g} dB below the edge.{left_out}",
        tuple(cuts),
        columns=2,
        title=f"{frequency:.1f} Hz, level in dB re 20 µPa",
    )


def compass(names: tuple[str, ...]) -> Axis:
    """Return the angles of a polar panel, with the names at the right, above, left and below."""
    ticks = ((45.0 * step, "" if step % 2 else names[step // 2]) for step in range(8))
    return Axis(ticks=tuple(ticks))


def decibel_rings(highest_db: float, depth_db: float = DEPTH_DB) -> Axis:
    """Return the radius of a polar panel of levels, with rings 10 dB apart."""
    top_db = 5.0 * float(np.ceil(highest_db / 5.0))
    rings = top_db - 10.0 * np.arange(round(depth_db / 10.0))
    return Axis(limits=(top_db - depth_db, top_db), ticks=ticks_at(rings))


def _cuts(title: str, level: Array, polar_angle: Array, azimuth: Array) -> Iterator[Panel]:
    """Planes x-z and y-z with z up, and the cone nearest to the horizon from above."""
    radius = decibel_rings(level.max())
    turned = 90.0 + np.rad2deg(np.concatenate([-polar_angle[::-1], polar_angle]))
    planes = (("xz", 0.0, COLOURS[3], "-"), ("yz", 0.5, COLOURS[1], "--"))
    upright = []
    for name, half_turns, colour, dash in planes:
        near, far = (_column(azimuth, np.pi * (half_turns + turn)) for turn in (0.0, 1.0))
        curve = np.concatenate([level[::-1, near], level[:, far]])
        upright.append(Line(turned, curve, name, colour=colour, dash=dash))
    row = int(np.argmin(np.abs(polar_angle - np.pi / 2.0)))
    around = np.rad2deg(np.append(azimuth, azimuth[0]))
    flat = Line(around, np.append(level[row], level[row, 0]), "xy", colour=COLOURS[5], dash="-")
    yield Panel(compass(_VERTICAL), radius, tuple(upright), title, 2.5, polar=True)
    yield Panel(compass(_HORIZONTAL), radius, (flat,), " ", 2.5, polar=True)


def _column(azimuth: Array, wanted: float) -> int:
    return int(np.argmin(np.abs(np.exp(1j * azimuth) - np.exp(1j * wanted))))


_DEPTH_DB: Final = 30.0
_NAMES: Final = {"horizontal": _HORIZONTAL, "vertical": ("mic.", "z", "", "−z")}


@needs("polar_level")
def polar_levels(results: xr.Dataset) -> Chart:
    """A-weighted level around the machine in each of its loudest third octaves, a line an option.

    A row a band: horizontal plane, and vertical plane through the microphone.

    Parameters
    ----------
    results : results of `run`; needs `polar_level` (shown_option, polar_band, polar_plane,
        polar_direction), dB
    """
    dims = ("polar_band", "polar_plane", "shown_option", "polar_direction")
    level = results["polar_level"].transpose(*dims)
    degrees = np.rad2deg(np.append(level["polar_direction"].values, 2.0 * np.pi))
    panels = []
    for band, of_band in zip(level["polar_band"].values, level, strict=True):
        radius = decibel_rings(float(of_band.max()), _DEPTH_DB)
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
        f"{float(results['shown_speed']):g} rpm. The vertical plane holds "
        f"{catalogue_receiver(results)}. With samples, levels there are medians, and differences "
        f"around the machine those of one sample. The middle is {_DEPTH_DB:g} dB below the edge.",
        tuple(panels),
        columns=2,
    )
