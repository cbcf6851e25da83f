"""Balancing options: what each adds to the machine, as moving parts and reported figures."""

from collections.abc import Callable
from typing import Any, Final

from ..moving_parts import Array, Balancing
from .lanchester import lanchester
from .none import none
from .pendulum import pendulum
from .redesign import redesign
from .ring_damping import ring_damping
from .rotating_counterweight import rotating_counterweight
from .spring_mass import spring_mass, spring_mass_printed
from .twin_oldham import twin_oldham

Balancer = Callable[[Any, Any, float, Array], Balancing]
"""(parameters of the option, machine, speed in rpm, crank angle in rad) to what it adds."""

BALANCERS: Final[dict[str, Balancer]] = {
    "none": none,
    "pendulum": pendulum,
    "spring-mass": spring_mass,
    "spring-mass-printed": spring_mass_printed,
    "twin-oldham": twin_oldham,
    "ring-damping": ring_damping,
    "rotating-counterweight": rotating_counterweight,
    "lanchester": lanchester,
    "redesign": redesign,
}

__all__ = [
    "BALANCERS",
    "Balancer",
    "lanchester",
    "none",
    "pendulum",
    "redesign",
    "ring_damping",
    "rotating_counterweight",
    "spring_mass",
    "spring_mass_printed",
    "twin_oldham",
]
