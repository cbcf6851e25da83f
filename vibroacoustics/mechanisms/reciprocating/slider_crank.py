"""Slider-crank: dimensions of a design, motion over crank angle, force on the housing."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...base.arrays import Array
from ...base.errors import ParameterError
from ...mechanics.crankshaft import acceleration_of, planar
from ...mechanics.moving_parts import Wrench
from ...mechanics.rotation import Rotation
from .cylinders import CylinderBanks
from .parameters import PistonAndRod, SlidingPairs


@dataclass(frozen=True)
class Friction:
    """Friction as it acts on piston (force along x) and connecting rod (moments about z).

    Attributes
    ----------
    wall_n : f, shape (samples,)
    piston_pin_n_m : M_T, of the sign of dφ/dθ, shape (samples,)
    crank_pin_n_m : M_S, on the rod; -M_S acts on the crank, shape (samples,)
    journal_n_m : M_Q, against the crankshaft's rotation, shape (samples,)
    """

    wall_n: Array
    piston_pin_n_m: Array
    crank_pin_n_m: Array
    journal_n_m: Array


@dataclass(frozen=True)
class ConstraintForces:
    """Forces in the joints, x and y, shape (2, samples).

    Attributes
    ----------
    piston_pin_n : T, of the piston on the rod; its y component is also the piston's on the wall
        times -1, and the wall's on the piston
    crank_pin_n : S, of the rod on the crank
    journal_n : S again, this cylinder's part of Q on the crankshaft's bearings
    """

    piston_pin_n: Array
    crank_pin_n: Array
    journal_n: Array


@dataclass(frozen=True)
class SliderCrank:
    """Dimensions and masses of one design.

    Attributes
    ----------
    bore_m : piston diameter
    crank_radius_m : half the stroke
    rod_length_m : between the eyes of the connecting rod
    piston_mass_kg : piston and pin
    rod_mass_kg : connecting rod
    small_end_to_centre_m, big_end_to_centre_m : to the rod's centre of mass
    rod_inertia_kg_m2 : about its centre of mass
    offset_m : e, cylinder axis from the crankshaft's axis, a quarter turn ahead of top dead centre
    """

    bore_m: float
    crank_radius_m: float
    rod_length_m: float
    piston_mass_kg: float
    rod_mass_kg: float
    small_end_to_centre_m: float
    big_end_to_centre_m: float
    rod_inertia_kg_m2: float
    offset_m: float

    @property
    def piston_area_m2(self) -> float:
        return 0.25 * np.pi * self.bore_m**2

    @property
    def displacement_m3(self) -> float:
        """Displacement without crank offset, which lengthens the stroke a little."""
        return 2.0 * self.crank_radius_m * self.piston_area_m2


def top_dead_centre_m(crank: SliderCrank) -> float:
    """Place of the piston pin where crank and rod stand in line, from the crankshaft's axis."""
    return float(np.sqrt((crank.rod_length_m + crank.crank_radius_m) ** 2 - crank.offset_m**2))


def design_at_bore(reference: PistonAndRod, bore_m: float) -> SliderCrank:
    """Design of another bore at constant displacement and length ratio (Tsuji et al. 2012, eq. 6).

    2r = 4 V_s/(π d²), l = r/α; piston mass as d², rod mass as l. The rod's inertia goes as l³ and
    its centre of mass with l; the printed l² contradicts a mass that grows as l.

    Raises
    ------
    ParameterError
        The bore is not positive.
    """
    if not 0.0 < bore_m < np.inf:
        raise ParameterError(f"bore_mm = {1e3 * bore_m:g} mm: must be above 0 mm")
    crank_radius = 2.0 * reference.displacement_m3 / (np.pi * bore_m**2)
    rod_length = crank_radius / reference.crank_to_rod_ratio
    scale = rod_length / reference.rod_length_m
    small_end = reference.small_end_to_centre_m * scale
    return SliderCrank(
        bore_m=bore_m,
        crank_radius_m=crank_radius,
        rod_length_m=rod_length,
        piston_mass_kg=reference.piston_mass_kg * (bore_m / reference.bore_m) ** 2,
        rod_mass_kg=reference.rod_mass_kg * scale,
        small_end_to_centre_m=small_end,
        big_end_to_centre_m=rod_length - small_end,
        rod_inertia_kg_m2=reference.rod_inertia_kg_m2 * scale**3,
        offset_m=reference.crank_offset_m,
    )


