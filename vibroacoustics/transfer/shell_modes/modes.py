"""Elastic modes of the closed shell as motions of its surface."""

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Final, NamedTuple

import numpy as np

from ...base.arrays import Array, IndexArray
from ...base.errors import ParameterError
from ...machine.shell import Shell
from ...machine.shell_structure import ShellStructure
from .elements import (
    CIRCUMFERENTIAL,
    NODE_DOFS,
    ROTATION,
    displacement_shapes,
    element_dofs,
)
from .harmonic import Harmonic
from .meridian import Meridian, closed_meridian

MAXIMUM_ORDER: Final = 64
"""Most waves around the circumference that are looked for."""
_FOUR_POSITIONS: Final = np.linspace(-1.0, 1.0, 4)
"""Positions along an element; they fix a cubic."""
_ALIKE: Final = 1e-6
"""Relative difference of displacements below which they are equal: solvers leave 1e-11."""


class Around(NamedTuple):
    """Variation of a motion with the angle: `radial` and axial parts, and the one around."""

    order: int
    angle_rad: float
    """Angle of the largest radial motion: 0, or π/(2n) for the mode's twin."""

    @property
    def name(self) -> str:
        """Part of a mode's name."""
        return "all" if self.order == 0 else "sin" if self.angle_rad > 0.0 else "cos"

    def radial(self, angle: Array) -> Array:
        """Factor cos n(θ - θ₀) of the radial and axial displacement."""
        return np.cos(self.order * (angle - self.angle_rad))

    def around(self, angle: Array) -> Array:
        """Factor sin n(θ - θ₀) of the circumferential displacement; 1 for n = 0."""
        return np.sin(self.order * (angle - self.angle_rad)) if self.order else np.ones_like(angle)


@dataclass(frozen=True)
class ShellMode:
    """One natural mode; its amplitude is that of the node that moves most.

    Attributes
    ----------
    name : order around, number among the modes of that order, and orientation: `n2_1_cos`
    around : variation around the axis
    frequency_hz : natural frequency without loss
    modal_mass_kg : kinetic energy is ½ modal mass (velocity amplitude)²
    meridian : nodes
    shape : displacement of each freedom per unit of the amplitude, shape (freedom,)
    """

    name: str
    around: Around
    frequency_hz: float
    modal_mass_kg: float
    meridian: Meridian
    shape: Array

    def velocity(self, points: Array) -> Array:
        """Velocity vectors of surface points per unit of the mode's velocity, shape (point, 3).

        Parameters
        ----------
        points : x, y, z about the centre of mass, shape (point, 3), m; those off the middle
            surface move as its nearest point does
        """
        angle = np.arctan2(points[:, 1], points[:, 0])
        meridian_points = np.stack([np.hypot(points[:, 0], points[:, 1]), points[:, 2]], axis=1)
        element, along = self.meridian.locate(meridian_points)
        powers = along ** np.arange(4)[:, None]
        radial, axial, around = np.einsum("pik,kp->ip", self._cubics[element], powers)
        radial, axial = self.around.radial(angle) * np.stack([radial, axial])
        around *= self.around.around(angle)
        cosine, sine = np.cos(angle), np.sin(angle)
        return np.stack(
            [radial * cosine - around * sine, radial * sine + around * cosine, axial], 1
        )

    @cached_property
    def _cubics(self) -> Array:
        """Displacement along each element, radial, axial and around, (element, 3, power)."""
        count = self.meridian.elements
        element, coordinate = np.repeat(np.arange(count), 4), np.tile(_FOUR_POSITIONS, count)
        weights = displacement_shapes(self.meridian, element, coordinate)
        amplitudes = self.shape[element_dofs(self.meridian)[element]]
        values = np.einsum("pia,pa->pi", weights, amplitudes).reshape(count, 4, 3)
        to_powers = np.linalg.inv(np.vander(_FOUR_POSITIONS, increasing=True))
        return np.asarray(np.einsum("kj,eji->eik", to_powers, values))


