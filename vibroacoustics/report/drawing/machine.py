"""Outline of the machine about its centre of mass, and its forces at 1× without a balancer."""

from collections.abc import Mapping
from typing import Any, Final, NamedTuple

import numpy as np
import xarray as xr

from ...base.arrays import Array, ComplexArray
from ...base.revolution import shell_profile, sphere
from ...base.vocabulary import REFERENCE_OPTION

_ANGLE: Final = 2.0 * np.pi * np.arange(48) / 48
_CIRCLE: Final = np.column_stack([np.cos(_ANGLE), np.sin(_ANGLE)])


class Outline(NamedTuple):
    """Closed lines, m.

    Attributes
    ----------
    side : x and z, shape (point, 2)
    above : x and y, shape (point, 2)
    floor_z_m : height of the floor from the centre of mass
    """

    side: Array
    above: Array
    floor_z_m: float


def outline(shell: Mapping[str, Any], body: Mapping[str, Any]) -> Outline:
    """Outline of the shell, or of the block or sphere that radiates in its stead.

    A mesh is drawn as the shell: the results do not hold its triangles.
    """
    bottom = -shell["centre_of_mass_height_m"]
    floor = bottom - shell["floor_clearance_m"]
    kind = body.get("kind", "shell")
    if kind == "box":
        half_x, half_y = body["length_m"] / 2.0, body["width_m"] / 2.0
        side = rectangle(half_x, bottom, bottom + body["height_m"])
        return Outline(side, rectangle(half_x, -half_y, half_y), floor)
    radius = body["diameter_m"] / 2.0 if kind == "sphere" else 0.0
    profile = sphere(radius, bottom + radius) if radius else shell_profile(shell)
    right = profile.points()
    side = np.concatenate([right, right[::-1] * [-1.0, 1.0]])
    return Outline(side, profile.radius_m * _CIRCLE, floor)


def feet_m(machine: Mapping[str, Any]) -> Array:
    """Feet (x, y, z) from the centre of mass, shape (foot, 3); four in a square if not given.

    None in files of older versions, which hold no mounts.
    """
    under = -machine["shell"]["centre_of_mass_height_m"]
    feet = machine.get("feet")
    if feet:
        given_feet = [foot for _, foot in sorted(feet.items()) if foot is not None]
        heights = [
            under if foot.get("height_m") is None else foot["height_m"] for foot in given_feet
        ]
        return np.array([(f["x_m"], f["y_m"], z) for f, z in zip(given_feet, heights, strict=True)])
    if not machine.get("mounts"):
        return np.empty((0, 3))
    half = machine["mounts"]["pitch_m"] / 2.0
    return np.array([(x, y, under) for x in (half, -half) for y in (half, -half)])


def rectangle(half: float, lower: float, upper: float) -> Array:
    """Corners of a rectangle about the vertical axis, shape (4, 2)."""
    return np.array([(-half, lower), (half, lower), (half, upper), (-half, upper)])


NEEDED = ("force_order", "moment_order", "foot_force_order", "force_amplitude", "moment_amplitude")


class Loads(NamedTuple):
    """Complex peaks at 1×, at the speed at which the resultant force is largest.

    Force and moment on the machine about its centre of mass, shape (axis,), with the semi-major
    axes of their ellipses, and forces into the feet, shape (foot, axis).
    """

    speed_rpm: float
    force_n: ComplexArray
    moment_nm: ComplexArray
    foot_force_n: ComplexArray
    force_amplitude_n: float
    moment_amplitude_nm: float


def loads(results: xr.Dataset) -> Loads | None:
    """Nominal loads without a balancer; None in files of older versions."""
    if any(name not in results for name in NEEDED):
        return None
    first = results[list(NEEDED)].sel(option=REFERENCE_OPTION, order=1)
    loudest = first.isel(speed=int(first["force_amplitude"].argmax("speed")))
    return Loads(
        float(loudest["speed"]),
        loudest["force_order"].sum("source").values,
        loudest["moment_order"].sum("source").values,
        loudest["foot_force_order"].sum("source").transpose("foot", "axis").values,
        float(loudest["force_amplitude"]),
        float(loudest["moment_amplitude"]),
    )


def turn(peak: ComplexArray, axes: tuple[int, int]) -> Array:
    """Ends of the vector Re{peak exp(j angle)} over a turn in the plane of axes, shape (72, 2)."""
    angle = 2.0 * np.pi * np.arange(72) / 72
    return np.asarray((np.exp(1j * angle)[:, None] * peak[list(axes)]).real)