@dataclass(frozen=True)
class Motion:
    """Positions over crank angle, each with its first and second derivative, shape (3, samples).

    Attributes
    ----------
    crank_angle : θ from top dead centre, shape (samples,), rad
    rod_angle : φ between rod and cylinder axis, rad
    piston_m : x_p of the piston pin from the crankshaft's axis
    rod_x_m, rod_y_m : centre of mass of the rod
    """

    crank_angle: Array
    rod_angle: Array
    piston_m: Array
    rod_x_m: Array
    rod_y_m: Array


def motion(crank: SliderCrank, crank_angle: Array) -> Motion:
    """l sin φ = r sin θ - e, x_p = r cos θ + l cos φ (Tsuji et al. 2012, figure 2, with e = 0).

    Raises
    ------
    ParameterError
        Crank and offset together are not shorter than the rod: the mechanism cannot turn.
    """
    r, a, e = crank.crank_radius_m, crank.small_end_to_centre_m, crank.offset_m
    if r + abs(e) >= crank.rod_length_m:
        raise ParameterError(
            f"crank_radius_mm = {1e3 * r:g} mm and crank_offset_mm = {1e3 * e:g} mm: together "
            f"must be below rod_length_mm = {1e3 * crank.rod_length_m:g} mm"
        )
    ratio = r / crank.rod_length_m
    sine, cosine = np.sin(crank_angle), np.cos(crank_angle)
    rod = np.arcsin(ratio * sine - e / crank.rod_length_m)
    s, c, t = np.sin(rod), np.cos(rod), np.tan(rod)
    rod_1 = ratio * cosine / c
    rod_2 = rod_1**2 * t - ratio * sine / c
    x = r * cosine + crank.rod_length_m * c
    x_1 = -r * (sine + cosine * t)
    x_2 = -r * (cosine - sine * t + cosine * rod_1 / c**2)
    return Motion(
        crank_angle=crank_angle,
        rod_angle=np.stack([rod, rod_1, rod_2]),
        piston_m=np.stack([x, x_1, x_2]),
        rod_x_m=np.stack([x - a * c, x_1 + a * s * rod_1, x_2 + a * (s * rod_2 + c * rod_1**2)]),
        rod_y_m=np.stack([e + a * s, a * c * rod_1, a * (c * rod_2 - s * rod_1**2)]),
    )


def moving_masses(crank: SliderCrank, kinematics: Motion) -> tuple[tuple[float, Array], ...]:
    """Masses and inertia of piston and rod with what they follow, for `reduced_inertia`.

    The left side of equation (1) of Tsuji et al. 2012 is then I θ̈ + ½ (dI/dθ) θ̇².
    """
    return (
        (crank.piston_mass_kg, kinematics.piston_m),
        (crank.rod_mass_kg, kinematics.rod_x_m),
        (crank.rod_mass_kg, kinematics.rod_y_m),
        (crank.rod_inertia_kg_m2, kinematics.rod_angle),
    )


def rates_of_momentum(
    crank: SliderCrank, kinematics: Motion, rotation: Rotation
) -> tuple[Array, Array, Array, Array]:
    """m_p ẍ_p, m_c ẍ_c, m_c ÿ_c in N and I_c φ̈ in N m, each of shape (samples,)."""
    piston, rod_x, rod_y, turn = (
        mass * acceleration_of(position, rotation)
        for mass, position in moving_masses(crank, kinematics)
    )
    return piston, rod_x, rod_y, turn


def housing_wrenches(
    crank: SliderCrank, kinematics: Motion, rotation: Rotation
) -> dict[str, Wrench]:
    """-Σ m a and -d/dt of the angular momentum about the crankshaft's axis of piston and rod.

    A growing φ turns the rod against the crankshaft.
    """
    piston, rod_x, rod_y, turn = rates_of_momentum(crank, kinematics, rotation)
    rod_moment = turn - kinematics.rod_x_m[0] * rod_y + kinematics.rod_y_m[0] * rod_x
    return {
        "piston": planar(-np.stack([piston, np.zeros_like(piston)]), crank.offset_m * piston),
        "connecting_rod": planar(-np.stack([rod_x, rod_y]), rod_moment),
    }


