"""Forces on the shell: at points, and through the joints of internal parts."""

from dataclasses import dataclass
from typing import Final, Protocol

import numpy as np
from numpy.typing import NDArray

from ...errors import ParameterError
from ...parameters.shell_structure import Joint
from .elements import displacement_shapes, element_freedoms, freedom_count
from .meridian import Meridian, Real
from .modes import Around

Complex = NDArray[np.complex128]

JOINT_LOADS: Final = ("fx", "fy", "fz", "mz")
"""Unit forces along x, y, z and unit moment about z of an internal part on its joint."""
_BAND_POINTS: Final = 8
"""Heights over which the band of a joint is averaged, Gauss points."""


class Load(Protocol):
    """Unit loads, or unit responses: what a load drives is what a response there picks up."""

    def generalised(self, meridian: Meridian, around: Around) -> Real:
        """Force on each amplitude of a motion around the axis, shape (freedom, load)."""


@dataclass(frozen=True)
class PointForces:
    """Unit forces at points of the surface.

    Attributes
    ----------
    points : x, y, z about the centre of mass, shape (load, 3), m
    directions : unit vectors, shape (load, 3)
    """

    points: Real
    directions: Real

    def generalised(self, meridian: Meridian, around: Around) -> Real:
        angle = np.arctan2(self.points[:, 1], self.points[:, 0])
        place = np.stack([np.hypot(self.points[:, 0], self.points[:, 1]), self.points[:, 2]], 1)
        cosine, sine = np.cos(angle), np.sin(angle)
        x, y, axial = self.directions.T
        parts = np.stack(
            [
                (x * cosine + y * sine) * around.radial(angle),
                axial * around.radial(angle),
                (y * cosine - x * sine) * around.around(angle),
            ]
        )
        return _on_amplitudes(meridian, place, parts[:, :, None] * np.eye(angle.size))


@dataclass(frozen=True)
class JointLoads:
    """Unit loads `JOINT_LOADS` of a rigid internal part, shared equally by the welds of its joint.

    Equal shares are exact for evenly spaced welds that are as stiff outwards as around.
    """

    joint: Joint

    def generalised(self, meridian: Meridian, around: Around) -> Real:
        """Raises
        ------
        ParameterError
            The joint reaches beyond the wall.
        """
        heights, weights = self._heights(meridian)
        place = np.stack([np.full(heights.size, meridian.wall_radius_m), heights], axis=1)
        parts = self._mean_parts(around)
        parts[:, 3] /= meridian.wall_radius_m
        return _on_amplitudes(meridian, place, parts[:, None, :] * weights[:, None])

    def _heights(self, meridian: Meridian) -> tuple[Real, Real]:
        low, high = meridian.wall_heights_m
        middle, band = self.joint.height_m, self.joint.band_m
        if middle - band / 2.0 < low or middle + band / 2.0 > high:
            raise ParameterError(
                f"joint: height_mm = {1e3 * middle:g} mm with band_mm = {1e3 * band:g} mm: the "
                f"wall reaches from {1e3 * low:.4g} to {1e3 * high:.4g} mm"
            )
        if band == 0.0:
            return np.array([middle]), np.ones(1)
        place, weight = np.polynomial.legendre.leggauss(_BAND_POINTS)
        return middle + band / 2.0 * place, weight / 2.0

    def _mean_parts(self, around: Around) -> Real:
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


def _on_amplitudes(meridian: Meridian, place: Real, parts: Real) -> Real:
    """Sum over places (point, 2) of radial, axial, circumferential parts (3, point, load)."""
    element, along = meridian.locate(place)
    weights = displacement_shapes(meridian, element, along)
    shares = np.einsum("pia,ipl->pal", weights, parts)
    total = np.zeros((freedom_count(meridian), parts.shape[2]))
    np.add.at(total, element_freedoms(meridian)[element], shares)
    return total
