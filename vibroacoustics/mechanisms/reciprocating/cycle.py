"""Reciprocating compressor with Coulomb friction (Tsuji et al. 2012): forces, losses, speed."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np

from ...base.arrays import Array
from ...base.errors import ParameterError, SolverError
from ...base.units import shaft_frequency_hz
from ...mechanics.crankshaft import DrivenRotation, reduced_inertia, steady_rotation
from ...mechanics.rotation import Rotation, uniform_crank_angle
from .gas import cylinder_pressure
from .machine import ReciprocatingMachine, SlidingPairs
from .slider_crank import (
    Motion,
    SliderCrank,
    design_at_bore,
    motion,
    moving_masses,
    rates_of_momentum,
    top_dead_centre_m,
)

SAMPLES: Final = 3600
"""Crank angles a revolution. The gas pressure has four kinks a revolution; the trapezoidal rule
integrates it to about (2π/3600)²/12 = 2.5e-7."""
ITERATIONS: Final = 100
FRICTION_TOLERANCE: Final = 1e-12
"""Largest change of the friction's torque in the last iteration over the mean load torque."""


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
    journal_n : Q, of the crankshaft on its bearings; S, as the crankshaft is balanced
    """

    piston_pin_n: Array
    crank_pin_n: Array
    journal_n: Array


@dataclass(frozen=True)
class Cycle:
    """One steady revolution over uniform crank angles from top dead centre.

    Attributes
    ----------
    crank : the design
    moved : its motion
    rotation : speed, acceleration, motor torque
    pressure_pa : in the cylinder, shape (samples,)
    gas_force_n : P, along x on the piston, shape (samples,); negative, towards the crankshaft
    friction : in the four sliding pairs
    forces : in the joints
    load_torque_n_m : each load's torque at the crankshaft by its name, shape (samples,)
    """

    crank: SliderCrank
    moved: Motion
    rotation: DrivenRotation
    pressure_pa: Array
    gas_force_n: Array
    friction: Friction
    forces: ConstraintForces
    load_torque_n_m: Mapping[str, Array]

    @property
    def supplied_work_j(self) -> float:
        """E_s of equation (3)."""
        return _work_j(self.rotation.motor_torque_n_m)

    @property
    def load_work_j(self) -> dict[str, float]:
        """E_p, E_f, E_MT, E_MS, E_MQ of equation (3)."""
        return {name: _work_j(torque) for name, torque in self.load_torque_n_m.items()}

    @property
    def mechanical_efficiency(self) -> float:
        """η_m of equation (5)."""
        losses = sum(work for name, work in self.load_work_j.items() if name != "gas")
        return (self.supplied_work_j - losses) / self.supplied_work_j


def _work_j(torque_n_m: Array) -> float:
    return float(2.0 * np.pi * np.mean(torque_n_m))


def steady_cycle(
    machine: ReciprocatingMachine, bore_m: float, speed_rpm: float, samples: int = SAMPLES
) -> Cycle:
    """Solve the crankshaft's equation of motion (1) with Coulomb friction (4) by iteration.

    As in the paper, the first solution is without friction; the friction of each solution goes
    into the next until it repeats.

    Raises
    ------
    ParameterError
        The bore or the speed cannot be.
    SolverError
        The friction does not converge.
    """
    if not 0.0 < speed_rpm < np.inf:
        raise ParameterError(f"speed_rpm = {speed_rpm:g} rpm: must be positive and finite")
    crank = design_at_bore(machine.piston_and_rod, bore_m)
    moved = motion(crank, uniform_crank_angle(samples))
    inertia = reduced_inertia(machine.crankshaft.inertia_kg_m2, moving_masses(crank, moved))
    top = top_dead_centre_m(crank)
    swept = np.maximum(crank.piston_area_m2 * (top - moved.piston_m[0]), 0.0)
    pressure = cylinder_pressure(swept, moved.piston_m[1] < 0.0, machine.gas)
    gas_force = -crank.piston_area_m2 * (pressure - machine.gas.crankcase_pressure_pa)
    mean_speed = 2.0 * np.pi * shaft_frequency_hz(speed_rpm)
    none = np.zeros(samples)
    friction = Friction(none, none, none, none)
    for _ in range(ITERATIONS):
        loads = load_torques(moved, gas_force, friction)
        load = np.sum(list(loads.values()), axis=0)
        rotation = steady_rotation(*inertia, load, mean_speed, machine.crankshaft.motor_slope_ratio)
        forces = constraint_forces(crank, moved, rotation, gas_force, friction)
        friction = coulomb_friction(moved, forces, machine.sliding_pairs)
        change = np.sum(list(load_torques(moved, gas_force, friction).values()), axis=0) - load
        if np.max(np.abs(change)) < FRICTION_TOLERANCE * np.mean(load):
            return Cycle(crank, moved, rotation, pressure, gas_force, friction, forces, loads)
    raise SolverError(f"friction of the reciprocating machine at {speed_rpm:g} rpm: no convergence")


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


def coulomb_friction(moved: Motion, forces: ConstraintForces, pairs: SlidingPairs) -> Friction:
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
    return Friction(wall, np.sign(moved.rod_angle[1]) * pin, crank_pin, journal)
