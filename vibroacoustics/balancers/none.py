"""The reference: nothing added."""

from ..moving_parts import Array, Balancing
from ..parameters.machine import CommonMachine
from ..parameters.options import NoBalancer


def none(
    option: NoBalancer, machine: CommonMachine, speed_rpm: float, crank_angle: Array
) -> Balancing:
    """Nothing is added; every change is told against this."""
    return Balancing(facts={"added_mass_kg": 0.0})
