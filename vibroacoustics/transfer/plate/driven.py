"""Power of forces into a plate, and the sound power that leaves it to one side.

Forces are complex peaks; a tone's power is half of force times velocity.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.special import j0

from ...base.arrays import Array, ComplexArray
from ...base.constants import (
    AIR_DENSITY_KG_PER_M3,
    AIR_IMPEDANCE_PA_S_PER_M,
    SPEED_OF_SOUND_M_PER_S,
)

LARGEST = 2.0
"""Largest radiation efficiency (EN 12354-1, B.2)."""


def radiation_efficiency(
    frequency_hz: Array, coincidence_hz: float, size_m: tuple[float, float] | None
) -> Array:
    """Radiation efficiency σ of free bending waves to one side of a plate in a wall.

    Finite: mean over the modes after Maidanik, J. Acoust. Soc. Am. 34 (1962) 809, and Leppington,
    Broadbent and Heron, Proc. R. Soc. A 382 (1982) 245, put together as in EN 12354-1:2000, B.2.
    Without end: 1/√(1 - f_c/f) above coincidence, nothing below it.

    Parameters
    ----------
    frequency_hz : above zero, shape (...)
    coincidence_hz : f_c
    size_m : length and width; none of a plate without end

    Returns
    -------
    shape (...), up to LARGEST
    """
    frequency = np.asarray(frequency_hz, dtype=float)
    above = np.sqrt(1.0 / np.maximum(1.0 - coincidence_hz / frequency, LARGEST**-2))
    if size_m is None:
        return np.where(frequency > coincidence_hz, above, 0.0)
    length, width = size_m
    c, area = SPEED_OF_SOUND_M_PER_S, length * width
    first_hz = c**2 / (4.0 * coincidence_hz) * (1.0 / length**2 + 1.0 / width**2)
    as_piston = 4.0 * area * (frequency / c) ** 2
    as_edge = np.sqrt(2.0 * np.pi * frequency * (length + width) / (16.0 * c))
    if first_hz > coincidence_hz / 2.0:
        below_hz = frequency < coincidence_hz
        least = np.where(below_hz, np.minimum(as_piston, as_edge), np.minimum(above, as_edge))
        return np.asarray(np.minimum(least, LARGEST))
    below = _edges_and_corners(frequency, coincidence_hz, length, width)
    below = np.where(frequency < first_hz, np.minimum(below, as_piston), below)
    return np.asarray(np.minimum(np.where(frequency >= coincidence_hz, above, below), LARGEST))


def _edges_and_corners(
    frequency: Array, coincidence_hz: float, length_m: float, width_m: float
) -> Array:
    """Radiation efficiency below coincidence: strips along the edges and, below half of it,
    corners."""
    c, area = SPEED_OF_SOUND_M_PER_S, length_m * width_m
    ratio = np.clip(np.sqrt(frequency / coincidence_hz), 1e-6, 1.0 - 1e-9)
    complement = 1.0 - ratio**2
    edges = (complement * np.log((1.0 + ratio) / (1.0 - ratio)) + 2.0 * ratio) / (
        4.0 * np.pi**2 * complement**1.5
    )
    corners = 8.0 * c**2 * (1.0 - 2.0 * ratio**2) / (
        coincidence_hz**2 * np.pi**4 * area * ratio * np.sqrt(complement)
    )  # fmt: skip
    corners = np.where(frequency < coincidence_hz / 2.0, corners, 0.0)
    return np.asarray(2.0 * (length_m + width_m) / area * c / coincidence_hz * edges + corners)


_SIDES: Final = 2.0
"""Sides with air in front of them, which takes energy and loads the plate."""
_NODES: Final = 48
"""Nodes of the rule over directions."""


@dataclass(frozen=True)
class Plate:
    """A thin plate.

    Attributes
    ----------
    mass_kg_per_m2, bending_stiffness_n_m, loss_factor_ratio : m, B, η
    size_m : length and width; none without end
    """

    mass_kg_per_m2: float
    bending_stiffness_n_m: float
    loss_factor_ratio: float
    size_m: tuple[float, float] | None = None

    @property
    def coincidence_hz(self) -> float:
        """f_c = c²/(2π) √(m/B)."""
        ratio = self.mass_kg_per_m2 / self.bending_stiffness_n_m
        return float(SPEED_OF_SOUND_M_PER_S**2 / (2.0 * np.pi) * np.sqrt(ratio))

    def wavenumber(self, frequency_hz: Array) -> Array:
        """Wavenumber of free bending waves, k⁴ = ω² m/B, rad/m."""
        omega = 2.0 * np.pi * np.asarray(frequency_hz, dtype=float)
        ratio = self.mass_kg_per_m2 / self.bending_stiffness_n_m
        return np.asarray((omega**2 * ratio) ** 0.25)

    def total_loss_ratio(self, frequency_hz: Array) -> Array:
        """Loss factor of free bending waves with what both sides radiate: η + 2 ρ c σ/(ω m)."""
        efficiency = radiation_efficiency(frequency_hz, self.coincidence_hz, self.size_m)
        inertia = 2.0 * np.pi * frequency_hz * self.mass_kg_per_m2
        return np.asarray(
            self.loss_factor_ratio + _SIDES * AIR_IMPEDANCE_PA_S_PER_M * efficiency / inertia
        )


def input_power(force: ComplexArray, mobility: Array, likeness: Array) -> Array:
    """Power ½ Σ Re{F_i F_j*} √(Re Y_i Re Y_j) C_ij of forces on a structure, shape (...), W.

    Parameters
    ----------
    force : complex peaks, shape (..., foot), N
    mobility : real part at each foot, shape (..., foot), m/(N s)
    likeness : C, real part of the mobility between two feet over that at one, shape
        (..., foot, foot); the identity where nothing is known of it
    """
    scaled = force * np.sqrt(np.maximum(mobility, 0.0))
    each = np.einsum("...i,...ij,...j->...", scaled, likeness, scaled.conj()).real
    return np.asarray(0.5 * np.maximum(each, 0.0))


def likeness(plate: Plate, frequency_hz: Array, position_m: Array) -> Array:
    """J0(k r) between feet, shape (frequency, foot, foot).

    With the transfer mobility Y (H0(kr) - H0(-jkr)) of a plate without end, J0 alone is real
    (Cremer, Heckl, Petersson, Structure-Borne Sound, 2005, chapter on point-excited plates).

    Parameters
    ----------
    plate : under the feet
    frequency_hz : shape (frequency,)
    position_m : position of the feet, shape (foot, 2 or 3)
    """
    return np.asarray(j0(plate.wavenumber(frequency_hz)[:, None, None] * _distances(position_m)))


def near_power(plate: Plate, frequency_hz: Array, force: ComplexArray, position_m: Array) -> Array:
    """Sound power to one side of the near field around forces, below coincidence, W.

    One force at low frequencies gives ρ F²/(2π c m²), F root mean square; air on both sides takes
    1 - 2μ arctan(1/2μ) of it, μ = ρ c/(ω m). Toward coincidence bending stiffness helps. In general

        W = ρ/(2π c m²) ½ Σ F_i F_j* ∫ u² J0(k r √(1-u²)) / |u b(u) - 2jμ|² du, u from 0 to 1,

    b = 1 - (f/f_c)² (1-u²)²: the pressure of the plate without end towards cos θ = u (Junger and
    Feit, Sound, Structures, and Their Interaction, 2nd ed. 1986, chapter 8).

    Parameters
    ----------
    plate : without end, as far as the near field goes
    frequency_hz : above zero, shape (frequency,)
    force : complex peaks, shape (frequency, foot), N
    position_m : position of the feet, shape (foot, 2 or 3)
    """
    u, weight = _rule()
    omega = 2.0 * np.pi * frequency_hz
    load = _SIDES * AIR_IMPEDANCE_PA_S_PER_M / (omega * plate.mass_kg_per_m2)
    ratio = (frequency_hz / plate.coincidence_hz)[:, None]
    stiff = u * (1.0 - ratio**2 * (1.0 - u**2) ** 2)
    pattern = weight * u**2 / (stiff**2 + load[:, None] ** 2)
    phase = (omega / SPEED_OF_SOUND_M_PER_S)[:, None] * np.sqrt(1.0 - u**2)
    together = j0(phase[:, :, None, None] * _distances(position_m))
    each = np.einsum("fi,fj,fu,fuij->f", force, force.conj(), pattern, together, optimize=True)
    scale = AIR_DENSITY_KG_PER_M3 / (2.0 * np.pi * SPEED_OF_SOUND_M_PER_S * plate.mass_kg_per_m2**2)
    below = frequency_hz < plate.coincidence_hz
    return np.asarray(0.5 * scale * np.maximum(each.real, 0.0) * below)


def wave_power(plate: Plate, frequency_hz: Array, power_w: Array) -> Array:
    """Sound power to one side of the free bending waves that a power feeds, W.

    P ρ c σ/(ω m η + 2 ρ c σ): what is put in leaves by loss in the plate and by both its sides
    (Cremer, Heckl, Petersson, Structure-Borne Sound, 2005, chapter on radiation).

    Parameters
    ----------
    plate : with its loss factor
    frequency_hz : above zero, shape (frequency,)
    power_w : into the plate, shape (..., frequency)
    """
    loss = plate.total_loss_ratio(frequency_hz)
    to_one_side = (loss - plate.loss_factor_ratio) / _SIDES
    return np.asarray(power_w * to_one_side / loss)


def _distances(position_m: Array) -> Array:
    """Distances between feet in the plane of the plate, shape (foot, foot), m."""
    plane = np.asarray(position_m)[:, :2]
    return np.asarray(np.linalg.norm(plane[:, None] - plane, axis=-1))


def _rule() -> tuple[Array, Array]:
    """Gauss points from 0 to 1, crowded at 0 where air loads most: u = s²."""
    node, weight = np.polynomial.legendre.leggauss(_NODES)
    s = 0.5 * (node + 1.0)
    return s**2, weight * s
