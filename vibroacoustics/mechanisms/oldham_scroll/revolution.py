"""The scroll with an Oldham coupling: ring and rotating set at constant speed."""

from ...base.arrays import Array
from ...mechanics.moving_parts import MovingPart, Revolution, wrenches_of_parts
from ...mechanics.rotation import constant_rotation
from .parameters import OldhamScrollTables
from .ring import oldham_ring
from .rotating_set import rotating_set


def scroll_parts(machine: OldhamScrollTables, crank_angle: Array) -> tuple[MovingPart, ...]:
    """Ring, orbiting scroll, pin, brake and counterweights.

    Parameters
    ----------
    machine : masses in kg, places in m
    crank_angle : shape (samples,), rad
    """
    return (*oldham_ring(machine, crank_angle), *rotating_set(machine, crank_angle))


def oldham_scroll(machine: OldhamScrollTables, speed_rpm: float, samples: int) -> Revolution:
    """Force and moment of ring, orbiting scroll, pin, brake and counterweights, by source.

    Parameters
    ----------
    machine : masses in kg, places in m
    speed_rpm : constant
    samples : crank angles of the revolution
    """
    rotation = constant_rotation(speed_rpm, samples)
    parts = scroll_parts(machine, rotation.crank_angle)
    return Revolution(speed_rpm, rotation, wrenches_of_parts(parts, rotation))
