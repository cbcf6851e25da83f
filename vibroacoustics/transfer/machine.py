"""The machine on its mounts: one rigid body, or a block on springs in a shell."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Final

import numpy as np
from scipy.linalg import eigh
from scipy.optimize import brentq

from ..base.arrays import Array, ComplexArray
from ..base.errors import ParameterError
from ..machine.feet import FOOT_NAMES, Feet, Mounts, MountStiffness
from ..machine.floor import Floor, FloorMobility
from ..machine.housing import Housing
from ..machine.machine import Machine
from ..machine.suspension import BLOCK, DischargeTube, Suspension
from ..mechanics.bushings import NO_BODIES, AttachedBodies, Bushing, RigidBody
from ..mechanics.ports import HOUSING, BodyPort
from .feet import Stand, corners
from .isolation import Isolation
from .tube import tube_stiffness

MACHINE, SHELL = "machine", "shell"
"""Names of the body on the feet, without and with a block on springs in it."""
HIGHEST_MODE_HZ: Final = 1e5
"""Frequency above every natural frequency on the mounts alone."""
KEPT_MACHINES: Final = 64
"""Machines whose bushings are kept assembled: cases of a study share their mounts."""


@dataclass(frozen=True)
class Response:
    """Response of a body to a load, complex peaks.

    Attributes
    ----------
    velocity : velocity of the centre of mass of the body on the feet, which radiates; shape (...,
        6), m/s and rad/s
    block_velocity : velocity of the body with the mechanism, shape of `velocity`; equal without a
        suspension
    foot_force : force of the machine on the floor at each foot, shape (..., foot, axis), N
    """

    velocity: ComplexArray
    block_velocity: ComplexArray
    foot_force: ComplexArray

    def unstacked(self) -> "list[Response]":
        """Return the response to each of the loads along the first axis."""
        parts = (self.velocity, self.block_velocity, self.foot_force)
        return [Response(*each) for each in zip(*parts, strict=True)]


@dataclass(frozen=True)
class MachineOnMounts:
    """A machine on its mounts and the floor under them.

    With a suspension the mounts carry the shell, in it the block on four springs and the
    discharge tube; the mechanism loads the block. Without one, both are the same body.

    Attributes
    ----------
    housing : mass and principal moments of inertia of the body on the mounts
    mounts : stiffness of one mount, pitch of four in a square, loss factor
    foot_height_m : height of the mounts relative to that body's centre of mass
    suspension : block, springs and tube
    feet : anywhere, in place of four in a square
    mount_stiffness : stiffness of the mounts over frequency
    floor : compliant floor under the feet; rigid where there is none
    attached : further bodies, of an option
    """

    housing: Housing
    mounts: Mounts
    foot_height_m: float
    suspension: Suspension | None = None
    feet: Feet | None = None
    mount_stiffness: MountStiffness | None = None
    floor: Floor | FloorMobility | None = None
    attached: AttachedBodies = NO_BODIES

    @cached_property
    def stand(self) -> Stand:
        """Feet, mounts and floor."""
        return Stand(self.mounts, self.foot_height_m, self.feet, self.mount_stiffness, self.floor)

    @cached_property
    def foot_position(self) -> Array:
        """Mounts in the order of the feet's names, shape (foot, 3), m from the centre of mass."""
        return self.stand.position

    @cached_property
    def isolation(self) -> Isolation:
        """Bodies, that on the feet first, and bushings, the feet first.

        The frame's origin is the centre of mass of the body on the feet.
        """
        return self._isolation(with_floor=True)

    def _isolation(self, with_floor: bool) -> Isolation:
        name = HOUSING.name
        bodies = (_rigid_body(name, self.housing, np.zeros(3)),)
        all_of_it = AttachedBodies((), tuple(self.stand.bushings(name, with_floor)))
        if self.suspension is not None:
            all_of_it += _on_springs(self.suspension)
        all_of_it += self.attached
        return Isolation(bodies + all_of_it.bodies, all_of_it.bushings)

    @property
    def labels(self) -> list[str]:
        """Names of the bodies in results: the one on the feet is the shell round a block."""
        on_feet = MACHINE if self.suspension is None else SHELL
        return [on_feet, *(body.name for body in self.isolation.bodies[1:])]

    @property
    def mechanism_port(self) -> BodyPort:
        """Port of the mechanism, see `Machine`."""
        return HOUSING if self.suspension is None else BLOCK

    def row(self, port: BodyPort) -> int:
        """Find the body that a port loads among those of `isolation`.

        Raises
        ------
        ParameterError
            The machine has no such port.
        """
        names = [body.name for body in self.isolation.bodies]
        if port.name not in names:
            raise ParameterError(f"port {port.name}: the machine has none")
        return names.index(port.name)

    def natural_modes(self) -> tuple[Array, Array]:
        """Natural modes on a rigid floor, with the mounts' stiffness there, see
        `Isolation.natural_modes`."""
        if not self.stand.is_over_frequency:
            return self.isolation.natural_modes()
        isolation = self._isolation(with_floor=False)
        frequencies, shapes = modes_over_frequency(
            isolation.real_stiffness, isolation.mass_matrix, self._highest_mode_hz
        )
        return frequencies, shapes.reshape(-1, len(isolation.bodies), 6)

    @property
    def _highest_mode_hz(self) -> float:
        """Frequency above every natural frequency, also of bodies on stiff bushings."""
        return max(HIGHEST_MODE_HZ, 2.0 * float(self.isolation.natural_modes()[0][-1]))

    def response(
        self,
        load: ComplexArray,
        frequency_hz: Array | float,
        port: BodyPort | None = None,
    ) -> Response:
        """Motion and foot forces under a load on a body.

        Parameters
        ----------
        load : force and moment about the body's centre of mass, shape (..., 6), N and N m
        frequency_hz : at least zero, broadcasts against load[..., 0]
        port : port of the body; that with the mechanism where none is given
        """
        isolation, mechanism = self.isolation, self.mechanism_port
        loads = np.zeros((*np.shape(load)[:-1], len(isolation.bodies), 6), dtype=complex)
        loads[..., self.row(port or mechanism), :] = load
        motion = isolation.displacement(loads, frequency_hz)
        force = isolation.bushing_force(motion, frequency_hz)
        velocity = 2j * np.pi * np.asarray(frequency_hz, dtype=float)[..., None, None] * motion
        feet = force[..., : len(self.stand.names), :3]
        on_feet, in_block = self.row(HOUSING), self.row(mechanism)
        return Response(velocity[..., on_feet, :], velocity[..., in_block, :], feet)


