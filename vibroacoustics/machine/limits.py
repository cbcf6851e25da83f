"""Limits that other values set to one: its range is narrowed to them before it is sampled."""

from collections.abc import Callable
from dataclasses import dataclass
from math import inf
from operator import attrgetter
from typing import Any, Final


@dataclass(frozen=True)
class Limit:
    """The part of a value's range that goes with the other values of a machine.

    Attributes
    ----------
    name : dotted, from the machine, in SI
    rule : rule of the machine with the other values: least and greatest that the value may be
    """

    name: str
    rule: Callable[[Any], tuple[float, float]]


def third_inertia(body: str) -> Limit:
    """The moment of inertia about z: no less than what the others differ by, no more than both."""
    read = attrgetter(body)

    def rule(machine: Any) -> tuple[float, float]:
        try:
            rigid = read(machine)
            first, second = rigid.inertia_xx_kg_m2, rigid.inertia_yy_kg_m2
        except AttributeError:  # the table is none
            return -inf, inf
        return abs(first - second), first + second

    return Limit(f"{body}.inertia_zz_kg_m2", rule)


def _tube_bore(machine: Any) -> tuple[float, float]:
    """The discharge tube keeps a wall."""
    tube = getattr(machine.suspension, "discharge_tube", None)
    return -inf, inf if tube is None else THINNEST_TUBE * tube.outer_diameter_m


THINNEST_TUBE: Final = 0.95
"""Inner over outer diameter."""
OF_EVERY_MACHINE: Final = (
    *(third_inertia(body) for body in ("housing", "suspension.block")),
    Limit("suspension.discharge_tube.inner_diameter_m", _tube_bore),
)
