"""Curves of an Oldham ring's keys: forces across and along their slots, over one revolution."""

from collections.abc import Iterator
from typing import Final

import numpy as np

from ...base.curves import Curve, CurveAxis, angle_axis
from .rattle import KeyForces

KEYS: Final = (
    "in the scroll, y > 0",
    "in the scroll, y < 0",
    "in the housing, x > 0",
    "in the housing, x < 0",
)
SOURCE: Final = "four keys with clearance, film and friction, our equations"


def oldham_key_curves(forces: KeyForces) -> Iterator[Curve]:
    """Force on each of the four keys across its slot and, from friction, along it.

    Parameters
    ----------
    forces : of one revolution or more, of which the first is shown
    """
    samples = forces.normal_n.shape[-1] // forces.revolutions
    angle = angle_axis(forces.crank_angle[:samples])
    axes = (CurveAxis("key", list(KEYS)), angle)
    yield Curve(
        "key_force", "Forces on the Oldham keys across their slots",
        np.asarray(forces.normal_n[:, :samples]), axes, "n", SOURCE,
    )  # fmt: skip
    yield Curve(
        "key_friction_force", "Friction forces on the Oldham keys along their slots",
        np.asarray(forces.friction_n[:, :samples]), axes, "n", SOURCE,
    )  # fmt: skip
