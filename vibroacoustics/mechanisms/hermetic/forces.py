"""Joint forces of piston, rod and crank by Newton and Euler, and their load on the shaft."""

from dataclasses import dataclass

import numpy as np

from ...base.constants import STANDARD_GRAVITY_M_PER_S2 as GRAVITY
from .journal_bearing import Values
from .parameters import HermeticTables
from .pin import COORDINATES, PointMotion, RodMotion, crank_point, rod_motion


@dataclass(frozen=True)
class JointForces:
    """Forces in the joints, N, shape (..., 3); z is balanced statically, as in the paper.

    Attributes
    ----------
    piston_on_rod : f_B of Estupiñan eqs. 18 to 20
    rod_on_crank : f_A, with the z component that presses on the crank
    wall_on_piston : N
    """

    piston_on_rod: Values
    rod_on_crank: Values
    wall_on_piston: Values


def joint_forces(machine: HermeticTables, motion: RodMotion, gas_force_n: Values) -> JointForces:
    """Newton-Euler equations of rod and piston (Estupiñan eqs. 18 to 20, signs of appendix A).

    Parameters
    ----------
    machine : masses in kg, lengths in m
    motion : of rod and piston
    gas_force_n : towards the crankshaft, N
    """
    rod, piston = machine.rod, machine.piston
    along, across = motion.centre_acceleration(rod)
    piston_x = -gas_force_n - piston.mass_kg * motion.piston_acceleration
    pin_x = piston_x - rod.mass_kg * along
    moment = (
        rod.length_m * motion.sine * pin_x
        + rod.mass_kg * rod.centre_of_mass_m * motion.sine * motion.piston_acceleration
        + rod.piston_pin_inertia_kg_m2 * motion.angular_acceleration
    )
    pin_y = -moment / (rod.length_m * motion.cosine)
    piston_y = pin_y + rod.mass_kg * across
    crank_share = rod.centre_of_mass_m / rod.length_m * rod.mass_kg * GRAVITY
    piston_share = rod.mass_kg * GRAVITY - crank_share
    one = np.ones_like(pin_x)
    return JointForces(
        np.stack((piston_x, piston_y, piston_share * one), axis=-1),
        np.stack((pin_x, pin_y, -crank_share * one), axis=-1),
        np.stack((0.0 * one, piston_y, (piston_share + piston.mass_kg * GRAVITY) * one), axis=-1),
    )


@dataclass(frozen=True)
class MechanismMotion:
    """Crank pin, crank's centre of mass, rod and piston, with the forces between them."""

    pin: PointMotion
    mass_centre: PointMotion
    mass_centre_acceleration: Values
    rod: RodMotion
    joints: JointForces
    shaft_load: Values
    """Generalised force on the five coordinates of the crank, N and N m, shape (..., 5)."""


def mechanism_motion(
    machine: HermeticTables,
    coordinates: Values,
    rates: Values,
    second_rates: Values,
    gas_force_n: Values,
) -> MechanismMotion:
    """What rod and piston, the crank's eccentric mass and its weight do to the crank.

    Eq. 16 of the paper gives the crank's mass the acceleration of its centre and so leaves the
    unbalance out; here it has that of its centre of mass.

    Parameters
    ----------
    machine : masses in kg, lengths in m
    coordinates, rates, second_rates : x, y, β, Γ, θ and their derivatives, shape (..., 5)
    gas_force_n : towards the crankshaft, N
    """
    crank = machine.crank
    pin = crank_point(coordinates, rates, crank.radius_m, crank.pin_offset_m)
    mass_centre = crank_point(coordinates, rates, crank.mass_eccentricity_m, 0.0)
    rod = rod_motion(
        machine.rod.length_m,
        pin.position_m - np.array([0.0, machine.piston.cylinder_offset_m, 0.0]),
        pin.velocity(rates),
        pin.acceleration(second_rates),
    )
    joints = joint_forces(machine, rod, gas_force_n)
    weight = np.array([0.0, 0.0, -crank.mass_kg * GRAVITY])
    acceleration = mass_centre.acceleration(second_rates)
    inertia = weight - crank.mass_kg * acceleration
    load = pin.generalised(joints.rod_on_crank) + mass_centre.generalised(inertia)
    return MechanismMotion(pin, mass_centre, acceleration, rod, joints, load)


def added_mass(
    machine: HermeticTables, coordinates: Values, rates: Values, gas_force_n: Values
) -> tuple[Values, Values]:
    """Mass matrix (..., 5, 5) of the mechanism and its load at zero second rates (..., 5).

    The load is linear in the second rates, so the columns are exact differences.
    """

    def load(second_rates: Values) -> Values:
        return mechanism_motion(machine, coordinates, rates, second_rates, gas_force_n).shaft_load

    at_rest = load(np.zeros_like(coordinates))
    columns = [at_rest - load(np.zeros_like(coordinates) + unit) for unit in np.eye(COORDINATES)]
    return np.stack(columns, axis=-1), at_rest
