"""Forces and moment at 1× without a balancer, as the drawing shows them."""

from typing import NamedTuple

import numpy as np
import xarray as xr

from ...base.arrays import Array, ComplexArray
from ...base.vocabulary import REFERENCE_OPTION

NEEDED = ("force_order", "moment_order", "foot_force_order", "force_amplitude", "moment_amplitude")


class Loads(NamedTuple):
    """Complex peaks at 1×, at one speed.

    Attributes
    ----------
    speed_rpm : at which the resultant force is largest
    force_n, moment_nm : on the machine about its centre of mass, shape (axis,)
    foot_force_n : into the feet, shape (foot, axis)
    force_amplitude_n, moment_amplitude_nm : semi-major axes of their ellipses
    """

    speed_rpm: float
    force_n: ComplexArray
    moment_nm: ComplexArray
    foot_force_n: ComplexArray
    force_amplitude_n: float
    moment_amplitude_nm: float


def loads(results: xr.Dataset) -> Loads | None:
    """Loads without a balancer, as given; None in files of older versions."""
    if any(name not in results for name in NEEDED):
        return None
    first = results[list(NEEDED)].sel(option=REFERENCE_OPTION, order=1)
    at = first.isel(speed=int(first["force_amplitude"].argmax("speed")))
    feet = at["foot_force_order"].sum("source").transpose("foot", "axis").values
    return Loads(
        float(at["speed"]),
        at["force_order"].sum("source").values,
        at["moment_order"].sum("source").values,
        feet,
        float(at["force_amplitude"]),
        float(at["moment_amplitude"]),
    )


def turn(peak: ComplexArray, axes: tuple[int, int]) -> Array:
    """Ends of the vector Re{peak exp(j angle)} over a turn in a plane, shape (72, 2).

    Parameters
    ----------
    peak : complex peak, shape (axis,)
    axes : numbers of the axes of the plane
    """
    angle = 2.0 * np.pi * np.arange(72) / 72
    return np.asarray((np.exp(1j * angle)[:, None] * peak[list(axes)]).real)
