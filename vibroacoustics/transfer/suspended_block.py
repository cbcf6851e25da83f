"""A block on springs inside the shell, the shell on grommets: two-stage isolation."""

from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..machine.housing import Housing
from ..machine.mounts import Mounts
from ..machine.suspension import DischargeTube, Suspension
from .bushings import Bushing, RigidBody
from .isolation import Isolation
from .mounts import FOOT_NAMES, corners
from .tube import tube_stiffness

SHELL, BLOCK = "shell", "block"


@dataclass(frozen=True)
class SuspendedBlock:
    """Shell on four grommets, in it the block on four springs and the discharge tube.

    Motions are (tx, ty, tz, rx, ry, rz) of a centre of mass, m/s and rad/s; the load is force and
    moment on the block about its centre of mass, N and N m.

    Attributes
    ----------
    housing : mass and principal moments of inertia of the shell
    mounts : of the shell
    suspension : block, springs and tube
    foot_height_m : height of the grommets relative to the shell's centre of mass
    """

    housing: Housing
    mounts: Mounts
    suspension: Suspension
    foot_height_m: float

    bodies: ClassVar[tuple[str, ...]] = (SHELL, BLOCK)

    @cached_property
    def foot_position(self) -> Array:
        """Grommets in the order of FOOT_NAMES, shape (4, 3), m from the shell's centre of mass."""
        return corners(self.mounts.pitch_m, self.foot_height_m)

    @cached_property
    def isolation(self) -> Isolation:
        """The two bodies and their bushings; the frame's origin is the shell's centre of mass."""
        inside = self.suspension
        centre = np.array([0.0, 0.0, inside.height_m])
        springs = corners(inside.springs.pitch_m, inside.height_m + inside.springs_height_m)
        bushings = [
            *_corner_bushings("foot", self.mounts, self.foot_position, (SHELL, None)),
            *_corner_bushings("spring", inside.springs, springs, (BLOCK, SHELL)),
        ]
        if inside.discharge_tube is not None:
            bushings.append(_tube_bushing(inside.discharge_tube, centre))
        bodies = (
            _rigid_body(SHELL, self.housing, np.zeros(3)),
            _rigid_body(BLOCK, inside.block, centre),
        )
        return Isolation(bodies, tuple(bushings))

    def natural_modes(self) -> tuple[Array, Array]:
        """Undamped natural frequencies (12,) in Hz, mass-normalised shapes (mode, body, dof)."""
        return self.isolation.natural_modes()

    def velocity(self, load: ComplexArray, frequency_hz: Array) -> ComplexArray:
        """Velocity of the shell's centre of mass, shape (..., 6), m/s and rad/s, complex peak.

        Parameters
        ----------
        load : force and moment on the block about its centre of mass, shape (..., 6)
        frequency_hz : broadcasts against load[..., 0]
        """
        return self.isolation.velocity(_on_block(load), frequency_hz)[..., 0, :]

    def block_velocity(self, load: ComplexArray, frequency_hz: Array) -> ComplexArray:
        """Velocity of the block's centre of mass, as `velocity`."""
        return self.isolation.velocity(_on_block(load), frequency_hz)[..., 1, :]

    def foot_force(self, load: ComplexArray, frequency_hz: Array) -> ComplexArray:
        """Force of the machine on the floor at each foot, shape (..., foot, axis), N."""
        forces = self.isolation.bushing_force(_on_block(load), frequency_hz)
        return forces[..., : len(FOOT_NAMES), :3]


def _on_block(load: ComplexArray) -> ComplexArray:
    return np.stack([np.zeros_like(load), load], axis=-2)


def _rigid_body(name: str, body: Housing, centre_of_mass_m: Array) -> RigidBody:
    moments = (body.inertia_xx_kg_m2, body.inertia_yy_kg_m2, body.inertia_zz_kg_m2)
    return RigidBody(name, body.mass_kg, np.diag(moments), centre_of_mass_m)


def _corner_bushings(
    name: str, mounts: Mounts, places: Array, ends: tuple[str, str | None]
) -> list[Bushing]:
    lateral, vertical = mounts.lateral_stiffness_n_per_m, mounts.vertical_stiffness_n_per_m
    stiffness = np.diag([lateral, lateral, vertical, 0.0, 0.0, 0.0])
    loss = mounts.loss_factor_ratio
    return [
        Bushing(f"{name}_{corner}", *ends, place, stiffness, loss_factor_ratio=loss)
        for corner, place in zip(FOOT_NAMES, places, strict=True)
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
        "discharge_tube", BLOCK, SHELL, points[-1], stiffness,
        loss_factor_ratio=tube.loss_factor_ratio,
    )  # fmt: skip
