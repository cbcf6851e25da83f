"""Green's function over ground, with a wall and a barrier, of a study. Time factor exp(+jωt)."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.special import wofz

from ...base.errors import ParameterError
from ...machine.shell import Shell
from ...study.surroundings import Surroundings
from ..arrays import Array, ComplexArray
from ..exact import Mirror, images, wavenumber
from .barrier import Barrier


@dataclass(frozen=True)
class Outdoors:
    """Ground and barrier on the path of the sound from the machine.

    Attributes
    ----------
    ground_z_m : height of the ground
    flow_resistivity_pa_s_per_m2 : flow resistivity of the ground; none where it is hard
    barrier : none where there is none
    """

    ground_z_m: float
    flow_resistivity_pa_s_per_m2: float | None = None
    barrier: Barrier | None = None

    def admittance(self, frequency_hz: float) -> complex:
        """β = ρc/Z of the ground."""
        if self.flow_resistivity_pa_s_per_m2 is None:
            return 0.0
        hertz = np.array(frequency_hz)
        return complex(1.0 / normalised_impedance(hertz, self.flow_resistivity_pa_s_per_m2))

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
        """Green's functions to several receivers: (receiver, point), one frequency after the
        other."""
        for hertz in frequency_hz:
            yield np.array(
                [self.green(points, receiver, float(hertz), walls) for receiver in receivers]
            )

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
    """Return which coordinates each image of `images` inverts, (image, 3)."""
    turned = np.zeros((1, 3))
    for wall in walls:
        turned = np.concatenate([turned, turned + np.eye(3)[wall.axis]])
    return turned % 2.0


def reflection_coefficient(
    wavenumber: float, admittance: complex, distance_m: Array, cosine: Array
) -> ComplexArray:
    """Q = R + (1 - R) F(w): strength of the image source, shape of the distances.

    Weyl-Van der Pol: R = (cos θ - β)/(cos θ + β), F(w) = 1 + j√π w exp(-w²) erfc(-jw),
    w = (1 + j)/2 √(2 k r2/2) (cos θ + β) with exp(-jωt) (Chien and Soroka, J. Sound Vib. 43 (1975)
    9; Attenborough, J. Acoust. Soc. Am. 68 (1980) 1521); here all is the complex conjugate. Leading
    term for waves short against r2 and |β| up to about one; exact on hard ground.

    Parameters
    ----------
    wavenumber : k, rad/m
    admittance : β = ρc/Z
    distance_m : r2 from the image source, shape (...)
    cosine : cosine of the angle of incidence from the vertical, cos θ = (z + h)/r2, shape (...)
    """
    if admittance == 0.0:
        return np.ones(np.shape(distance_m), dtype=complex)
    beta = np.conj(admittance)
    plane = (cosine - beta) / (cosine + beta)
    numerical = 0.5 * (1.0 + 1.0j) * np.sqrt(wavenumber * distance_m) * (cosine + beta)
    loss = 1.0 + 1.0j * np.sqrt(np.pi) * numerical * wofz(numerical)
    return np.asarray(np.conj(plane + (1.0 - plane) * loss))


def normalised_impedance(frequency_hz: Array, flow_resistivity_pa_s_per_m2: float) -> ComplexArray:
    """Surface impedance of deep porous ground over that of air, time factor exp(+jωt).

    Z/(ρc) = 1 + 5.50 x^-0.632 - j 8.43 x^-0.632, x = 1000 f/σ (Miki, J. Acoust. Soc. Jpn. (E) 11
    (1990) 19, eq. 30 and 31 with the flow resistivity in SI).

    Parameters
    ----------
    frequency_hz : above zero, shape (...)
    flow_resistivity_pa_s_per_m2 : σ, effective for the ground
    """
    ratio = 1e3 * np.asarray(frequency_hz, dtype=float) / flow_resistivity_pa_s_per_m2
    return np.asarray(1.0 + (5.50 - 8.43j) * ratio**-0.632)


_LEAST_GAP_M: Final = 0.3
"""Distance from the machine to a barrier, whose echo to the machine is neglected."""


def outdoors_of(shell: Shell, surroundings: Surroundings) -> Outdoors | None:
    """Ground and barrier; none on a floor alone or in free field."""
    if not surroundings.is_outdoors:
        return None
    ground, barrier_settings = surroundings.ground, surroundings.barrier
    barrier = None
    if barrier_settings is not None:
        sign = -1 if barrier_settings.side[0] == "-" else 1
        axis, top_m = (
            "xyz".index(barrier_settings.side[1]),
            shell.floor_z_m + barrier_settings.height_m,
        )
        barrier = Barrier(axis, sign, sign * barrier_settings.distance_m, top_m)
    resistivity = None if ground is None else ground.resistivity_pa_s_per_m2
    return Outdoors(shell.floor_z_m, resistivity, barrier)


def check_barrier(outdoors: Outdoors | None, corners: Array) -> None:
    """Refuse a barrier that is not clear of the machine and its cabinet.

    Parameters
    ----------
    outdoors : with or without a barrier
    corners : lower and upper one of what stands there, shape (2, 3), m

    Raises
    ------
    ParameterError
        It is too near.
    """
    barrier = None if outdoors is None else outdoors.barrier
    if barrier is None:
        return
    gap = float((barrier.sign * (barrier.position_m - corners[:, barrier.axis])).min())
    if gap < _LEAST_GAP_M:
        raise ParameterError(
            f"radiation.surroundings.barrier: the machine is {1e3 * gap:.4g} mm off it; needed at "
            f"least {1e3 * _LEAST_GAP_M:g} mm"
        )
