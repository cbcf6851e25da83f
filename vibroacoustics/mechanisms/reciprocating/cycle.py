"""Reciprocating compressor with Coulomb friction (Tsuji et al. 2012): forces, losses, speed."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar

from ...base.arrays import Array
from ...base.errors import ParameterError, SolverError
from ...base.units import shaft_frequency_hz
from ...mechanics.crankshaft import DrivenRotation, reduced_inertia, steady_rotation
from ...mechanics.cylinder_gas import IdealValveCycle
from ...mechanics.rotation import uniform_crank_angle
from .cylinders import Cylinder
from .parameters import CylinderGas, ReciprocatingTables
from .slider_crank import (
    ConstraintForces,
    Friction,
    Motion,
    SliderCrank,
    constraint_forces,
    coulomb_friction,
    design_at_bore,
    journal_share,
    load_torques,
    motion,
    moving_masses,
    top_dead_centre_m,
)

SAMPLES: Final = 3600
"""Crank angles a revolution. The gas pressure has four kinks a revolution; the trapezoidal rule
integrates it to about (2π/3600)²/12 = 2.5e-7."""
ITERATIONS: Final = 100
FRICTION_TOLERANCE: Final = 1e-12
"""Largest change of the friction's torque in the last iteration over the mean load torque."""


@dataclass(frozen=True)
class Charge:
    """One cylinder with its gas over the shaft's crank angles.

    Attributes
    ----------
    cylinder : where it stands
    kinematics : its motion, from its own top dead centre
    pressure_pa : in the cylinder, shape (samples,)
    gas_force_n : P, along its axis on the piston, shape (samples,)
    """

    cylinder: Cylinder
    kinematics: Motion
    pressure_pa: Array
    gas_force_n: Array


@dataclass(frozen=True)
class Cycle:
    """One steady revolution over uniform crank angles from the first cylinder's top dead centre.

    Attributes
    ----------
    crank : the design
    rotation : speed, acceleration, motor torque
    charges : motion and gas by cylinder
    frictions : in the four sliding pairs, by cylinder
    joints : forces in the joints, by cylinder
    load_torque_n_m : each load's torque at the crankshaft by its name, shape (samples,)
    """

    crank: SliderCrank
    rotation: DrivenRotation
    charges: Sequence[Charge]
    frictions: Sequence[Friction]
    joints: Sequence[ConstraintForces]
    load_torque_n_m: Mapping[str, Array]

    @property
    def kinematics(self) -> Motion:
        """Motion of the first cylinder."""
        return self.charges[0].kinematics

    @property
    def pressure_pa(self) -> Array:
        """Pressure in the first cylinder."""
        return self.charges[0].pressure_pa

    @property
    def gas_force_n(self) -> Array:
        """Force on the first piston."""
        return self.charges[0].gas_force_n

    @property
    def friction(self) -> Friction:
        """Friction in the first cylinder's pairs."""
        return self.frictions[0]

    @property
    def forces(self) -> ConstraintForces:
        """Forces in the first cylinder's joints."""
        return self.joints[0]

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
    machine: ReciprocatingTables, bore_m: float, speed_rpm: float, samples: int = SAMPLES
) -> Cycle:
    """Solve the crankshaft's equation of motion (1) with Coulomb friction (4) by iteration.

    The first solution is without friction, which the paper does too; the friction of each goes
    into the next until it repeats. With several cylinders the sums of (1) go over all of them.

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
    charges = [_charge(crank, item, machine.gas, samples) for item in machine.banks.cylinders]
    moving = [mass for charge in charges for mass in moving_masses(crank, charge.kinematics)]
    inertia = reduced_inertia(machine.crankshaft.inertia_kg_m2, moving)
    mean_speed = 2.0 * np.pi * shaft_frequency_hz(speed_rpm)
    frictions = [Friction(*[np.zeros(samples)] * 4) for _ in charges]
    loads = _loads(charges, frictions)
    for _ in range(ITERATIONS):
        load = np.sum(list(loads.values()), axis=0)
        rotation = steady_rotation(*inertia, load, mean_speed, machine.crankshaft.motor_slope_ratio)
        joints = [
            constraint_forces(crank, charge.kinematics, rotation, charge.gas_force_n, friction)
            for charge, friction in zip(charges, frictions, strict=True)
        ]
        shares = journal_share(machine.banks, joints, rotation)
        frictions = [
            coulomb_friction(charge.kinematics, forces, machine.sliding_pairs, share)
            for charge, forces, share in zip(charges, joints, shares, strict=True)
        ]
        before, loads = loads, _loads(charges, frictions)
        change = np.sum(list(loads.values()), axis=0) - load
        if np.max(np.abs(change)) < FRICTION_TOLERANCE * np.mean(load):
            return Cycle(crank, rotation, charges, frictions, joints, before)
    raise SolverError(f"friction of the reciprocating machine at {speed_rpm:g} rpm: no convergence")


def _charge(crank: SliderCrank, cylinder: Cylinder, gas: CylinderGas, samples: int) -> Charge:
    kinematics = motion(crank, uniform_crank_angle(samples) + cylinder.lead_rad)
    top = top_dead_centre_m(crank)
    swept = np.maximum(crank.piston_area_m2 * (top - kinematics.piston_m[0]), 0.0)
    pressure = cylinder_pressure(swept, kinematics.piston_m[1] < 0.0, gas)
    force = -crank.piston_area_m2 * (pressure - gas.crankcase_pressure_pa)
    return Charge(cylinder, kinematics, pressure, force)


def _loads(charges: Sequence[Charge], frictions: Sequence[Friction]) -> dict[str, Array]:
    """Torques against the crankshaft's rotation by name, of all cylinders together."""
    single = [
        load_torques(charge.kinematics, charge.gas_force_n, friction)
        for charge, friction in zip(charges, frictions, strict=True)
    ]
    return {name: np.asarray(sum(loads[name] for loads in single[1:]) + single[0][name])
            for name in single[0]}  # fmt: skip


