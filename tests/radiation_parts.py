"""Parts that tests of the radiation share: a hard floor, a pattern by its normal velocity."""

from collections.abc import Callable

from vibroacoustics.radiation.arrays import Array, ComplexArray
from vibroacoustics.radiation.box import Box, BoxField
from vibroacoustics.radiation.mirrors import Mirror
from vibroacoustics.radiation.patterns import Pattern


def floor(position_z_m: float) -> Mirror:
    """Hard floor at a height."""
    return Mirror(axis=2, sign=-1, position_m=position_z_m)


def normal_velocity(name: str, velocity: Callable[[Array], Array]) -> Pattern:
    """Pattern of a normal velocity (point,) given as a function of points (point, 3)."""
    return Pattern(name, lambda at: velocity(at.position)[:, None] * at.normal)


def join(box: Box, near: BoxField, green: BoxField) -> ComplexArray:
    """The integral of `radiation.join` over a box as it is written, (frequency,)."""
    pressure: ComplexArray = (near.inner * green.outer - near.outer * green.inner) @ box.weights
    return pressure
