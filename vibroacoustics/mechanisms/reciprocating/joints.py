"""Joints of one cylinder's piston, rod and crank: their forces and Coulomb friction."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...base.arrays import Array
from ...mechanics.rotation import Rotation
from .cylinders import CylinderBanks
from .parameters import SlidingPairs
from .slider_crank import Motion, SliderCrank, rates_of_momentum


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


def load_torques(moved: Motion, gas_force_n: Array, friction: Friction) -> dict[str, Array]:
    """Torques of gas and friction against the crankshaft's rotation, right side of equation (1).

    Without crank offset dx_p/dθ = -x_p tan φ, dφ/dθ = α cos θ/cos φ and 1 + dφ/dθ = x_p/(l cos φ).
    """
    piston, rod = moved.piston_m[1], moved.rod_angle[1]
    return {
        "gas": -gas_force_n * piston,
        "cylinder_wall": -friction.wall_n * piston,
        "piston_pin": friction.piston_pin_n_m * rod,
        "crank_pin": friction.crank_pin_n_m * (1.0 + rod),
        "journal": friction.journal_n_m,
    }


def constraint_forces(
    crank: SliderCrank, moved: Motion, rotation: Rotation, gas_force_n: Array, friction: Friction
) -> ConstraintForces:
    """Joint forces from the equations of motion of piston and rod (Tsuji et al. 2012, figure 2b).

    Piston: m_p ẍ_p = P + f - T_x. Rod: m_c a = T - S, and its moments about the centre of mass.
    """
    piston, rod_x, rod_y, rod_turn = rates_of_momentum(crank, moved, rotation)
    s, c = np.sin(moved.rod_angle[0]), np.cos(moved.rod_angle[0])
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
    moved: Motion, forces: ConstraintForces, pairs: SlidingPairs, journal_share: Array
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
    wall = -pairs.wall_friction * np.abs(forces.piston_pin_n[1]) * np.sign(moved.piston_m[1])
    return Friction(wall, np.sign(moved.rod_angle[1]) * pin, crank_pin, journal_share * journal)
