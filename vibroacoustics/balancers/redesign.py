"""A machine with changed values of its own: nothing is added beside it."""

from ..moving_parts import Array, Balancing
from ..parameters.machine import CommonMachine
from ..parameters.options import Redesign


def redesign(
    option: Redesign, machine: CommonMachine, speed_rpm: float, crank_angle: Array
) -> Balancing:
    """The changed machine makes other forces; the option itself adds none."""
    return Balancing(facts={"added_mass_kg": option.added_mass_kg})
