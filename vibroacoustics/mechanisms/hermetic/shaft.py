"""Equations of motion of the crankshaft with rod and piston, over the crank angle.

Cases I, II and III of Estupiñan & Santos differ in the shaft's degrees of freedom only: none, the
crank's x and y, or a finite-element rotor. The states are displacements, velocities and the shaft
speed.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np

from ...base.arrays import Array
from ...mechanics.beam_rotor import (
    NODE_DOFS,
    RotorMatrices,
    Section,
    assemble,
    with_disc,
)
from .gas import gas_force_n
from .journal_bearing import COMPLEX_STEP, FilmForce
from .parameters import HermeticTables
from .pin import COORDINATES, added_mass, mechanism_motion

ELEMENTS_TO_LOWER_BEARING: Final = 2
ELEMENTS_TO_ROTOR: Final = 2
"""The paper uses four elements in all."""


@dataclass(frozen=True)
class Crankshaft:
    """Freedoms of the shaft of one case.

    Attributes
    ----------
    matrices : matrices of the rotor's n degrees of freedom; the first are those of the crank
    bearing_dofs : index of x of each bearing; y follows it
    free : which of the crank's x, y, β, Γ, θ move, in this order; the others are held
    """

    matrices: RotorMatrices
    bearing_dofs: tuple[int, ...]
    free: tuple[int, ...]

    @property
    def dof_count(self) -> int:
        """Number of the rotor's degrees of freedom, without the crank angle."""
        return int(self.matrices.mass.shape[0])

    @property
    def crank_indices(self) -> Array:
        """Indices of the free crank coordinates among the degrees of freedom and, last, θ."""
        return np.array([*range(len(self.free) - 1), self.dof_count])


def crankshaft(machine: HermeticTables) -> Crankshaft:
    """The shaft of the machine's case (Estupiñan, Mathematical Modelling)."""
    if machine.case == "III":
        return _flexible(machine)
    count = 0 if machine.case == "I" else 2
    zero = np.zeros((count, count))
    free = (4,) if machine.case == "I" else (0, 1, 4)
    return Crankshaft(RotorMatrices(zero, zero, zero), (0,) if count else (), free)


def _flexible(machine: HermeticTables) -> Crankshaft:
    lower = NODE_DOFS * ELEMENTS_TO_LOWER_BEARING
    return Crankshaft(rotor_matrices(machine), (0, lower), (0, 1, 2, 3, 4))


def node_positions_m(machine: HermeticTables) -> Array:
    """Nodes along the shaft from the crank's centre to the centre of the motor rotor, m."""
    lower = machine.shaft.bearing_distance_m
    end = lower + machine.shaft.rotor_distance_m
    upper_part = np.linspace(0.0, lower, ELEMENTS_TO_LOWER_BEARING + 1)
    return np.concatenate((upper_part, np.linspace(lower, end, ELEMENTS_TO_ROTOR + 1)[1:]))


def rotor_matrices(machine: HermeticTables) -> RotorMatrices:
    """Finite-element shaft with the motor rotor and the crank's moments of inertia."""
    shaft, rotor, crank = machine.shaft, machine.rotor, machine.crank
    positions = node_positions_m(machine)
    section = Section(shaft.diameter_m, shaft.youngs_modulus_pa, shaft.density_kg_per_m3)
    beam = assemble(section, positions)
    inertias = crank.transverse_inertia_kg_m2, crank.axial_inertia_kg_m2
    beam = with_disc(beam, 0, 0.0, *inertias)  # its mass moves with the mechanism
    return with_disc(
        beam,
        positions.size - 1,
        rotor.mass_kg,
        rotor.transverse_inertia_kg_m2,
        rotor.axial_inertia_kg_m2,
    )


