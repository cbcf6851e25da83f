"""Motion of feet and named points of the housing, from its rigid-body motion at the orders."""

from collections.abc import Mapping
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array, ComplexArray
from ..base.revolution import shell_profile
from ..base.vocabulary import AXES, RIGID_BODY_DOFS
from ..results.data_sheet import Vibration
from ..results.stored_study import parameters

_ANGLES_PER_ORDER: Final = 32
"""Number for the highest order: a peak is then found within half a percent."""
WORDS: Final = (
    "rigid-body motion of the housing on its mounts at shaft orders, all sources together, with "
    "the nominal values; it neglects bending of the wall, lines of the motor and noise"
)


def point_velocity(velocity: ComplexArray, offset_m: Array) -> ComplexArray:
    """v + w × r of a rigid body, (axis, order).

    Parameters
    ----------
    velocity : shape (dof, order), complex peaks at the centre of mass, m/s and rad/s
    offset_m : offset of the point from the centre of mass, shape (3,)
    """
    turned = np.cross(velocity[3:], offset_m[:, None], axis=0)
    return np.asarray(velocity[:3] + turned)


def peak_to_peak(peaks: ComplexArray, orders: Array) -> Array:
    """Highest less lowest value over a revolution of a sum of orders, (...,).

    Parameters
    ----------
    peaks : complex peaks, shape (..., order)
    orders : orders, whole numbers, shape (order,)
    """
    count = int(_ANGLES_PER_ORDER * max(orders.max(initial=1.0), 1.0))
    angle = 2.0 * np.pi * np.arange(count) / count
    history = (peaks @ np.exp(1j * np.outer(orders, angle))).real
    return np.asarray(np.ptp(history, axis=-1))


def vibration(case: xr.Dataset, points_m: Mapping[str, Array]) -> tuple[Vibration, ...]:
    """Return the motion of every foot and point in every direction.

    Parameters
    ----------
    case : results at an option and a speed
    points_m : further points from the centre of mass, (3,), by name
    """
    velocity = case["velocity_order"].sum("source").sel(dof=list(RIGID_BODY_DOFS))
    hertz = case["order_frequency"].values
    sounding = hertz > 0.0
    peaks = velocity.transpose("dof", "order").values[:, sounding]
    orders, omega = case["order"].values[sounding].astype(float), 2.0 * np.pi * hertz[sounding]
    feet = dict(zip(map(str, case["foot"].values), case["foot_position"].values, strict=True))
    motions = []
    for name, offset in {**feet, **points_m}.items():
        motion = point_velocity(peaks, offset)
        displacement = peak_to_peak(motion / (1j * omega), orders)
        speed, acceleration = _rms(motion), _rms(motion * omega)
        motions += [
            Vibration(
                point=name,
                direction=axis,
                displacement_peak_to_peak_m=float(displacement[row]),
                velocity_rms_m_per_s=float(speed[row]),
                acceleration_rms_m_per_s2=float(acceleration[row]),
            )
            for row, axis in enumerate(AXES)
        ]
    return tuple(motions)


def offsets_m(
    results: xr.Dataset, points_m: Mapping[str, tuple[float, float, float]]
) -> dict[str, Array]:
    """Named points from the centre of mass, the top of the shell among them.

    Parameters
    ----------
    results : results of a run
    points_m : x, y and height above the floor, as microphones are given
    """
    shell = parameters(results)["machine"]["shell"]
    below = shell["centre_of_mass_height_m"] + shell["floor_clearance_m"]
    top = below + shell_profile(shell).top_z_m
    named = {"top of the shell": (0.0, 0.0, top), **points_m}
    return {name: np.array([x, y, height - below]) for name, (x, y, height) in named.items()}


def _rms(peaks: ComplexArray) -> Array:
    return np.asarray(np.sqrt(0.5 * np.sum(np.abs(peaks) ** 2, axis=-1)))
