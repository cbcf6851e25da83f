"""Sound fields that are known around any body: of monopoles inside it, and of their images.

The velocity that such a field has at the body's surface makes the body radiate that very field,
whatever its shape and whatever hard walls stand around it. No second method is needed.
"""

from dataclasses import dataclass
from functools import partial

import numpy as np

from vibroacoustics.base.constants import AIR_DENSITY_KG_PER_M3
from vibroacoustics.radiation.arrays import Array, ComplexArray
from vibroacoustics.radiation.bodies import Body
from vibroacoustics.radiation.exact import Mirror, images, wavenumber
from vibroacoustics.radiation.machine_side import ERROR, MachineSide, near_fields
from vibroacoustics.radiation.neglected_echo import SAFETY, neglected_echo
from vibroacoustics.radiation.patterns import Pattern
from vibroacoustics.radiation.scene import Scene
from vibroacoustics.radiation.surface_points import SurfacePoints
from vibroacoustics.radiation.task import Microphones


@dataclass(frozen=True)
class Field:
    """Of monopoles inside a body."""

    sources: Array
    """(source, 3), m."""
    strengths: Array
    """Volume velocities, (source,), m³/s."""
    walls: tuple[Mirror, ...] = ()

    def pressure(self, points: Array, frequency_hz: float) -> ComplexArray:
        """At points (point, 3), Pa."""
        k = float(wavenumber(np.array([frequency_hz]))[0])
        total = np.zeros(points.shape[0], dtype=complex)
        for place, strength in self._all():
            distance = np.linalg.norm(points - place, axis=1)
            total += strength * np.exp(-1j * k * distance) / (4 * np.pi * distance)
        return 2j * np.pi * frequency_hz * AIR_DENSITY_KG_PER_M3 * total

    def velocity(self, points: Array, frequency_hz: float) -> ComplexArray:
        """At points (point, 3), m/s, (point, 3): j omega rho v = - grad p."""
        k = float(wavenumber(np.array([frequency_hz]))[0])
        total = np.zeros(points.shape, dtype=complex)
        for place, strength in self._all():
            offset = points - place
            distance = np.linalg.norm(offset, axis=1)[:, None]
            slope = (1.0 + 1j * k * distance) * np.exp(-1j * k * distance) / distance**3
            total += strength / (4 * np.pi) * slope * offset
        return total

    def _all(self) -> list[tuple[Array, float]]:
        return [
            (place, strength)
            for source, strength in zip(self.sources, self.strengths, strict=True)
            for place in images(source, self.walls)[0]
        ]


def errors(
    body: Body, field: Field, frequency_hz: Array, spacing_m: float, points: Array
) -> tuple[Array, Array]:
    """Largest of the machine side at points, (frequency,), and the one that it estimates.

    Both against the largest exact pressure at the frequency. The velocity is complex and another at
    each frequency: its real and its imaginary part are two patterns.
    """
    scene = Scene(body, (), field.walls)
    patterns = [
        Pattern(f"{hertz:g} Hz", partial(_part, field, hertz, imaginary))
        for hertz in frequency_hz
        for imaginary in (False, True)
    ]
    near = near_fields(scene, spacing_m, 1000.0)
    radiated = MachineSide(scene, near, patterns, frequency_hz, [Microphones(points)]).closed[0]
    exact = np.stack([field.pressure(points, hertz) for hertz in frequency_hz], axis=1)
    largest = np.abs(exact).max(axis=0)
    simulated, estimated = (
        np.stack(
            [
                values[:, 2 * number, number] + 1j * values[:, 2 * number + 1, number]
                for number in range(frequency_hz.size)
            ],
            axis=1,
        )
        for values in (radiated.pressure, radiated.correction)
    )
    true = np.abs(simulated - exact).max(axis=0)
    share = SAFETY * neglected_echo(scene, patterns, frequency_hz, points)
    share *= np.abs(radiated.pressure).max(axis=0)
    echo = [
        np.hypot(share[:, 2 * number, number], share[:, 2 * number + 1, number]).max()
        for number in range(frequency_hz.size)
    ]
    grids = ERROR * np.abs(estimated).max(axis=0)
    return true / largest, (grids + echo) / largest


def _part(field: Field, frequency_hz: float, imaginary: bool, at: SurfacePoints) -> Array:
    velocity = field.velocity(at.position, frequency_hz)
    return velocity.imag if imaginary else velocity.real
