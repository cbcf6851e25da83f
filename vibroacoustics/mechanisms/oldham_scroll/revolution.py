"""The scroll with an Oldham coupling: ring and rotating set at constant speed."""

import numpy as np

from ...base.arrays import Array
from ...mechanics.moving_parts import MovingPart, Revolution, circling, path, wrenches_of_parts
from ...mechanics.rotation import constant_rotation
from .parameters import OldhamScrollTables


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


def rotating_set(machine: OldhamScrollTables, crank_angle: Array) -> tuple[MovingPart, ...]:
    """Orbiting parts and counterweights (thesis 6.2, eq. 6.1: F = m e ω² each).

    The thesis gives no counterweight masses; it states that they equal the inertia of the
    orbiting parts. `two_plane_balance` makes them so.

    Parameters
    ----------
    machine : masses in kg, places in m
    crank_angle : shape (samples,), rad
    """
    radius = machine.kinematics.orbit_radius_m
    orbiting = {"orbiting_scroll": machine.orbiting_scroll, "crank_pin": machine.crank_pin}
    if machine.brake is not None:
        orbiting["brake"] = machine.brake
    moments = [part.mass_kg * (part.radius_m or radius) for part in orbiting.values()]
    heights = [part.height_m for part in orbiting.values()]
    planes = machine.counterweights
    upper, lower = two_plane_balance(moments, heights, planes.upper_height_m, planes.lower_height_m)
    return (
        *(
            circling(name, part.mass_kg, part.radius_m or radius, part.height_m, crank_angle)
            for name, part in orbiting.items()
        ),
        counterweight("upper_counterweight", upper, planes.radius_m, planes.upper_height_m,
                      crank_angle),
        counterweight("lower_counterweight", lower, planes.radius_m, planes.lower_height_m,
                      crank_angle),
    )  # fmt: skip


def two_plane_balance(
    mass_moments_kg_m: list[float], heights_m: list[float], upper_m: float, lower_m: float
) -> tuple[float, float]:
    """Mass moments in two planes that cancel force and couple of rotating ones (ISO 21940-11).

    Parameters
    ----------
    mass_moments_kg_m : mass times radius of each rotating part, all at the same angle, kg m
    heights_m : their heights, m
    upper_m, lower_m : heights of the two planes, m

    Returns
    -------
    upper, lower : signed mass moments, kg m; a negative one stands opposite the crank pin
    """
    total = sum(mass_moments_kg_m)
    first = sum(u * z for u, z in zip(mass_moments_kg_m, heights_m, strict=True))
    upper = -(first - total * lower_m) / (upper_m - lower_m)
    return upper, -total - upper


def counterweight(
    source: str, mass_moment_kg_m: float, radius_m: float, height_m: float, crank_angle: Array
) -> MovingPart:
    """A counterweight of given signed mass moment at a positive radius of its own."""
    mass_kg = abs(mass_moment_kg_m) / radius_m
    return circling(source, mass_kg, np.copysign(radius_m, mass_moment_kg_m), height_m, crank_angle)


def oldham_ring(machine: OldhamScrollTables, crank_angle: Array) -> tuple[MovingPart, ...]:
    """Oldham ring on its slots in the housing (thesis eq. 7.3): x = r cos θ.

    The stroke amplitude r is the orbit radius. The inertia force is m ω² r once per revolution,
    not twice as the thesis's abstract says.

    Parameters
    ----------
    machine : masses in kg, places in m
    crank_angle : shape (samples,), rad
    """
    stroke = machine.kinematics.orbit_radius_m * np.cos(crank_angle)
    ring = machine.oldham
    return (MovingPart("oldham", ring.mass_kg, path(stroke, 0.0, ring.height_m)),)
