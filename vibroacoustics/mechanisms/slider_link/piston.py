"""Slider-link mechanism: motion of piston and slider, forces on the piston.

Equations of Dagilis, Vaitkus and Kirejchick, "Slider-link driven compressor (I)". Frame of the
paper: x along the cylinder, towards its head, z down along the shaft; the crank angle is zero at
the upper dead centre.
"""

from dataclasses import dataclass
from itertools import product
from typing import Final

import numpy as np

from ...base.arrays import Array
from ...base.errors import ParameterError
from ...mechanics.cylinder_gas import CylinderGas, ValvedCylinder
from .parameters import SliderLink

SIDES: Final = np.array(list(product((1.0, -1.0), repeat=3)))
"""Signs of F_GN1, F_GN2 and F_BN (δ3, δ4, δ5) for the eight ways to touch."""


@dataclass(frozen=True)
class CrankState:
    """Crank angle, rad, its velocity and acceleration, rad/s and rad/s²; shape (samples,)."""

    angle: Array
    velocity: Array
    acceleration: Array

    @property
    def along(self) -> Array:
        """a = φ̇² cos φ + φ̈ sin φ; the piston's acceleration is -R a (2)."""
        return np.asarray(
            self.velocity**2 * np.cos(self.angle) + self.acceleration * np.sin(self.angle)
        )

    @property
    def across(self) -> Array:
        """b = φ̇² sin φ - φ̈ cos φ; the slider's acceleration along y is -R b (3)."""
        return np.asarray(
            self.velocity**2 * np.sin(self.angle) - self.acceleration * np.cos(self.angle)
        )


@dataclass(frozen=True)
class PistonContacts:
    """Constraint forces on piston and link, N, and the signs δ1 to δ5 that go with them.

    Attributes
    ----------
    front : F_GN1, along y, at the piston's end, shape (samples,)
    rear : F_GN2, along y, at the crank-side end of the cylinder, shape (samples,)
    link : F_BN, along x, of the slider on the link, shape (samples,)
    sides : δ3, δ4, δ5, shape (samples, 3)
    piston_sense, slider_sense : δ1, δ2, shape (samples,)
    """

    front: Array
    rear: Array
    link: Array
    sides: Array
    piston_sense: Array
    slider_sense: Array


def sign(values: Array) -> Array:
    """The paper's sgn (6): 1 from zero up."""
    return np.where(values >= 0.0, 1.0, -1.0)


def piston_velocity(mechanism: SliderLink, state: CrankState) -> Array:
    """Velocity of the piston along x (2), m/s.

    Parameters
    ----------
    mechanism : lengths in m
    state : motion of the crank
    """
    return np.asarray(-mechanism.crank_radius_m * state.velocity * np.sin(state.angle))


def slider_velocity(mechanism: SliderLink, state: CrankState) -> Array:
    """Velocity of the slider along y (3), m/s.

    Parameters
    ----------
    mechanism : lengths in m
    state : motion of the crank
    """
    return np.asarray(mechanism.crank_radius_m * state.velocity * np.cos(state.angle))


def engaged_length(mechanism: SliderLink, angle: Array) -> Array:
    """Length of piston in the cylinder, γ3 of (31) = L_c - R (1 - cos φ), m.

    Parameters
    ----------
    mechanism : lengths in m
    angle : crank angle, shape (...), rad
    """
    fall = mechanism.crank_radius_m * (1.0 - np.cos(angle))
    return np.asarray(mechanism.cylinder_length_m - fall)


def piston_film_force(mechanism: SliderLink, viscosity_pa_s: float, state: CrankState) -> Array:
    """Petroff friction of the oil film on the piston along x (7), N.

    Parameters
    ----------
    mechanism : lengths in m
    viscosity_pa_s : dynamic viscosity
    state : motion of the crank
    """
    wetted = np.pi * mechanism.bore_m * engaged_length(mechanism, state.angle)
    rate = piston_velocity(mechanism, state) / mechanism.piston_clearance_m
    return np.asarray(-viscosity_pa_s * wetted * rate)


def piston_matrix(
    mechanism: SliderLink,
    angle: Array,
    sides: Array,
    piston_sense: Array,
    slider_sense: Array,
    friction_arm_m: float = 0.0,
) -> Array:
    """Matrix of (10) for F_GN1, F_GN2, F_BN, shape (..., 3, 3); rows force x, force y, moment.

    The friction of the slider has no arm: link and slider exchange the moment M_b as well, and
    since the slider does not turn the two cancel up to the crank pin's friction moment. The
    paper leaves M_b out and has an arm of half the slider's diameter.

    Parameters
    ----------
    mechanism : lengths in m
    angle : crank angle, shape (...), rad
    sides : δ3, δ4, δ5, shape (..., 3)
    piston_sense, slider_sense : δ1, δ2, shape (...)
    friction_arm_m : D_s/2 for the matrix as printed
    """
    front, rear, link = np.moveaxis(sides, -1, 0)
    cylinder = piston_sense * mechanism.cylinder_friction_ratio
    pair = slider_sense * mechanism.link_friction_ratio
    tilt = -0.5 * cylinder * mechanism.bore_m
    length = mechanism.piston_length_m
    offset = mechanism.link_offset_m + mechanism.crank_radius_m * np.sin(angle)
    rows = (
        (cylinder * front, cylinder * rear, 1.0),
        (1.0, 1.0, pair * link),
        (
            tilt - length,
            tilt - (length - engaged_length(mechanism, angle)),
            offset - pair * friction_arm_m,
        ),
    )
    shape = np.broadcast_shapes(np.shape(front), np.shape(angle), np.shape(piston_sense))
    entries = [[np.broadcast_to(entry, shape) for entry in row] for row in rows]
    return np.stack([np.stack(row, axis=-1) for row in entries], axis=-2)


