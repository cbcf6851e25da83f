"""The thesis's program for the gas force (Appendix A), as printed, with its faults."""

from itertools import pairwise
from typing import Final

import numpy as np

from vibroacoustics.base.arrays import Array, ComplexArray, IndexArray

BASE_RADIUS_M: Final = 0.00215
"""R."""
ADIABATIC_COEFFICIENT: Final = 1.1558
"""kappa."""
LARGEST_AREA_M2: Final = 0.0016291
"""Smax."""
STANDSTILL_PRESSURE_BAR: Final = 15.0
"""Po."""
LARGEST_PRESSURE_BAR: Final = 41.159
"""Pmax."""
CONTACT_TOLERANCE_M: Final = 1e-6
"""Largest distance of two points that touch, in x and in y."""
HALF_TURN: Final = 180
"""Points of the spiral per half turn."""


def appendix_a_force() -> tuple[Array, Array]:
    """Gas force on the fixed scroll per metre of height as Appendix A computes it, bar m.

    It comes out as 5.31 to 5.93 bar m, 16 to 18 kN with the wrap's height of 3 cm, five to six
    times too large; section 6.1 reads it as 10⁻² N. The right force is that of `scroll_gas_cycle`.
    Faults, by the names of the program:

    1. `l1`, √|Δ(x² + y²)|, is no arc length: its sum grows without bound as the step of t shrinks.
    2. A unit normal times a length stands for the force; it is the pressure step times the chord.
    3. `n1x`, `n1y` lack the bracket of R(cos t - cos t + t sin t), so metres are added to radians.
    4. `S` joins points half a turn apart, aslant to the pocket: areas come out 26 % too large.
    5. The wraps have no thickness (`pi*R` is the orbit radius), which doubles the displacement.
    6. No pocket opens to the discharge; the innermost has `Pmax`, the others a free polytrope.

    Returns
    -------
    crank_angle, force : `alpha`, shape (46,), rad; `Fxx`, `Fyy`, shape (2, 46)
    """
    crank_angle = np.radians(np.arange(0.0, 361.0, 8.0))
    fixed = _spiral()
    forces = []
    for angle in crank_angle:
        orbiting = -fixed + np.pi * BASE_RADIUS_M * np.exp(1j * angle)
        at_fixed, at_orbiting = _contacts(fixed, orbiting)
        pressures = _pressures_bar(fixed, orbiting, at_fixed, at_orbiting)
        segments = pairwise(at_fixed)
        lengths = np.array([_length_m(fixed, *s) * _unit_normal(*s) for s in segments])
        forces.append(-np.diff(pressures) @ lengths)
    return crank_angle, np.array([np.real(forces), np.imag(forces)])


def _tangential_angle() -> Array:
    """t: from 60° to 1080° in steps of 1°."""
    return np.asarray(np.radians(np.arange(60.0, 1081.0)))


def _spiral() -> ComplexArray:
    """x1 + j y1."""
    t = _tangential_angle()
    return np.asarray(BASE_RADIUS_M * (np.exp(-1j * t) * (1.0 + 1j * t)))


def _contacts(fixed: ComplexArray, orbiting: ComplexArray) -> tuple[IndexArray, IndexArray]:
    """V: indices of the points that touch, ordered along the fixed spiral."""
    apart = fixed[:, None] - orbiting[None, :]
    close = np.maximum(np.abs(apart.real), np.abs(apart.imag)) <= CONTACT_TOLERANCE_M
    at_fixed, at_orbiting = np.nonzero(close)
    return at_fixed, at_orbiting


def _pressures_bar(
    fixed: ComplexArray, orbiting: ComplexArray, at_fixed: IndexArray, at_orbiting: IndexArray
) -> Array:
    """Pmax, P of each gap from its area, Po: one more than there are segments."""
    shifts = HALF_TURN * np.sign(at_orbiting - at_fixed)
    gaps = zip(at_fixed[:-2], at_fixed[2:], shifts[:-2], strict=True)
    areas = np.array([_area_m2(fixed, orbiting, *gap) for gap in gaps])
    pressures_bar = STANDSTILL_PRESSURE_BAR * (LARGEST_AREA_M2 / areas) ** ADIABATIC_COEFFICIENT
    return np.array([LARGEST_PRESSURE_BAR, *pressures_bar, STANDSTILL_PRESSURE_BAR])


def _area_m2(
    fixed: ComplexArray, orbiting: ComplexArray, first: int, last: int, shift: int
) -> float:
    """S: widths of a gap times the steps of the middle between its two sides."""
    at = np.arange(first, last + 1)
    width = np.abs(fixed[at] - orbiting[at + shift])
    step = np.abs(np.diff(fixed[at] + orbiting[at + shift])) / 2.0
    return float(np.sum((step * width[1:])[1:]))  # the first step is left out, as printed


def _length_m(fixed: ComplexArray, first: int, last: int) -> float:
    """L1: sum of l1 over both ends of a segment."""
    square = np.abs(fixed[first : last + 2]) ** 2
    return float(np.sum(np.sqrt(np.abs(np.diff(square)))))


def _unit_normal(first: int, last: int) -> complex:
    """N1x + j N1y: direction of the sum of n1x, n1y over both ends of a segment."""
    t, R = _tangential_angle()[first : last + 1], BASE_RADIUS_M
    x = R * np.cos(t) - np.cos(t) + t * np.sin(t)
    y = -R * np.sin(t) + np.sin(t) + t * np.cos(t)
    total = complex(np.sum(x), np.sum(y))
    return total / abs(total)