def on_mounts(machine: Machine) -> MachineOnMounts:
    """The bodies of a machine on mounts and springs."""
    foot_height_m = -machine.shell.centre_of_mass_height_m
    return _kept(
        machine.housing, machine.mounts, foot_height_m, machine.suspension,
        machine.feet, machine.mount_stiffness, machine.floor or machine.floor_mobility,
        machine.attached,
    )  # fmt: skip


_kept = lru_cache(KEPT_MACHINES)(MachineOnMounts)


def _on_springs(suspension: Suspension) -> AttachedBodies:
    """The block on its springs and tube in the shell."""
    springs, centre = suspension.springs, np.array([0.0, 0.0, suspension.height_m])
    points = centre + corners(springs.pitch_m, suspension.springs_height_m)
    bushings = _corner_bushings("spring", springs, points, (BLOCK.name, HOUSING.name))
    if suspension.discharge_tube is not None:
        bushings.append(_tube_bushing(suspension.discharge_tube, centre))
    return AttachedBodies((_rigid_body(BLOCK.name, suspension.block, centre),), tuple(bushings))


def _rigid_body(name: str, body: Housing, centre_of_mass_m: Array) -> RigidBody:
    moments = (body.inertia_xx_kg_m2, body.inertia_yy_kg_m2, body.inertia_zz_kg_m2)
    return RigidBody(name, body.mass_kg, np.diag(moments), centre_of_mass_m)


def _corner_bushings(
    name: str, mounts: Mounts, position_m: Array, ends: tuple[str, str]
) -> list[Bushing]:
    lateral, vertical = mounts.lateral_stiffness_n_per_m, mounts.vertical_stiffness_n_per_m
    stiffness = np.diag([lateral, lateral, vertical, 0.0, 0.0, 0.0])
    loss = mounts.loss_factor_ratio
    return [
        Bushing(f"{name}_{corner}", *ends, point, stiffness, loss_factor_ratio=loss)
        for corner, point in zip(FOOT_NAMES, position_m, strict=True)
    ]


def _tube_bushing(tube: DischargeTube, block_centre_m: Array) -> Bushing:
    points = block_centre_m + np.array([tube.x_m, tube.y_m, tube.z_m]).T
    stiffness = tube_stiffness(
        points,
        tube.outer_diameter_m,
        tube.inner_diameter_m,
        tube.youngs_modulus_pa,
        tube.poisson_ratio,
    )
    return Bushing(
        "discharge_tube", BLOCK.name, HOUSING.name, points[-1], stiffness,
        loss_factor_ratio=tube.loss_factor_ratio,
    )  # fmt: skip


TOLERANCE_HZ: Final = 1e-9


def modes_over_frequency(
    stiffness: Callable[[float], Array], mass: Array, stiffest_hz: float
) -> tuple[Array, Array]:
    """Undamped natural frequencies, Hz, and mass-normalised shapes, one a row.

    Mode n is where the n-th natural frequency of the stiffness at a frequency is that frequency.

    Parameters
    ----------
    stiffness : real part at a frequency in Hz, symmetric
    mass : mass matrix, symmetric, positive definite, shape (n, n)
    stiffest_hz : frequency that no natural frequency exceeds
    """

    def natural_hz(hertz: float) -> tuple[Array, Array]:
        squares, shapes = eigh(stiffness(hertz), mass)
        return np.sqrt(np.maximum(squares, 0.0)) / (2.0 * np.pi), shapes

    frequencies, rows = [], []
    for mode in range(len(mass)):
        meets = brentq(
            lambda hertz, mode=mode: natural_hz(hertz)[0][mode] - hertz,
            0.0, stiffest_hz, xtol=TOLERANCE_HZ,
        )  # fmt: skip
        at_mode = natural_hz(meets)
        frequencies.append(at_mode[0][mode])
        rows.append(at_mode[1][:, mode])
    return np.array(frequencies), np.array(rows)