def cylinder_pressure(swept_m3: Array, expanding: NDArray[np.bool_], gas: CylinderGas) -> Array:
    """Pressure over a revolution: polytropic with index n, valves that open without loss, Pa.

    Tsuji et al. 2012, 3.1. After top dead centre the gas in the clearance expands down to suction
    pressure, after bottom dead centre the charge is compressed up to discharge pressure.

    Parameters
    ----------
    swept_m3 : volume that the piston has uncovered since top dead centre, shape (samples,), m³
    expanding : whether the piston moves towards the crankshaft, shape (samples,)
    gas : pressures, polytropic index, clearance
    """
    cycle = IdealValveCycle(
        gas.suction_pressure_pa,
        gas.discharge_pressure_pa,
        gas.polytropic_index,
        gas.clearance_ratio,
    )
    fill = swept_m3 / float(np.max(swept_m3)) + gas.clearance_ratio
    return cycle.pressure_pa(fill, expanding)


def efficiency_map(
    machine: ReciprocatingTables,
    speed_rpm: Sequence[float] | Array,
    bore_m: Sequence[float] | Array,
    samples: int = SAMPLES,
) -> Array:
    """Mechanical efficiency at constant displacement (Tsuji et al. 2012, figure 5c).

    Parameters
    ----------
    machine : masses in kg, lengths in m, pressures in Pa
    speed_rpm : mean over time
    bore_m : bore of the designs
    samples : crank angles of a revolution

    Returns
    -------
    shape (speeds, bores)
    """
    return np.array(
        [
            [
                steady_cycle(machine, float(bore), float(speed), samples).mechanical_efficiency
                for bore in bore_m
            ]
            for speed in speed_rpm
        ]
    )


def optimum_bore(
    machine: ReciprocatingTables,
    speed_rpm: float,
    lowest_m: float,
    highest_m: float,
    samples: int = SAMPLES,
) -> tuple[float, float]:
    """Bore of the best efficiency at constant displacement (Tsuji et al. 2012, figure 6).

    Parameters
    ----------
    machine : masses in kg, lengths in m, pressures in Pa
    speed_rpm : mean over time
    lowest_m, highest_m : bores between which it is looked for
    samples : crank angles of a revolution

    Returns
    -------
    bore, efficiency : m and ratio

    Raises
    ------
    ParameterError
        The range is empty or the best bore lies on an end of it.
    """
    where = f"bore_mm from {1e3 * lowest_m:g} to {1e3 * highest_m:g} mm"
    if not 0.0 < lowest_m < highest_m < np.inf:
        raise ParameterError(f"{where}: must be two rising, positive lengths")
    optimum = minimize_scalar(
        lambda bore: -steady_cycle(machine, float(bore), speed_rpm, samples).mechanical_efficiency,
        bounds=(lowest_m, highest_m),
        method="bounded",
        options={"xatol": 1e-5},
    )
    if min(optimum.x - lowest_m, highest_m - optimum.x) < 1e-4:
        raise ParameterError(f"{where}: holds no optimum bore")
    return float(optimum.x), -float(optimum.fun)
