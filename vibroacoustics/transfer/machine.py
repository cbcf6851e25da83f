"""The machine on its mounts: one rigid body, or a block on springs in a shell."""

import numpy as np

from ..machine.machine import Machine
from ..mechanics.loads import Tone
from .mounts import RigidBodyOnMounts
from .suspended_block import SuspendedBlock


def on_mounts(machine: Machine) -> RigidBodyOnMounts | SuspendedBlock:
    """The bodies of a machine on mounts and springs."""
    foot_height = -machine.shell.centre_of_mass_height_m
    if machine.suspension is None:
        return RigidBodyOnMounts(machine.housing, machine.mounts, foot_height)
    return SuspendedBlock(machine.housing, machine.mounts, machine.suspension, foot_height)


def largest_foot_force_n(body: RigidBodyOnMounts | SuspendedBlock, tone: Tone) -> float:
    """Largest force into a foot by a tone's wrench on the rigid machine, peak, N."""
    force = body.foot_force(tone.rigid[None, :], np.array([tone.frequency_hz]))
    return float(np.max(np.linalg.norm(np.abs(force), axis=-1)))