def piston_contacts(
    mechanism: SliderLink,
    state: CrankState,
    axial_force_n: Array,
    tilting_moment_n_m: Array,
) -> PistonContacts:
    """Constraint forces on the piston (8) to (11), with the sides that it touches.

    One of the eight combinations of sides is taken: its forces have the signs assumed. It
    exists and is the only one where all eight determinants are positive (`check_not_jammed`).

    Parameters
    ----------
    mechanism : lengths in m
    state : motion of the crank
    axial_force_n : F_g - F_FG + m_p ẍ_p, first entry of the right side of (10), shape (samples,)
    tilting_moment_n_m : m_p ẍ_p e_cl and the crank pin's friction moment, third entry of the right
        side of (10), shape (samples,)
    """
    senses = sign(-piston_velocity(mechanism, state)), sign(slider_velocity(mechanism, state))
    matrix = piston_matrix(
        mechanism, state.angle[:, None], SIDES, senses[0][:, None], senses[1][:, None]
    )
    right = np.stack([axial_force_n, np.zeros_like(axial_force_n), tilting_moment_n_m], axis=-1)
    forces = np.linalg.solve(matrix, right[:, None, :, None])[..., 0]
    # The least force against its assumed side; zero is met by two combinations alike.
    chosen = np.argmax(np.min(forces * SIDES, axis=-1), axis=-1)
    front, rear, link = forces[np.arange(len(chosen)), chosen].T
    return PistonContacts(front, rear, link, SIDES[chosen], *senses)


def check_not_jammed(mechanism: SliderLink) -> None:
    """Refuse friction that would lock the piston.

    The forces with |F| in them are linear in each octant of signs. Such a map has one solution
    for every load if and only if its eight determinants have one sign (Samelson, Thrall and
    Wesler 1958); without friction all are L_c - R (1 - cos φ) > 0.

    Parameters
    ----------
    mechanism : lengths in m

    Raises
    ------
    ParameterError
        A determinant is not positive.
    """
    angle = np.deg2rad(np.arange(720.0) / 2.0)[:, None, None]
    senses = np.array(list(product((1.0, -1.0), repeat=2)))
    matrix = piston_matrix(
        mechanism, angle, SIDES[None, None], senses[:, 0, None], senses[:, 1, None]
    )
    if np.min(np.linalg.det(matrix)) <= 0.0:
        raise ParameterError(
            f"cylinder_friction_ratio = {mechanism.cylinder_friction_ratio:g}, "
            f"link_friction_ratio = {mechanism.link_friction_ratio:g}: so large that the piston "
            "jams in the cylinder"
        )


def cylinder_pressure(gas: CylinderGas, angle: Array) -> Array:
    """Pressure in the cylinder, Pa: polytropic, ideal valves.

    Stands in for the valve model of the paper's reference [1], which it does not print.

    Parameters
    ----------
    gas : pressures in Pa
    angle : crank angle, shape (...), rad
    """
    fill = gas.clearance_ratio + 0.5 * (1.0 - np.cos(angle))
    return gas.valve_cycle.pressure_pa(fill, np.sin(angle) > 0.0)


def valve_angles(gas: CylinderGas) -> tuple[float, float]:
    """Crank angles where suction and discharge begin, rad.

    Parameters
    ----------
    gas : pressures in Pa
    """
    cycle, clearance = gas.valve_cycle, gas.clearance_ratio
    suction = np.arccos(1.0 - 2.0 * (cycle.fill_at_suction - clearance))
    discharge = np.arccos(1.0 - 2.0 * (cycle.fill_at_discharge - clearance))
    return float(suction), float(2.0 * np.pi - discharge)


def valved_cylinder(mechanism: SliderLink, gas: CylinderGas) -> ValvedCylinder:
    """The cylinder as sources of sound take it: the piston moves by a pure cosine."""
    displaced = 0.5 * np.pi * mechanism.bore_m**2 * mechanism.crank_radius_m
    return ValvedCylinder(
        displaced, gas.valve_cycle, lambda angle: gas.clearance_ratio + 0.5 * (1.0 - np.cos(angle))
    )


def gas_force(mechanism: SliderLink, gas: CylinderGas, angle: Array) -> Array:
    """Gas force (1) = (p_c - p_0) A_p, N, on the piston towards -x.

    Parameters
    ----------
    mechanism : lengths in m
    gas : pressures in Pa
    angle : crank angle, shape (...), rad
    """
    area = np.pi / 4.0 * mechanism.bore_m**2
    return np.asarray((cylinder_pressure(gas, angle) - gas.suction_pressure_pa) * area)
