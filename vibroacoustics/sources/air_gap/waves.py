"""Waves of flux density and stress around an air gap, multiplied exactly.

A field is Re Σ c e^{j(l ω t + s Ω t - n θ)} with ω of the line and Ω of the shaft, kept as complex
Fourier coefficients of both signs by (n, l, s).
"""

import cmath
from collections import defaultdict
from collections.abc import Mapping
from functools import reduce
from typing import Final, NamedTuple

import numpy as np

from ...base.arrays import Array, ComplexArray
from ...machine.frame import BEARING_HOUSING, LOWER_BEARING, STATOR
from ...machine.stator_yoke import STATOR_YOKE, YOKE_ORDERS, StatorYoke
from ...mechanics.ports import WRENCH, Port
from ...mechanics.scroll_shaft import ScrollShaft
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


def product(first: Waves, other: Waves) -> dict[Wave, complex]:
    """Product of two fields."""
    total: defaultdict[Wave, complex] = defaultdict(complex)
    for (n, line, shaft), value in first.items():
        for (m, other_line, other_shaft), factor in other.items():
            total[Wave(n + m, line + other_line, shaft + other_shaft)] += value * factor
    return dict(total)


def permeance(gap: AirGap, stator_slots: int, rotor_slots: int | None) -> dict[Wave, complex]:
    """Permeance of the gap over its mean: slots of stator and rotor, static and dynamic
    eccentricity.

    First order of each, multiplied (Gieras, Wang & Lai, Noise of Polyphase Electric Motors, 2006,
    chapter 2). The middle of a slot stands at angle zero.

    Parameters
    ----------
    gap : sizes of the waves
    stator_slots, rotor_slots : their numbers; none for a rotor without
    """
    unity = {Wave(0, 0, 0): 1.0 + 0j}
    stator = unity | cosine(Wave(stator_slots, 0, 0), -gap.stator_slot_ratio + 0j)
    static = cosine(Wave(1, 0, 0), _turned(gap.static_eccentricity_ratio, gap.static_angle_rad))
    dynamic = cosine(Wave(1, 0, 1), _turned(gap.dynamic_eccentricity_ratio, gap.dynamic_angle_rad))
    factors = [stator, unity | static | dynamic]
    if rotor_slots is not None:
        rotor = cosine(Wave(rotor_slots, 0, rotor_slots), -gap.rotor_slot_ratio + 0j)
        factors.append(unity | rotor)
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


NO_STRESS = 1e-6
"""Share of the largest wave: smaller ones are neglected."""


PORTS = (BEARING_HOUSING, LOWER_BEARING, STATOR, STATOR_YOKE)
"""Ports that waves of magnetic stress load."""


def loads_of_stress(
    stress_pa: Mapping[Wave, complex],
    yoke: StatorYoke,
    shaft: ScrollShaft,
    height_m: float,
) -> dict[tuple[int, int], dict[Port, ComplexArray]]:
    """Loads by port, complex peaks, by line and shaft multiples of the frequency.

    One wave around is a net force on the stator, and the opposite one on the rotor, whose shaft
    hands it on to its two bearings like a stiff beam. More waves press the yoke, as a line load of
    stress times length, per angle the same at bore and middle.

    Parameters
    ----------
    stress_pa : complex peaks by wave
    yoke : bore, length
    shaft : bearings and rotor
    height_m : mid-height of the stack, at which the rotor is pulled too
    """
    largest = max(map(abs, stress_pa.values()), default=0.0)
    pulled = _pull(shaft, height_m)
    across = np.pi * yoke.bore_radius_m * yoke.length_m
    per_stress = yoke.length_m * yoke.bore_radius_m / yoke.mean_radius_m
    loads: defaultdict[tuple[int, int], dict[Port, ComplexArray]] = defaultdict(_none)
    for (around, line, shaft_turns), stress in stress_pa.items():
        if abs(stress) < NO_STRESS * largest:
            continue
        key = line, shaft_turns
        parts = np.array([1.0, -1j * np.sign(around)])  # with cos nθ and with sin nθ
        if abs(around) == 1:
            for port, per_force in pulled.items():
                loads[key][port] += across * stress * (per_force @ parts)
        elif abs(around) in YOKE_ORDERS:
            first = 2 * YOKE_ORDERS.index(abs(around))
            loads[key][STATOR_YOKE][first : first + 2] -= per_stress * stress * parts
    return dict(loads)


def _none() -> dict[Port, ComplexArray]:
    return {port: np.zeros(len(port.components), dtype=complex) for port in PORTS}


def _pull(shaft: ScrollShaft, height_m: float) -> dict[Port, Array]:
    """Pull on the parts per force on the rotor along x and y, shape (component, 2)."""
    share = shaft.rotor_height_m / shaft.main_bearing_height_m
    lower_m = height_m - shaft.rotor_height_m
    loads: dict[Port, Array] = {}
    for part, force, height in (
        (STATOR, -1.0, height_m),
        (BEARING_HOUSING, share, lower_m + shaft.main_bearing_height_m),
        (LOWER_BEARING, 1.0 - share, lower_m),
    ):
        loads[part] = np.zeros((len(WRENCH), 2))
        loads[part][0, 0] = loads[part][1, 1] = force
        loads[part][4, 0], loads[part][3, 1] = height * force, -height * force
    return loads
