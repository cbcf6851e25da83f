"""Piston and connecting rod as moving parts, a second way to the force on the housing."""

import numpy as np

from vibroacoustics.mechanics.moving_parts import MovingPart, path
from vibroacoustics.mechanisms.reciprocating.slider_crank import Motion, SliderCrank


def slider_crank_parts(crank: SliderCrank, moved: Motion) -> tuple[MovingPart, ...]:
    """Piston and rod as moving parts: cylinder along x, crank in the plane z = 0.

    The rod is two masses, in its eyes. They have its mass and centre of mass, and its inertia
    where that is m a b.
    """
    zero = np.zeros_like(moved.crank_angle)
    small = crank.rod_mass_kg * crank.big_end_to_centre_m / crank.rod_length_m
    piston = path(moved.piston_m[0], zero + crank.offset_m, zero)
    pin = path(np.cos(moved.crank_angle), np.sin(moved.crank_angle), zero) * crank.crank_radius_m
    return (
        MovingPart("piston", crank.piston_mass_kg, piston),
        MovingPart("connecting_rod", small, piston),
        MovingPart("connecting_rod", crank.rod_mass_kg - small, pin),
    )
