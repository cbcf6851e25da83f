"""Several machines on one rigid frame: all bodies and mounts in one matrix a frequency."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..mechanics.bushings import Bushing, RigidBody
from ..mechanics.loads import PortLoads
from ..mechanics.ports import HOUSING, BodyPort
from .feet import Stand
from .isolation import Isolation
from .machine import MachineOnMounts

FRAME = "base_frame"
"""Name of the frame among the bodies; those of a machine are NAME/BODY."""


@dataclass(frozen=True)
class Standing:
    """A machine on its mounts, and its axes among the common ones.

    Attributes
    ----------
    body : the machine on its mounts
    origin_m : centre of mass of its housing at rest, shape (3,)
    turn : its axes as columns, a rotation about the vertical, shape (3, 3)
    """

    body: MachineOnMounts
    origin_m: Array
    turn: Array


@dataclass(frozen=True)
class MachinesOnFrame:
    """Machines whose mounts end on one rigid frame with mounts of its own on a rigid floor.

    Attributes
    ----------
    frame : the frame, along the common axes
    mounts : between frame and floor, about its centre of mass
    machines : by name
    """

    frame: RigidBody
    mounts: Stand
    machines: Mapping[str, Standing]

    @cached_property
    def isolation(self) -> Isolation:
        """Assemble the frame, then the bodies of each machine, with all bushings."""
        centre = self.frame.centre_of_mass_m
        bodies = [self.frame]
        bushings = [_bushing(each, "", centre, np.eye(3)) for each in self.mounts.bushings(FRAME)]
        for name, machine in self.machines.items():
            inner, axes = machine.body.isolation, (machine.origin_m, machine.turn)
            bodies += [_body(body, f"{name}/", *axes) for body in inner.bodies]
            bushings += [_bushing(bushing, f"{name}/", *axes) for bushing in inner.bushings]
        return Isolation(tuple(bodies), tuple(bushings))

    def row(self, name: str, port: BodyPort = HOUSING) -> int:
        """Return the number of a machine's body among those of `isolation`."""
        names = [body.name for body in self.isolation.bodies]
        return names.index(f"{name}/{port.name}")

    def motion(self, name: str, loads: PortLoads, frequency_hz: Array) -> ComplexArray:
        """Compute the motion of all bodies under the loads on one machine's bodies.

        (K + jKη + jωC - ω²M)⁻¹ F with the matrices of all bodies, one solution a frequency.

        Parameters
        ----------
        name : name of the machine
        loads : complex peaks by port along its axes, shape (6, line); those in a shell are omitted
        frequency_hz : shape (line,)

        Returns
        -------
        complex peaks along the common axes, shape (line, body, 6), m and rad
        """
        turn = _both(self.machines[name].turn)
        load = np.zeros((frequency_hz.size, len(self.isolation.bodies), 6), dtype=complex)
        for port, amplitudes in loads.items():
            if isinstance(port, BodyPort):
                load[:, self.row(name, port)] += (turn @ amplitudes).T
        return self.isolation.displacement(load, frequency_hz)

    def housing_velocity(
        self, motion: ComplexArray, frequency_hz: Array
    ) -> dict[str, ComplexArray]:
        """Return the velocity of each machine's housing along its own axes, shape (line, 6).

        Parameters
        ----------
        motion : result of `motion`, shape (line, body, 6)
        frequency_hz : shape (line,)
        """
        velocity = 2j * np.pi * frequency_hz[:, None, None] * motion
        return {
            name: velocity[:, self.row(name)] @ _both(machine.turn)
            for name, machine in self.machines.items()
        }

    def floor_force(self, motion: ComplexArray, frequency_hz: Array) -> ComplexArray:
        """Return the force of the frame on the floor, shape (line, foot of the frame, 3), N.

        Parameters
        ----------
        motion : result of `motion`, shape (line, body, 6)
        frequency_hz : shape (line,)
        """
        force = self.isolation.bushing_force(motion, frequency_hz)
        return force[:, : len(self.mounts.names), :3]


def _body(body: RigidBody, prefix: str, origin_m: Array, turn: Array) -> RigidBody:
    inertia = turn @ body.inertia_kg_m2 @ turn.T
    centre_m = origin_m + turn @ body.centre_of_mass_m
    return RigidBody(f"{prefix}{body.name}", body.mass_kg, inertia, centre_m)


def _bushing(bushing: Bushing, prefix: str, origin_m: Array, turn: Array) -> Bushing:
    """Move a bushing to the common axes; one of a machine on the ground ends on the frame.

    Stiffness over frequency is alike along x and y, so that a turn about the vertical leaves it.
    """
    ground = FRAME if prefix else None
    other = ground if bushing.other_body is None else f"{prefix}{bushing.other_body}"
    return Bushing(
        f"{prefix}{bushing.name}", f"{prefix}{bushing.body}", other,
        origin_m + turn @ bushing.position_m, bushing.stiffness, bushing.damping,
        bushing.loss_factor_ratio, turn @ bushing.axes, bushing.over_frequency,
    )  # fmt: skip


def _both(turn: Array) -> Array:
    """Turn of displacements and rotations together, shape (6, 6)."""
    return np.asarray(np.kron(np.eye(2), turn), dtype=np.float64)
