"""Wall impedances: passive branches that absorb what is asked for; absorption of surfaces."""

import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache, lru_cache
from typing import Final

import numpy as np
import xarray as xr

from ...base.vocabulary import stamped
from ..arrays import Array, ComplexArray
from .room import HARD, MOST_ABSORPTION, OCTAVES_HZ, SIDES, WAVE_OCTAVES, Material, Room

QUALITY: Final = 0.6
"""Quality to which each branch is pulled (assumed): that of branches that overlap by an octave."""
_PULL_QUALITY: Final = 0.005
_PULL_WEIGHT: Final = 0.001
"""Errors of the fit for a weight or quality e times where it starts; an absorption of 0.05 that is
missed by 0.01 counts 0.03."""
_MOST_TRIALS: Final = 100


@dataclass(frozen=True)
class Branches:
    """Parallel branches of impedance j omega L + R + K/(j omega), in units of rho c, (branch,).

    S. Bilbao, B. Hamilton, J. Botts, L. Savioja, "Finite volume time domain room acoustics
    simulation under general impedance boundary conditions", IEEE/ACM Trans. Audio Speech Lang.
    Process. 24 (2016), equation 12. Passive, as no part is negative.
    """

    mass: Array
    """s."""
    resistance: Array
    spring: Array
    """1/s."""

    def admittance(self, frequency_hz: Array) -> ComplexArray:
        """rho c u/p of the wall, (frequency,)."""
        return np.asarray((1.0 / self._impedances(frequency_hz).sum(axis=1)).sum(axis=1))

    def slopes(self, frequency_hz: Array) -> ComplexArray:
        """Change of the admittance with the logarithm of each part, (frequency, part, branch)."""
        parts = self._impedances(frequency_hz)
        return np.asarray(-parts / parts.sum(axis=1, keepdims=True) ** 2)

    def _impedances(self, frequency_hz: Array) -> ComplexArray:
        """Impedances of mass, resistance and spring, (frequency, part, branch)."""
        s = 2j * np.pi * np.asarray(frequency_hz, dtype=float)[:, None]
        parts: ComplexArray = np.stack(
            np.broadcast_arrays(s * self.mass, self.resistance, self.spring / s), axis=1
        )
        return parts


def absorption_at_angle(admittance: ComplexArray | Array, cosine: Array) -> Array:
    """Absorbed share of a plane wave, 4 Re(Y) cos / |cos + Y|² for an admittance Y of rho c.

    H. Kuttruff, Room Acoustics, 6th edition (2016), equation 2.29, of the impedance 1/Y.
    """
    return np.asarray(4.0 * np.real(admittance) * cosine / np.abs(cosine + admittance) ** 2)


def random_absorption(admittance: ComplexArray | Array) -> Array:
    """Absorbed share at random incidence, the integral of alpha sin(2 theta) over the angle.

    Kuttruff (2016), equation 2.52 (Paris); Gauss-Legendre quadrature over cos(theta).
    """
    node, weight = _quadrature()
    cosine = (node + 1.0) / 2.0
    share = absorption_at_angle(admittance[..., None], cosine)
    return np.asarray((cosine * weight * share).sum(axis=-1))


def random_absorption_slopes(admittance: ComplexArray) -> tuple[Array, Array]:
    """Return the changes of `random_absorption` with the admittance's real and imaginary part.

    Parameters
    ----------
    admittance : admittance times rho c, shape (frequency,)
    """
    node, weight = _quadrature()
    cosine = (node + 1.0) / 2.0
    real, imaginary = admittance.real[:, None], admittance.imag[:, None]
    squared = np.abs(cosine + admittance[:, None]) ** 2
    weight = 4.0 * weight * cosine**2 / squared**2
    of_real = weight * (squared - 2.0 * real * (cosine + real))
    of_imaginary = -2.0 * weight * real * imaginary
    return of_real.sum(axis=-1), of_imaginary.sum(axis=-1)


@cache
def _quadrature() -> tuple[Array, Array]:
    return np.polynomial.legendre.leggauss(64)


def octave_branches(weights: Array, quality: Array) -> Branches:
    """Return one branch at each octave's middle frequency.

    Parameters
    ----------
    weights : admittance of each branch there, shape (octave,)
    quality : resonance frequency over bandwidth of each branch, shape (octave,)
    """
    omega = 2.0 * np.pi * np.array(OCTAVES_HZ[: weights.size])
    resistance = 1.0 / weights
    return Branches(quality * resistance / omega, resistance, quality * resistance * omega)


