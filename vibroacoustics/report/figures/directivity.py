"""Levels around the machine at unit velocity, as polar cuts."""

from collections.abc import Iterator
from typing import Final

import numpy as np
import xarray as xr

from ...base.arrays import Array
from ..charts.layout import COLOURS
from ..charts.marks import Axis, Chart, Line, Panel
from ..charts.needs import needs
from .maps import DEPTH_DB, dof_title, names, silent_dofs, unit_level_db

_HORIZONTAL: Final = ("x", "y", "−x", "−y")
_VERTICAL: Final = ("x, y", "z", "−x, −y", "−z")


@needs(
    "directivity_transfer_vector",
    from_="`radiate` of a study with a table radiation.directivity",
)
def directivity(radiated: xr.Dataset) -> Chart:
    """Vertical and horizontal cuts of each motion that radiates, dB at 1 mm/s or 1 mrad/s.

    At the highest 1x line.

    Parameters
    ----------
    radiated : of `radiate`; needs `directivity_transfer_vector`
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
    """Return the angles of a polar panel, with a name at each quarter.

    Parameters
    ----------
    names : at the right, above, at the left and below
    """
    return Axis(
        ticks=tuple((45.0 * step, "" if step % 2 else names[step // 2]) for step in range(8))
    )


def decibel_rings(top_db: float, depth_db: float = DEPTH_DB, step_db: float = 10.0) -> Axis:
    """Return the radius of a polar panel of levels."""
    rings = top_db - step_db * np.arange(round(depth_db / step_db))
    ticks = tuple((float(ring), f"{ring:.0f}".replace("-", "−")) for ring in rings)
    return Axis(limits=(top_db - depth_db, top_db), ticks=ticks)


def _cuts(title: str, level: Array, polar_angle: Array, azimuth: Array) -> Iterator[Panel]:
    """Planes x-z and y-z with z up, and the cone nearest to the horizon from above."""
    radius = decibel_rings(5.0 * float(np.ceil(level.max() / 5.0)))
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