@dataclass(frozen=True)
class ShaftEquations:
    """Slopes over the crank angle of displacements, velocities and shaft speed."""

    machine: HermeticTables
    shaft: Crankshaft
    film: FilmForce

    @property
    def axial_inertia_kg_m2(self) -> float:
        return self.machine.rotor.axial_inertia_kg_m2 + self.machine.crank.axial_inertia_kg_m2

    def split(self, states: Array) -> tuple[Array, Array, Array]:
        """Displacements, velocities and shaft speed of states (..., 2n + 1)."""
        count = self.shaft.dof_count
        return states[..., :count], states[..., count:-1], states[..., -1]

    def crank_coordinates(self, angle: Array, states: Array) -> tuple[Array, Array]:
        """x, y, β, Γ, θ of the crank and their rates, shape (..., 5)."""
        displacement, velocity, speed = self.split(states)
        coordinates, rates = (np.zeros((*speed.shape, COORDINATES)) for _ in range(2))
        coordinates[..., -1], rates[..., -1] = angle, speed
        free = list(self.shaft.free[:-1])
        coordinates[..., free] = displacement[..., : len(free)]
        rates[..., free] = velocity[..., : len(free)]
        return coordinates, rates

    def motor_torque(self, speed: Array) -> Array:
        """Torque of the motor, N m."""
        motor = self.machine.motor
        return np.asarray(motor.torque_slope_n_m_s * (motor.synchronous_speed_rad_per_s - speed))

    def film_forces(self, states: Array) -> Array:
        """Force of each bearing's film on its journal, N, shape (..., bearings, 2)."""
        displacement, velocity, speed = self.split(states)
        pairs = [(displacement[..., dof : dof + 2], velocity[..., dof : dof + 2])
                 for dof in self.shaft.bearing_dofs]  # fmt: skip
        forces = [self.film(self.machine.bearing, *pair, speed) for pair in pairs]
        return np.stack(forces, axis=-2) if forces else np.zeros((*speed.shape, 0, 2))

    def _balance(self, angle: Array, states: Array) -> tuple[Array, Array]:
        """Mass matrix and force of the degrees of freedom and, last, the crank angle."""
        shaft, (displacement, velocity, speed) = self.shaft, self.split(states)
        size = shaft.dof_count + 1
        mass, force = np.zeros((*speed.shape, size, size)), np.zeros((*speed.shape, size))
        mass[..., :-1, :-1] = shaft.matrices.mass
        mass[..., -1, -1] = self.axial_inertia_kg_m2
        force[..., :-1] = -displacement @ shaft.matrices.stiffness
        force[..., :-1] -= speed[..., None] * (velocity @ shaft.matrices.gyroscopic.T)
        force[..., -1] = self.motor_torque(speed)
        for dof, film in zip(
            shaft.bearing_dofs, np.moveaxis(self.film_forces(states), -2, 0), strict=True
        ):
            force[..., dof : dof + 2] += film
        coordinates, rates = self.crank_coordinates(angle, states)
        added, load = added_mass(self.machine, coordinates, rates, gas_force_n(self.machine, angle))
        crank_dofs, free = shaft.crank_indices, list(shaft.free)
        mass[..., crank_dofs[:, None], crank_dofs] += added[..., free, :][..., free]
        force[..., crank_dofs] += load[..., free]
        return mass, force

    def accelerations(self, angle: Array, states: Array) -> Array:
        """Second derivatives in time of the degrees of freedom and crank angle, shape (..., n +
        1)."""
        mass, force = self._balance(angle, states)
        return np.asarray(np.linalg.solve(mass, force[..., None])[..., 0])

    def slopes(self, angle: Array, states: Array) -> Array:
        """d(states)/dθ, shape (..., 2n + 1)."""
        _, velocity, speed = self.split(states)
        rates = np.concatenate((velocity, self.accelerations(angle, states)), axis=-1)
        return np.asarray(rates / speed[..., None])

    def slopes_and_tangents(self, angle: Array, states: Array) -> tuple[Array, Array]:
        """d(states)/dθ and its derivatives by the states, shapes (points, m) and (points, m, m)."""
        count, speed = self.shaft.dof_count, states[..., -1]
        mass, force = self._balance(angle, states)
        accelerations = np.asarray(np.linalg.solve(mass, force[..., None])[..., 0], dtype=float)
        residual = self._residual_tangent(angle, states, accelerations)
        rates = np.concatenate((states[..., count:-1], accelerations), axis=-1)
        tangent = np.zeros((*rates.shape, rates.shape[-1]))
        tangent[..., :count, count:-1] = np.eye(count)
        tangent[..., count:, :] = np.linalg.solve(mass, residual)
        tangent[..., -1] -= rates / speed[..., None]
        return rates / speed[..., None], tangent / speed[..., None, None]

    def _residual_tangent(self, angle: Array, states: Array, accelerations: Array) -> Array:
        """Derivative of force - mass x (given accelerations) by the states."""
        shaft, (_, velocity, speed) = self.shaft, self.split(states)
        count, matrices = shaft.dof_count, shaft.matrices
        tangent = np.zeros((*speed.shape, count + 1, 2 * count + 1))
        tangent[..., :-1, :count] = -matrices.stiffness
        tangent[..., :-1, count:-1] = -speed[..., None, None] * matrices.gyroscopic
        tangent[..., :-1, -1] = -velocity @ matrices.gyroscopic.T
        tangent[..., -1, -1] = -self.machine.motor.torque_slope_n_m_s
        self._add_film_tangent(states, tangent)
        self._add_mechanism_tangent(angle, states, accelerations, tangent)
        return tangent

    def _add_film_tangent(self, states: Array, tangent: Array) -> None:
        count, bearing = self.shaft.dof_count, self.machine.bearing
        for dof in self.shaft.bearing_dofs:
            columns = [dof, dof + 1, count + dof, count + dof + 1, -1]
            local = states[..., columns].astype(complex)
            for index, column in enumerate(columns):
                perturbed = local.copy()
                perturbed[..., index] += 1j * COMPLEX_STEP
                force = self.film(
                    bearing, perturbed[..., :2], perturbed[..., 2:4], perturbed[..., 4]
                )
                tangent[..., dof : dof + 2, column] += force.imag / COMPLEX_STEP

    def _add_mechanism_tangent(
        self, angle: Array, states: Array, accelerations: Array, tangent: Array
    ) -> None:
        shaft, gas = self.shaft, gas_force_n(self.machine, angle)
        crank_dofs, free = shaft.crank_indices, list(shaft.free)
        coordinates, rates = (
            value.astype(complex) for value in self.crank_coordinates(angle, states)
        )
        second = np.zeros(coordinates.shape)
        second[..., free] = accelerations[..., crank_dofs]
        moves = [(coordinates, number, number) for number in range(len(free) - 1)]  # but not θ
        moves += [(rates, number, shaft.dof_count + number) for number in range(len(free) - 1)]
        moves += [(rates, len(free) - 1, 2 * shaft.dof_count)]
        for perturbed, number, column in moves:
            perturbed[..., free[number]] += 1j * COMPLEX_STEP
            load = mechanism_motion(self.machine, coordinates, rates, second, gas).shaft_load
            perturbed[..., free[number]] -= 1j * COMPLEX_STEP
            tangent[..., crank_dofs, column] += load[..., free].imag / COMPLEX_STEP
