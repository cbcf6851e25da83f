"""Forces on the shell through the joints of internal parts."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Final, Protocol

import numpy as np

from ...base.arrays import Array, IndexArray
from ...base.errors import ParameterError
from ...machine.shell_structure import Joint
from .elements import displacement_shapes, element_dofs, freedom_count
from .meridian import Meridian
from .modes import Around

JOINT_LOADS: Final = ("fx", "fy", "fz", "mz")
"""Unit forces along x, y, z and unit moment about z of an internal part on its joint."""
_BAND_POINTS: Final = 8
"""Heights over which the band of a joint is averaged, Gauss points."""
_SPREAD_POINTS: Final = 32
"""Angles over a weld, Gauss points; exact to rounding for cos nθ with n times its angle to 45."""


class Load(Protocol):
    """Unit loads, or unit responses: what a load drives is what a response there picks up."""

    def generalised(self, meridian: Meridian, around: Around) -> Array:
        """Force on each amplitude of a motion around the axis, shape (freedom, load)."""


@dataclass(frozen=True)
class JointLoads:
    """Unit loads `JOINT_LOADS` of a rigid internal part, shared equally by the welds of its joint.

    Equal shares are exact for evenly spaced welds that are as stiff outwards as around.
    """

    joint: Joint

    def generalised(self, meridian: Meridian, around: Around) -> Array:
        """Return the generalised force, see `Load`."""
        parts = self._mean_parts(around)
        parts[:, 3] /= meridian.wall_radius_m
        return mean_over_band(meridian, self.joint) @ parts

    def _mean_parts(self, around: Around) -> Array:
        """Means over the welds of the radial, axial and circumferential part, shape (3, load).

        x̂ = r̂ cos θ - θ̂ sin θ and ŷ = r̂ sin θ + θ̂ cos θ, times the factors of `Around`.
        """
        n = around.order
        turned = np.exp(-1j * n * around.angle_rad)
        up, down = turned * self._mean_exponential(n + 1), turned * self._mean_exponential(n - 1)
        cos_radial, sin_radial = 0.5 * (up + down).real, 0.5 * (up - down).imag
        sin_around, cos_around = 0.5 * (down - up).real, 0.5 * (up + down).imag
        level = turned * self._mean_exponential(n)
        twist = level.imag
        if n == 0:  # the factor around is 1
            sin_around, cos_around, twist = up.imag, up.real, 1.0
        return np.array(
            [
                [cos_radial, sin_radial, 0.0, 0.0],
                [0.0, 0.0, level.real, 0.0],
                [-sin_around, cos_around, 0.0, twist],
            ]
        )

    def _mean_exponential(self, order: int) -> complex:
        """Mean of e^{jmθ} over the welds: zero unless m is a multiple of their number."""
        joint = self.joint
        if order % joint.welds:
            return 0j
        spread = np.sinc(order * joint.spread_rad / (2.0 * np.pi))
        return complex(np.exp(1j * order * joint.first_angle_rad) * spread)


def weld_angles(joint: Joint) -> Array:
    """Middles of the welds from x, shape (weld,), rad."""
    return joint.first_angle_rad + 2.0 * np.pi * np.arange(joint.welds) / joint.welds


def patch_factors(joint: Joint, arounds: Sequence[Around]) -> Array:
    """Mean over each weld of the factors of motions: outwards, up, around; (motion, weld, 3)."""
    order = np.array([around.order for around in arounds])[:, None]
    turn = order * (
        weld_angles(joint) - np.array([around.angle_rad for around in arounds])[:, None]
    )
    mean = np.sinc(order * joint.spread_rad / (2.0 * np.pi))[..., None]
    radial, sideways = np.cos(turn), np.where(order, np.sin(turn), 1.0)
    return np.asarray(mean * np.stack([radial, radial, sideways], axis=-1))


@lru_cache(maxsize=32)
def mean_over_band(meridian: Meridian, joint: Joint) -> Array:
    """Mean over a joint's band of the motion of each amplitude, shape (freedom, 3).

    Outwards, up and around. Kept, as all orders around ask for it; not to be written to.

    Raises
    ------
    ParameterError
        The joint reaches beyond the wall.
    """
    low, high = meridian.wall_heights_m
    middle, band = joint.height_m, joint.band_m
    if middle - band / 2.0 < low or middle + band / 2.0 > high:
        raise ParameterError(
            f"joint: height_mm = {1e3 * middle:g} mm with band_mm = {1e3 * band:g} mm: the "
            f"wall reaches from {1e3 * low:.4g} to {1e3 * high:.4g} mm"
        )
    heights, weights = _mean_points(middle, band, _BAND_POINTS)
    points = np.stack([np.full(heights.size, meridian.wall_radius_m), heights], axis=1)
    dofs, shapes = interpolation(meridian, points)
    mean = np.zeros((freedom_count(meridian), 3))
    np.add.at(mean, dofs, np.einsum("p,pia->pai", weights, shapes))
    mean.flags.writeable = False
    return mean


def interpolation(meridian: Meridian, points: Array) -> tuple[IndexArray, Array]:
    """Freedoms (point, 12) that move places (point, 2), and by how much, (point, 3, 12)."""
    element, along = meridian.locate(points)
    return element_dofs(meridian)[element], displacement_shapes(meridian, element, along)


def _mean_points(middle: float, width: float, count: int) -> tuple[Array, Array]:
    """Places around a middle and their weights in the mean over a width."""
    if width == 0.0:
        return np.array([middle]), np.ones(1)
    node, weight = np.polynomial.legendre.leggauss(count)
    return middle + width / 2.0 * node, weight / 2.0


def joint_forces(joint: Joint, radius_m: float) -> tuple[Array, Array]:
    """The unit loads `JOINT_LOADS` as forces at points: for modes that are no `ShellMode`.

    Parameters
    ----------
    joint : welds
    radius_m : radius of the wall

    Returns
    -------
    points, forces : shapes (point, 3), m, and (point, 3, load), N, and 1/m for the moment
    """
    spread, weight = _mean_points(0.0, joint.spread_rad, _SPREAD_POINTS)
    welds = weld_angles(joint)
    heights, share = _mean_points(joint.height_m, joint.band_m, _BAND_POINTS)
    angle, height = (grid.ravel() for grid in np.meshgrid(np.add.outer(welds, spread), heights))
    weights = np.multiply.outer(share, np.tile(weight / joint.welds, joint.welds)).ravel()
    cosine, sine, zero = np.cos(angle), np.sin(angle), np.zeros_like(angle)
    unit = np.broadcast_to(np.eye(3), (angle.size, 3, 3))
    around = np.stack([-sine, cosine, zero], axis=1) / radius_m
    forces = weights[:, None, None] * np.concatenate([unit, around[..., None]], axis=2)
    return np.stack([radius_m * cosine, radius_m * sine, height], axis=1), forces
