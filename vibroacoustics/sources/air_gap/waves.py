"""Waves of flux density and stress around an air gap, multiplied exactly.

A field is Re Σ c e^{j(l ω t + s Ω t - n θ)} with ω of the line and Ω of the shaft, kept as complex
Fourier coefficients of both signs by (n, l, s).
"""

import cmath
from collections import defaultdict
from collections.abc import Mapping
from functools import reduce
from typing import Final, NamedTuple

from .parameters import AirGap

MU_0: Final = 1.25663706e-6
"""Permeability of air, H/m."""


class Wave(NamedTuple):
    """Waves around the circumference, multiples of the line's and of the shaft's frequency."""

    around: int
    line: int
    shaft: int


Waves = Mapping[Wave, complex]


def cosine(wave: Wave, amplitude: complex) -> dict[Wave, complex]:
    """Re A e^{j(l ω t + s Ω t - n θ)}."""
    against = Wave(-wave.around, -wave.line, -wave.shaft)
    return {wave: 0.5 * amplitude, against: 0.5 * amplitude.conjugate()}


def product(one: Waves, other: Waves) -> dict[Wave, complex]:
    """Product of two fields."""
    total: defaultdict[Wave, complex] = defaultdict(complex)
    for (n, line, shaft), value in one.items():
        for (m, other_line, other_shaft), factor in other.items():
            total[Wave(n + m, line + other_line, shaft + other_shaft)] += value * factor
    return dict(total)


def permeance(gap: AirGap, stator_slots: int, rotor_slots: int | None) -> dict[Wave, complex]:
    """Of the gap over its mean: slots of stator and rotor, static and dynamic eccentricity.

    First order of each, multiplied (Gieras, Wang & Lai, Noise of Polyphase Electric Motors, 2006,
    chapter 2). The middle of a slot stands at angle zero.

    Parameters
    ----------
    gap : sizes of the waves
    stator_slots, rotor_slots : their numbers; none for a rotor without
    """
    one = {Wave(0, 0, 0): 1.0 + 0j}
    stator = one | cosine(Wave(stator_slots, 0, 0), -gap.stator_slot_ratio + 0j)
    static = cosine(Wave(1, 0, 0), _turned(gap.static_eccentricity_ratio, gap.static_angle_rad))
    dynamic = cosine(Wave(1, 0, 1), _turned(gap.dynamic_eccentricity_ratio, gap.dynamic_angle_rad))
    factors = [stator, one | static | dynamic]
    if rotor_slots is not None:
        rotor = cosine(Wave(rotor_slots, 0, rotor_slots), -gap.rotor_slot_ratio + 0j)
        factors.append(one | rotor)
    return reduce(product, factors)


def _turned(ratio: float, angle: float) -> complex:
    """Amplitude of a wave of one period whose crest stands at an angle."""
    return ratio * cmath.exp(1j * angle)


def stress_pa(flux_t: Waves) -> dict[Wave, complex]:
    """Maxwell's stress B²/(2 μ0) that pulls the stator inwards, complex peaks by wave, Pa.

    Only waves with a frequency: of each pair of coefficients one is kept, with l above zero, or l
    zero and s above.

    Parameters
    ----------
    flux_t : radial flux density, coefficients
    """
    return {
        wave: 2.0 * value / (2.0 * MU_0)
        for wave, value in product(flux_t, flux_t).items()
        if (wave.line, wave.shaft) > (0, 0)
    }
