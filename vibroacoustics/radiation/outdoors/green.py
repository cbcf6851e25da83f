"""Green's functions over ground, with one upright wall and a barrier. Time factor exp(+jωt)."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import Array, ComplexArray
from ..exact import wavenumber
from ..mirrors import Mirror, images
from .barrier import Barrier
from .miki import normalised_impedance
from .spherical_wave import reflection_coefficient


@dataclass(frozen=True)
class Outdoors:
    """What sound meets on its way from the machine.

    Attributes
    ----------
    ground_z_m : height of the ground
    flow_resistivity_pa_s_per_m2 : of the ground; none where it is hard
    barrier : none where there is none
    """

    ground_z_m: float
    flow_resistivity_pa_s_per_m2: float | None = None
    barrier: Barrier | None = None

    def admittance(self, frequency_hz: float) -> complex:
        """β = ρc/Z of the ground."""
        if self.flow_resistivity_pa_s_per_m2 is None:
            return 0.0
        at = np.array(frequency_hz)
        return complex(1.0 / normalised_impedance(at, self.flow_resistivity_pa_s_per_m2))

    def green(
        self, points: Array, receiver: Array, frequency_hz: float, walls: Sequence[Mirror] = ()
    ) -> ComplexArray:
        """Green's function from points (point, 3) to a receiver (3,), 1/m, (point,).

        Walls across x or y make images of the points.
        """
        total = np.zeros(len(points), dtype=complex)
        positions, strengths = images(np.zeros(3), walls)
        signs = 1.0 - 2.0 * (_parities(walls))
        for offset, sign, strength in zip(positions, signs, strengths, strict=True):
            total += strength * self._of_image(sign * points + offset, receiver, frequency_hz)
        return total

    def rows(
        self, points: Array, receivers: Array, frequency_hz: Array, walls: Sequence[Mirror] = ()
    ) -> Iterator[ComplexArray]:
        """The same to several receivers: (receiver, point), one frequency after the other."""
        for hertz in frequency_hz:
            yield np.array([self.green(points, one, float(hertz), walls) for one in receivers])

    def _of_image(self, points: Array, receiver: Array, frequency_hz: float) -> ComplexArray:
        k = float(wavenumber(np.array(frequency_hz)))
        beta = self.admittance(frequency_hz)
        below = _mirrored(points, self.ground_z_m)
        if self.barrier is None or not self.barrier.hides(receiver):
            reflected = self._reflection(points, receiver, k, beta)
            return _wave(points, receiver, k) + reflected * _wave(below, receiver, k)
        edge = self.barrier.edge_points(points, receiver)
        before = self._reflection(points, edge, k, beta)
        behind = self._reflection(edge, receiver, k, beta)
        deep = _mirrored(receiver, self.ground_z_m)
        wave = self.barrier.wave
        return np.asarray(
            wave(points, receiver, k) + before * wave(below, receiver, k)
            + behind * (wave(points, deep, k) + before * wave(below, deep, k))
        )  # fmt: skip

    def _reflection(self, points: Array, ends: Array, k: float, beta: complex) -> ComplexArray:
        """Strength of the images of points in the ground, to ends (3,) or one for each."""
        distance = np.linalg.norm(ends - _mirrored(points, self.ground_z_m), axis=-1)
        heights = points[..., 2] + ends[..., 2] - 2.0 * self.ground_z_m
        return reflection_coefficient(k, beta, distance, heights / distance)


def _wave(points: Array, receiver: Array, k: float) -> ComplexArray:
    """Free field, 1/m."""
    distance = np.linalg.norm(receiver - points, axis=-1)
    return np.asarray(np.exp(-1j * k * distance) / (4.0 * np.pi * distance))


def _mirrored(points: Array, ground_z_m: float) -> Array:
    return np.asarray(points * [1.0, 1.0, -1.0] + [0.0, 0.0, 2.0 * ground_z_m])


def _parities(walls: Sequence[Mirror]) -> Array:
    """Which coordinates each image of `images` turns round, (image, 3)."""
    turned = np.zeros((1, 3))
    for wall in walls:
        turned = np.concatenate([turned, turned + np.eye(3)[wall.axis]])
    return turned % 2.0
