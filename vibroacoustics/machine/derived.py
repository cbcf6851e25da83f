"""Values of a machine that follow from others: they go with them when those are sampled."""

from collections.abc import Callable
from dataclasses import dataclass
from operator import attrgetter
from typing import Any, Final


@dataclass(frozen=True)
class Derived:
    """A value that stays in proportion to what others make.

    The proportion is that of the nominal values: with these, the value is its nominal one.

    Attributes
    ----------
    name : dotted, from the machine, in SI
    sources : dotted names of the values that it follows from
    rule : rule of the machine: what the value is in proportion to; none where it does not follow
    """

    name: str
    sources: tuple[str, ...]
    rule: Callable[[Any], float | None]


def in_proportion(name: str, source: str) -> Derived:
    """A value in proportion to another; it is independent where the machine has not both tables."""
    read = attrgetter(source)

    def rule(machine: Any) -> float | None:
        try:
            return float(read(machine))
        except AttributeError:  # the table is none
            return None

    return Derived(name, (source,), rule)


INERTIAS: Final = tuple(
    in_proportion(f"{body}.inertia_{axes}_kg_m2", f"{body}.mass_kg")
    for body in ("housing", "suspension.block")
    for axes in ("xx", "yy", "zz")
)
"""Moments of inertia of rigid bodies, at the same radii of gyration."""
ROUND_INERTIAS: Final = (
    in_proportion("housing.inertia_xx_kg_m2", "housing.mass_kg"),
    in_proportion("housing.inertia_yy_kg_m2", "housing.inertia_xx_kg_m2"),
    in_proportion("housing.inertia_zz_kg_m2", "housing.mass_kg"),
)
"""Those of a machine that is round about z."""
