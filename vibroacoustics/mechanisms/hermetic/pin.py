"""Motion of points fixed to a tilting crank, and of the rod and piston that the pin drives.

The crank's five coordinates are x, y of its centre, tilts β about X and Γ about Y1, and the
crank angle θ (Estupiñan fig. 2, cases I to III in one: coordinates that a case holds are zero).
"""

from dataclasses import dataclass

import numpy as np

from ...base.constants import STANDARD_GRAVITY_M_PER_S2 as GRAVITY
from ...base.errors import ParameterError
from .journal_bearing import Values
from .parameters import HermeticTables, Rod

COORDINATES = 5


@dataclass(frozen=True)
class PointMotion:
    """Motion of a point fixed to the crank, apart from its coordinates' accelerations.

    Attributes
    ----------
    position_m : shape (..., 3)
    jacobian : derivative of the position by the coordinates, shape (..., 3, 5)
    bias : acceleration for zero second derivatives of the coordinates, m/s², shape (..., 3)
    """

    position_m: Values
    jacobian: Values
    bias: Values

    def velocity(self, rates: Values) -> Values:
        """Velocity, m/s, shape (..., 3)."""
        return np.asarray(np.einsum("...ij,...j->...i", self.jacobian, rates))

    def acceleration(self, second_rates: Values) -> Values:
        """Acceleration, m/s², shape (..., 3)."""
        return np.asarray(self.bias + np.einsum("...ij,...j->...i", self.jacobian, second_rates))

    def generalised(self, force: Values) -> Values:
        """Generalised force on the five coordinates of a force at the point."""
        return np.asarray(np.einsum("...ij,...i->...j", self.jacobian, force))


def crank_point(
    coordinates: Values, rates: Values, radius_m: float, offset_m: float
) -> PointMotion:
    """Point {r, 0, -h} of the crank's frame B3 (Estupiñan eq. 3, 12 to 15; z added).

    Parameters
    ----------
    coordinates : x, y, β, Γ, θ in m and rad, shape (..., 5)
    rates : their derivatives in time
    radius_m : r, from the shaft axis
    offset_m : h, from the crank's centre against Z
    """
    x, y, beta, gamma, theta = np.moveaxis(coordinates, -1, 0)
    _, _, rate_beta, rate_gamma, rate_theta = np.moveaxis(rates, -1, 0)
    sb, cb, sg, cg = np.sin(beta), np.cos(beta), np.sin(gamma), np.cos(gamma)
    p, q = radius_m * np.cos(theta), radius_m * np.sin(theta)
    across, w = cg * p - sg * offset_m, sg * p + cg * offset_m
    up, along = cb * q + sb * w, sb * q - cb * w
    zero, ones = np.zeros_like(p), np.ones_like(p)
    jacobian = [
        [ones, zero, zero, -w, -cg * q],
        [zero, ones, -along, sb * across, cb * p - sb * sg * q],
        [zero, zero, up, -cb * across, sb * p + cb * sg * q],
    ]
    squares = rate_beta**2, rate_gamma**2, rate_theta**2
    products = (
        2.0 * rate_beta * rate_gamma,
        2.0 * rate_beta * rate_theta,
        (2.0 * rate_gamma * rate_theta),
    )
    bias = [
        -squares[1] * across - squares[2] * cg * p + products[2] * sg * q,
        -squares[0] * up - squares[1] * sb * w - squares[2] * (cb * q + sb * sg * p)
        + products[0] * cb * across - products[1] * (sb * p + cb * sg * q)
        - products[2] * sb * cg * q,
        -squares[0] * along + squares[1] * cb * w - squares[2] * (sb * q - cb * sg * p)
        + products[0] * sb * across + products[1] * (cb * p - sb * sg * q)
        + products[2] * cb * cg * q,
    ]  # fmt: skip
    return PointMotion(
        np.stack((x + across, y + up, along), axis=-1),
        np.stack([np.stack(row, axis=-1) for row in jacobian], axis=-2),
        np.stack(bias, axis=-1),
    )


@dataclass(frozen=True)
class RodMotion:
    """Rod and piston driven by the crank pin: values of shape (...).

    Attributes
    ----------
    sine, cosine : sine and cosine of the rod's angle α to the cylinder axis
    piston_position_m : x_B
    piston_velocity : ẋ_B, m/s
    angular_velocity : α̇, rad/s
    piston_acceleration : ẍ_B, m/s²
    angular_acceleration : α̈, rad/s²
    """

    sine: Values
    cosine: Values
    piston_position_m: Values
    piston_velocity: Values
    angular_velocity: Values
    piston_acceleration: Values
    angular_acceleration: Values

    def centre_acceleration(self, rod: Rod) -> tuple[Values, Values]:
        """x and y acceleration of the rod's centre of mass (Estupiñan, below eq. 19), m/s²."""
        distance, squared = rod.centre_of_mass_m, self.angular_velocity**2
        return (
            self.piston_acceleration
            + distance * (squared * self.cosine + self.angular_acceleration * self.sine),
            distance * (self.angular_acceleration * self.cosine - squared * self.sine),
        )


def rod_motion(
    length_m: float, pin: Values, pin_velocity: Values, pin_acceleration: Values
) -> RodMotion:
    """Rod and piston from the motion of the crank pin in x and y (Estupiñan eqs. 6 to 11).

    Eqs. 7 and 9 print r θ̇² cos θ with the wrong sign; the last row of appendices A and B lacks
    the plus of l α̇² sin α. Both are right here.

    Parameters
    ----------
    length_m : l
    pin, pin_velocity, pin_acceleration : shape (..., 2 or 3), m, m/s, m/s²

    Raises
    ------
    ParameterError
        The rod is too short to reach the cylinder axis.
    """
    sine = pin[..., 1] / length_m
    if np.max(np.abs(sine)) >= 1.0:
        raise ParameterError(
            f"rod.length_m = {length_m:g} m: must exceed the crank pin's height of "
            f"{np.max(np.abs(pin[..., 1])):g} m above the cylinder axis"
        )
    cosine = np.sqrt(1.0 - sine**2)
    angular = pin_velocity[..., 1] / (length_m * cosine)
    turned = (pin_acceleration[..., 1] + length_m * angular**2 * sine) / (length_m * cosine)
    return RodMotion(
        sine=sine,
        cosine=cosine,
        piston_position_m=pin[..., 0] + length_m * cosine,
        piston_velocity=pin_velocity[..., 0] - length_m * sine * angular,
        angular_velocity=angular,
        piston_acceleration=pin_acceleration[..., 0]
        - length_m * (sine * turned + cosine * angular**2),
        angular_acceleration=turned,
    )


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


def joint_forces(machine: HermeticTables, motion: RodMotion, gas_force_n: Values) -> JointForces:
    """Newton-Euler equations of rod and piston (Estupiñan eqs. 18 to 20, signs of appendix A).

    Parameters
    ----------
    machine : masses in kg, lengths in m
    motion : motion of rod and piston
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
    ones = np.ones_like(pin_x)
    return JointForces(
        np.stack((piston_x, piston_y, piston_share * ones), axis=-1),
        np.stack((pin_x, pin_y, -crank_share * ones), axis=-1),
        np.stack((0.0 * ones, piston_y, (piston_share + piston.mass_kg * GRAVITY) * ones), axis=-1),
    )


def mechanism_motion(
    machine: HermeticTables,
    coordinates: Values,
    rates: Values,
    second_rates: Values,
    gas_force_n: Values,
) -> MechanismMotion:
    """Return the effects of rod and piston, the crank's eccentric mass and its weight on the crank.

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