def load_torques(kinematics: Motion, gas_force_n: Array, friction: Friction) -> dict[str, Array]:
    """Torques of gas and friction against the crankshaft's rotation, right side of equation (1).

    Without crank offset dx_p/dθ = -x_p tan φ, dφ/dθ = α cos θ/cos φ and 1 + dφ/dθ = x_p/(l cos φ).
    """
    piston, rod = kinematics.piston_m[1], kinematics.rod_angle[1]
    return {
        "gas": -gas_force_n * piston,
        "cylinder_wall": -friction.wall_n * piston,
        "piston_pin": friction.piston_pin_n_m * rod,
        "crank_pin": friction.crank_pin_n_m * (1.0 + rod),
        "journal": friction.journal_n_m,
    }


def constraint_forces(
    crank: SliderCrank,
    kinematics: Motion,
    rotation: Rotation,
    gas_force_n: Array,
    friction: Friction,
) -> ConstraintForces:
    """Joint forces from the equations of motion of piston and rod (Tsuji et al. 2012, figure 2b).

    Piston: m_p ẍ_p = P + f - T_x. Rod: m_c a = T - S, and its moments about the centre of mass.
    """
    piston, rod_x, rod_y, rod_turn = rates_of_momentum(crank, kinematics, rotation)
    s, c = np.sin(kinematics.rod_angle[0]), np.cos(kinematics.rod_angle[0])
    t_x = gas_force_n + friction.wall_n - piston
    moments = crank.big_end_to_centre_m * (s * rod_x + c * rod_y) - rod_turn
    moments -= friction.piston_pin_n_m + friction.crank_pin_n_m
    t_y = (moments / crank.rod_length_m - s * t_x) / c
    pin = np.stack([t_x, t_y])
    crank_pin = pin - np.stack([rod_x, rod_y])
    return ConstraintForces(pin, crank_pin, crank_pin)


def journal_share(
    banks: CylinderBanks, joints: Sequence[ConstraintForces], rotation: Rotation
) -> list[Array]:
    """Force in the journals of each cylinder's throw over the sum of what its crank pins make.

    The bearings beside a throw take the vector sum of its rods and counterweights; with one rod
    and no counterweight the share is 1.

    Returns
    -------
    by cylinder, shape (samples,)
    """
    total = banks.counterweight_pulls_n(rotation)
    sizes = np.zeros((len(total), total.shape[-1]))
    for cylinder, forces in zip(banks.cylinders, joints, strict=True):
        c, s = np.cos(cylinder.bank_rad), np.sin(cylinder.bank_rad)
        x, y = forces.journal_n
        total[cylinder.throw] += np.stack([c * x - s * y, s * x + c * y])
        sizes[cylinder.throw] += np.hypot(x, y)
    share = np.hypot(total[:, 0], total[:, 1]) / np.maximum(sizes, np.finfo(float).tiny)
    return [share[cylinder.throw] for cylinder in banks.cylinders]


def coulomb_friction(
    kinematics: Motion, forces: ConstraintForces, pairs: SlidingPairs, journal_share: Array
) -> Friction:
    """Friction of the joint forces, against the motion in each pair (equation 4)."""
    pin, crank_pin, journal = (
        pairs.bearing_friction * radius * np.hypot(*force)
        for radius, force in (
            (pairs.piston_pin_radius_m, forces.piston_pin_n),
            (pairs.crank_pin_radius_m, forces.crank_pin_n),
            (pairs.journal_radius_m, forces.journal_n),
        )
    )
    wall = -pairs.wall_friction * np.abs(forces.piston_pin_n[1]) * np.sign(kinematics.piston_m[1])
    return Friction(
        wall, np.sign(kinematics.rod_angle[1]) * pin, crank_pin, journal_share * journal
    )