@dataclass(frozen=True)
class ElasticShell:
    """The closed shell in air and empty, free in space: its elastic modes up to a frequency.

    Machine, oil and gas inside add mass and stiffness that are not modelled; `span_m` is the only
    stand-in for parts that hold the wall.

    Attributes
    ----------
    structure : thickness, material, loss factor
    meridian : middle surface
    maximum_frequency_hz : modes up to here
    """

    structure: ShellStructure
    meridian: Meridian
    maximum_frequency_hz: float

    @cached_property
    def harmonics(self) -> tuple[Harmonic, ...]:
        """All orders around that can have a mode.

        A free ring as wide as the wall lies below the wall and the caps, each free, with as many
        waves around; joined they only get stiffer.
        """
        order = 2
        while self._ring_frequency_hz(order) <= self.maximum_frequency_hz:
            order += 1
            if order > MAXIMUM_ORDER:
                raise ParameterError(
                    f"maximum_frequency_hz = {self.maximum_frequency_hz:g} Hz: the wall has modes "
                    f"of more than {MAXIMUM_ORDER} waves around; allowed are {MAXIMUM_ORDER}"
                )
        return tuple(Harmonic(self.meridian, self.structure, n) for n in range(order))

    @cached_property
    def by_around(self) -> dict[Around, tuple[IndexArray, Array]]:
        """Numbers and shapes of the modes that vary alike around, shape (mode, freedom)."""
        rows: dict[Around, list[int]] = {}
        for row, mode in enumerate(self.modes):
            rows.setdefault(mode.around, []).append(row)
        return {
            around: (np.array(of), np.array([self.modes[row].shape for row in of]))
            for around, of in rows.items()
        }

    @cached_property
    def modes(self) -> tuple[ShellMode, ...]:
        """Elastic modes by rising frequency; orders above 0 come as pairs, `cos` and `sin`."""
        elastic = [mode for harmonic in self.harmonics for mode in self._of_order(harmonic)]
        return tuple(sorted(elastic, key=lambda mode: mode.frequency_hz))

    def arounds(self, order: int) -> tuple[Around, ...]:
        """Orientations of an order."""
        angles = (0.0, np.pi / (2.0 * order)) if order else (0.0,)
        return tuple(Around(order, angle) for angle in angles)

    def _of_order(self, harmonic: Harmonic) -> list[ShellMode]:
        frequencies, shapes = harmonic.modes(self.maximum_frequency_hz)
        largest = _largest_displacement(self.meridian, shapes)
        return [
            ShellMode(
                f"n{harmonic.order}_{number}_{around.name}",
                around,
                float(frequency),
                float(1.0 / size**2),
                self.meridian,
                shape / size,
            )
            for number, (frequency, size, shape) in enumerate(
                zip(frequencies, largest, shapes.T, strict=True), 1
            )
            for around in self.arounds(harmonic.order)
        ]

    def _ring_frequency_hz(self, order: int) -> float:
        """Bending frequency of a ring in its plane (Rayleigh, Theory of Sound, 1894, § 233)."""
        structure, n = self.structure, order
        speed = np.sqrt(structure.youngs_modulus_pa / structure.density_kg_per_m3)
        factor = n * (n**2 - 1.0) / np.sqrt(n**2 + 1.0)
        gyration = structure.thickness_m / np.sqrt(12.0)
        return float(factor * gyration * speed / (2.0 * np.pi * self.meridian.wall_radius_m**2))


def _largest_displacement(meridian: Meridian, shapes: Array) -> Array:
    """Largest displacement over the nodes, with the sign of its largest part, shape (mode,).

    Of parts that differ by rounding noise the first has the sign: it is that of every processor.
    """
    count, modes = meridian.elements + 1, shapes.shape[1]
    nodes = shapes[: NODE_DOFS * count].reshape(count, NODE_DOFS, modes)[:, :ROTATION]
    in_plane = np.linalg.norm(nodes[:, :CIRCUMFERENTIAL], axis=1)
    size = np.maximum(in_plane, np.abs(nodes[:, CIRCUMFERENTIAL])).max(axis=0)
    parts = nodes.reshape(ROTATION * count, modes)
    sizes = np.abs(parts)
    first = np.argmax(sizes >= (1.0 - _ALIKE) * sizes.max(axis=0), axis=0)
    largest = parts[first, np.arange(modes)]
    return np.asarray(np.sign(largest) * size)


@lru_cache(maxsize=2)
def elastic_shell(
    shell: Shell, structure: ShellStructure, maximum_frequency_hz: float
) -> ElasticShell:
    """The elastic shell of a machine, meshed for a frequency.

    Kept, as radiation and sound ask for the same one, and its modes take seconds.

    Raises
    ------
    ParameterError
        The thickness or the span does not fit into the shell, or the frequency is not above zero.
    """
    if not 0.0 < maximum_frequency_hz < np.inf:
        raise ParameterError(
            f"maximum_frequency_hz = {maximum_frequency_hz:g} Hz: must be above zero"
        )
    meridian = closed_meridian(shell, structure, maximum_frequency_hz)
    return ElasticShell(structure, meridian, maximum_frequency_hz)
