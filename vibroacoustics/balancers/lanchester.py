"""Lanchester's balancer: two weights that turn in opposite senses at the shaft's speed."""

from ..moving_parts import Array, Balancing, circling
from ..parameters.machine import CommonMachine
from ..parameters.options import Lanchester
from .rotating_counterweight import oscillation


def lanchester(
    option: Lanchester, machine: CommonMachine, speed_rpm: float, crank_angle: Array
) -> Balancing:
    """First-order balancer: together the weights make a force along the stroke only.

    Each has half of the mass moment to balance (Lanchester 1914; Taylor, The Internal-Combustion
    Engine in Theory and Practice, vol. 2, chapter 8). They turn about the shaft's axis in the
    plane of the oscillating mass, as two shafts on either side of it would in the mean: no moment
    is left. The change of their own spin is small beside the shaft's and left out.
    """
    slider = oscillation(machine)
    mass = 0.5 * option.share_ratio * slider.mass_kg * slider.amplitude_m / option.radius_m
    parts = tuple(
        circling("balancer", mass, -option.radius_m, slider.height_m, angle, slider.frame)
        for angle in (crank_angle, -crank_angle)
    )
    return Balancing(parts, {"added_mass_kg": 2.0 * mass})
