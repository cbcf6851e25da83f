"""Outline of the machine, from the side and from above, about its centre of mass."""

from collections.abc import Mapping
from typing import Any, Final, NamedTuple

import numpy as np

from ...base.arrays import Array

CIRCLE: Final = 2.0 * np.pi * np.arange(48) / 48


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

    A mesh is drawn as the shell's cylinder: the results do not hold its triangles.
    """
    bottom = -shell["centre_of_mass_height_m"]
    floor = bottom - shell["floor_clearance_m"]
    kind = body.get("kind", "shell")
    if kind == "box":
        half_x, half_y = body["length_m"] / 2.0, body["width_m"] / 2.0
        side = _rectangle(half_x, bottom, bottom + body["height_m"])
        return Outline(side, _rectangle(half_x, -half_y, half_y), floor)
    if kind == "sphere":
        radius = body["diameter_m"] / 2.0
        circle = radius * _circle()
        return Outline(circle + np.array([0.0, bottom + radius]), circle, floor)
    radius = shell["outer_diameter_m"] / 2.0
    return Outline(_cylinder(shell, radius, bottom), radius * _circle(), floor)


def feet_m(machine: Mapping[str, Any]) -> Array:
    """Feet (x, y, z) from the centre of mass, shape (foot, 3); four in a square if not given.

    None in files of older versions, which hold no mounts.
    """
    under = -machine["shell"]["centre_of_mass_height_m"]
    feet = machine.get("feet")
    if feet:
        given = [foot for _, foot in sorted(feet.items()) if foot is not None]
        heights = [under if foot.get("height_m") is None else foot["height_m"] for foot in given]
        return np.array([(f["x_m"], f["y_m"], z) for f, z in zip(given, heights, strict=True)])
    if not machine.get("mounts"):
        return np.empty((0, 3))
    half = machine["mounts"]["pitch_m"] / 2.0
    return np.array([(x, y, under) for x in (half, -half) for y in (half, -half)])


def _circle() -> Array:
    return np.column_stack([np.cos(CIRCLE), np.sin(CIRCLE)])


def _rectangle(half: float, lower: float, upper: float) -> Array:
    return np.array([(-half, lower), (half, lower), (half, upper), (-half, upper)])


def _cylinder(shell: Mapping[str, Any], radius: float, bottom: float) -> Array:
    """Half-ellipses as caps; flat ones where the domes have no height."""
    dome, top = shell["dome_height_m"], bottom + shell["height_m"]
    arc = np.linspace(0.0, np.pi, 25)
    upper = np.column_stack([radius * np.cos(arc), top - dome + dome * np.sin(arc)])
    lower = np.column_stack([-radius * np.cos(arc), bottom + dome - dome * np.sin(arc)])
    return np.concatenate([upper, lower])
