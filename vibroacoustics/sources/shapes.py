"""Shapes of what a plug-in's machine, option or source gives, before the chain adds them up."""

from collections.abc import Iterable, Mapping
from math import isfinite
from typing import Final

from ..base.arrays import Array, ComplexArray
from ..mechanics.added import Added
from ..mechanics.loads import Loads
from ..mechanics.moving_parts import Revolution, Wrench

_ADDED_MASS: Final = "added_mass_kg"


def check_revolution(revolution: Revolution, samples: int) -> None:
    """Refuse a revolution whose courses are not over the crank angles.

    Raises
    ------
    ValueError
        Names the course.
    """
    _check_course("rotation", revolution.rotation.speed_rad_per_s, (samples,))
    _check_wrenches(revolution.wrenches, samples)


def check_added(added: Added, samples: int) -> None:
    """Refuse what has no added mass, or a path that is not over the crank angles.

    Raises
    ------
    ValueError
        Names the figure or the part.
    """
    if not isfinite(added.figures.get(_ADDED_MASS, float("nan"))):
        raise ValueError(f"figures: need a finite {_ADDED_MASS}")
    for part in added.parts:
        _check_course(part.source, part.position_m, (3, samples))


def check_loads(loads: Loads, samples: int) -> None:
    """Refuse wrenches not over the crank angles, and lines not of a port's components.

    Raises
    ------
    ValueError
        Names the wrench or the port.
    """
    _check_wrenches(loads.wrenches, samples)
    for port, spectrum in loads.lines.items():
        if spectrum.ndim != 2 or len(spectrum) != len(port.components):
            raise ValueError(
                f"{port.name}: shape {spectrum.shape}, must be ({len(port.components)}, order)"
            )


def _check_wrenches(wrenches: Mapping[str, Wrench], samples: int) -> None:
    for name, wrench in wrenches.items():
        for course in wrench:
            _check_course(name, course, (3, samples))


def _check_course(name: str, course: Array | ComplexArray, shape: Iterable[int]) -> None:
    if course.shape != tuple(shape):
        raise ValueError(f"{name}: shape {course.shape}, must be {tuple(shape)}")
