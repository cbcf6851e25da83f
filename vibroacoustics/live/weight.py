"""A free weight on the shaft: what it does to the machine, linear in what the page varies."""

from typing import Final, NamedTuple

import numpy as np
import xarray as xr

from ..base.arrays import Array, ComplexArray
from ..machine.machine import Machine
from ..mechanics.capabilities import Slider
from ..mechanics.moving_parts import circling, wrench
from ..mechanics.rotation import Rotation
from ..orders.spectrum import order_spectrum_at_speed

FORCES: Final = 2.0
"""The heaviest weight makes about so many times the largest force at 1x without an option."""
ROUNDING: Final = 1e-9
_RADIUS_M: Final = 0.025
"""Radius of the weight where the machine names no planes for weights."""
_REACH_M: Final = 0.2
"""Reach from the shaft's origin, to both sides."""


class Weight(NamedTuple):
    """Range of a weight.

    Attributes
    ----------
    moment_kg_m : the largest mass times radius
    height_m : lowest and highest, along the shaft from the origin of the crank's frame
    radius_m : at which a mass makes the moment
    origin_m, shaft : where heights begin, from the centre of mass at rest, and along which axis
    """

    moment_kg_m: float
    height_m: tuple[float, float]
    radius_m: float
    origin_m: tuple[float, float, float]
    shaft: tuple[float, float, float]


def weight_of(machine: Machine, force_1x_n: Array, speed_rpm: Array) -> Weight:
    """Range of a weight on a machine.

    Parameters
    ----------
    machine : without an option
    force_1x_n : its largest force at 1x, by speed, shape (speed,)
    speed_rpm : shape (speed,)
    """
    slider = machine.capability(Slider)
    angular = 2.0 * np.pi * speed_rpm / 60.0
    moment = max(FORCES * float(np.max(force_1x_n / angular**2)), 1e-6)
    moment = float(f"{moment:.0e}")
    axes = machine.crank_frame.origin_m, machine.crank_frame.shaft
    if slider is None:
        return Weight(moment, (-_REACH_M, _REACH_M), _RADIUS_M, *axes)
    planes = slider.planes
    heights = (planes.lower_height_m, planes.upper_height_m, slider.height_m)
    return Weight(moment, (min(heights), max(heights)), planes.radius_m, *axes)


def unit_loads(machine: Machine, results: xr.Dataset, weight: Weight) -> ComplexArray:
    """Loads of 1 kg m on the shaft, above the pin: a force and a moment.

    The force of any angle is that at the pin, turned about the shaft; its moment follows from the
    point of the shaft at the weight's height. About the shaft a weight that speeds up and slows
    down makes m r² times the shaft's acceleration besides, wherever it is.

    Parameters
    ----------
    machine : on whose shaft it turns
    results : at one speed with one option, whose shaft turns it: `shaft_speed`,
        `shaft_acceleration`, `order`
    weight : its radius

    Returns
    -------
    shape (2: force and moment, axis, order), N and N m, complex peaks
    """
    speed = results["shaft_speed"].values
    rotation = Rotation(speed, results["shaft_acceleration"].values)
    radius, frame = weight.radius_m, machine.crank_frame._replace(origin_m=(0.0, 0.0, 0.0))
    part = circling("weight", 1.0 / radius, radius, 0.0, rotation.crank_angle, frame)
    loads = np.array(wrench((part,), rotation))
    lines = order_spectrum_at_speed(loads, speed, int(results["order"].max()))
    return np.where(np.abs(lines) > ROUNDING * np.max(np.abs(lines)), lines, 0.0)
