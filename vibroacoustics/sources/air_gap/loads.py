"""What waves of magnetic stress do to the parts in the shell, frequency by frequency."""

from collections import defaultdict
from collections.abc import Mapping

import numpy as np

from ...base.arrays import Array, ComplexArray
from ...machine.frame import BEARING_HOUSING, LOWER_BEARING, STATOR
from ...machine.stator_yoke import STATOR_YOKE, YOKE_ORDERS, StatorYoke
from ...mechanics.ports import WRENCH, Port
from ...mechanics.scroll_shaft import ScrollShaft
from .waves import Wave

NO_STRESS = 1e-6
"""Of the largest wave: smaller ones are left out."""


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
    height_m : of the middle of the stack, at which the rotor is pulled too
    """
    largest = max(map(abs, stress_pa.values()), default=0.0)
    pulled = _pull(shaft, height_m)
    across = np.pi * yoke.bore_radius_m * yoke.length_m
    per_stress = yoke.length_m * yoke.bore_radius_m / yoke.mean_radius_m
    loads: defaultdict[tuple[int, int], dict[Port, ComplexArray]] = defaultdict(_none)
    for (around, line, shaft_turns), stress in stress_pa.items():
        if abs(stress) < NO_STRESS * largest:
            continue
        at = line, shaft_turns
        parts = np.array([1.0, -1j * np.sign(around)])  # with cos nθ and with sin nθ
        if abs(around) == 1:
            for port, per_force in pulled.items():
                loads[at][port] += across * stress * (per_force @ parts)
        elif abs(around) in YOKE_ORDERS:
            first = 2 * YOKE_ORDERS.index(abs(around))
            loads[at][STATOR_YOKE][first : first + 2] -= per_stress * stress * parts
    return dict(loads)


def _none() -> dict[Port, ComplexArray]:
    return {port: np.zeros(len(port.components), dtype=complex) for port in PORTS}


def _pull(shaft: ScrollShaft, height_m: float) -> dict[Port, Array]:
    """On the parts per force on the rotor along x and y, shape (component, 2)."""
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