@lru_cache
def fitted_branches(material: Material) -> Branches:
    """Fit a material's branches to its absorption at the octaves that waves see.

    Least squares over the logarithms of weight and quality of each branch, both pulled weakly to
    where they start: the absorption alone leaves them open.
    """
    from scipy.optimize import least_squares

    octaves = np.array(OCTAVES_HZ[:WAVE_OCTAVES])
    requested = np.minimum(material.absorption[:WAVE_OCTAVES], MOST_ABSORPTION)
    scale = 1.0 / np.sqrt(0.05 + requested)
    start = np.log([np.maximum(requested, 1e-3) / 8.0, np.full(WAVE_OCTAVES, QUALITY)])
    pull = np.repeat([_PULL_WEIGHT, _PULL_QUALITY], WAVE_OCTAVES)

    def error(logarithms: Array) -> Array:
        branches = octave_branches(*np.exp(logarithms.reshape(start.shape)))
        difference = random_absorption(branches.admittance(octaves)) - requested
        return np.concatenate([scale * difference, pull * (logarithms - start.ravel())])

    def slopes(logarithms: Array) -> Array:
        branches = octave_branches(*np.exp(logarithms.reshape(start.shape)))
        of_parts = branches.slopes(octaves)
        # The weight divides all three parts; the quality multiplies mass and spring.
        of_logarithms = np.hstack([-of_parts.sum(axis=1), of_parts[:, 0] + of_parts[:, 2]])
        conductance, susceptance = random_absorption_slopes(branches.admittance(octaves))
        of_absorption = (
            conductance[:, None] * of_logarithms.real + susceptance[:, None] * of_logarithms.imag
        )
        return np.concatenate([scale[:, None] * of_absorption, np.diag(pull)])

    fit = least_squares(error, start.ravel(), slopes, method="lm", max_nfev=_MOST_TRIALS)
    return octave_branches(*np.exp(fit.x.reshape(start.shape)))


def fitted_absorption(material: Material) -> Array:
    """Return the random-incidence absorption that waves see, by octave from 63 Hz to 1 kHz."""
    octaves = np.array(OCTAVES_HZ[:WAVE_OCTAVES])
    return random_absorption(fitted_branches(material).admittance(octaves))


MOST_DIFFERENCE: Final = 0.03
"""Largest difference from the requested absorption without a warning."""


class AbsorptionWarning(UserWarning):
    """Waves meet a surface of another absorption than the requested one."""


def wall_absorption(room: Room, highest_hz: float) -> xr.Dataset:
    """Return requested and computed absorption of every surface, by octave.

    Returns
    -------
    `room_wall_absorption` and `room_wall_absorption_requested` (room_surface, room_octave); the
    former is not a number in octaves above the waves
    """
    surfaces = dict(_surfaces(room))
    coords = {"room_surface": list(surfaces), "room_octave": list(OCTAVES_HZ)}
    values = {
        "room_wall_absorption": [computed(surface, highest_hz) for surface in surfaces.values()],
        "room_wall_absorption_requested": [surface.absorption for surface in surfaces.values()],
    }
    return stamped(values, coords)


def computed(material: Material, highest_hz: float) -> Array:
    """Return the absorption of a material in the waves, by octave; not a number above them."""
    absorption = np.full(len(OCTAVES_HZ), np.nan)
    absorption[:WAVE_OCTAVES] = 0.0 if material.hard else fitted_absorption(material)
    return np.where(np.array(OCTAVES_HZ) <= highest_hz, absorption, np.nan)


def warn_of_absorption(room: Room, highest_hz: float) -> None:
    """Warn of surfaces whose computed absorption differs from the requested one."""
    surfaces: dict[Material, list[str]] = {}
    for name, material in _surfaces(room):
        surfaces.setdefault(material, []).append(f"room.{name}")
    for material, names in surfaces.items():
        absorption = computed(material, highest_hz)
        octaves = [
            f"{value:.2f} instead of {requested:g} at {octave:g} Hz"
            for octave, value, requested in zip(
                OCTAVES_HZ, absorption, material.absorption, strict=True
            )
            if abs(value - requested) > MOST_DIFFERENCE
        ]
        if octaves:
            most = f"; a locally reacting wall absorbs at most {MOST_ABSORPTION:g}"
            clipped = most if material.clipped_octaves_hz else ""
            warnings.warn(
                f"{', '.join(names)}: absorption of waves is {', '.join(octaves)}{clipped}",
                AbsorptionWarning,
                stacklevel=3,
            )


def _surfaces(room: Room) -> Iterator[tuple[str, Material]]:
    """Surfaces by their key below `room` in a study."""
    yield from ((f"walls.{side}", room.walls.get(side, HARD)) for side in SIDES)
    yield from ((f"furniture.{block.name}", block.material) for block in room.blocks)
    yield from ((f"patches.{patch.name}", patch.material) for patch in room.patches)
