"""What waves of magnetic stress do to the parts in the shell, frequency by frequency."""

from collections import defaultdict
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ...base.arrays import ComplexArray
from ...machine.stator_yoke import StatorYoke
from ...mechanics.loads import (
    BEARING_HOUSING,
    LOWER_BEARING,
    PART_COMPONENTS,
    PARTS,
    STATOR,
    YOKE_ORDERS,
)
from ...mechanics.scroll_shaft import ScrollShaft
from .waves import Wave

NO_STRESS = 1e-6
"""Of the largest wave: smaller ones are left out."""


@dataclass(frozen=True)
class StressLoads:
    """Loads by waves of one frequency, complex peaks.

    Attributes
    ----------
    on_parts : net forces, shape (part, component), N and N m
    on_yoke : shape (order around, 2), N/m
    """

    on_parts: ComplexArray
    on_yoke: ComplexArray


def loads_of_stress(
    stress_pa: Mapping[Wave, complex],
    yoke: StatorYoke,
    shaft: ScrollShaft,
    height_m: float,
) -> dict[tuple[int, int], StressLoads]:
    """Loads by line and shaft multiples of the frequency.

    One wave around is a net force on the stator, and the opposite one on the rotor, whose shaft
    hands it on to its two bearings like a stiff beam. More waves press the yoke, as a line load of
    stress times length, per angle the same at bore and middle.

    Parameters
    ----------
    stress_pa : complex peaks by wave
    yoke : bore, length
    shaft : bearings and rotor
    height_m : of the middle of the stack, at which the rotor is pulled too
    """
    largest = max(map(abs, stress_pa.values()), default=0.0)
    pulled = _pull(shaft, height_m)
    across = np.pi * yoke.bore_radius_m * yoke.length_m
    per_stress = yoke.length_m * yoke.bore_radius_m / yoke.mean_radius_m
    loads: defaultdict[tuple[int, int], StressLoads] = defaultdict(_none)
    for (around, line, shaft_turns), stress in stress_pa.items():
        if abs(stress) < NO_STRESS * largest:
            continue
        at = line, shaft_turns
        parts = np.array([1.0, -1j * np.sign(around)])  # with cos nθ and with sin nθ
        if abs(around) == 1:
            loads[at].on_parts[:] += across * stress * (pulled @ parts)
        elif abs(around) in YOKE_ORDERS:
            loads[at].on_yoke[YOKE_ORDERS.index(abs(around))] -= per_stress * stress * parts
    return dict(loads)


def _none() -> StressLoads:
    return StressLoads(
        np.zeros((len(PARTS), PART_COMPONENTS), dtype=complex),
        np.zeros((len(YOKE_ORDERS), 2), dtype=complex),
    )


def _pull(shaft: ScrollShaft, height_m: float) -> ComplexArray:
    """On the parts per force on the rotor along x and y, shape (part, component, 2)."""
    share = shaft.rotor_height_m / shaft.main_bearing_height_m
    lower_m = height_m - shaft.rotor_height_m
    loads = np.zeros((len(PARTS), PART_COMPONENTS, 2), dtype=complex)
    for part, force, height in (
        (STATOR, -1.0, height_m),
        (BEARING_HOUSING, share, lower_m + shaft.main_bearing_height_m),
        (LOWER_BEARING, 1.0 - share, lower_m),
    ):
        loads[part, 0, 0] = loads[part, 1, 1] = force
        loads[part, 4, 0], loads[part, 3, 1] = height * force, -height * force
    return loads
