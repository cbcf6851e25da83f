"""What the sources of a scroll do to the shell's joints, over crank angle."""

from collections.abc import Sequence

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..machine.shell_structure import (
    BEARING_HOUSING,
    FIXED_SCROLL,
    JOINTS,
    STATOR,
)
from ..mechanics.loads import JOINT_COMPONENTS
from .induction_motor.torque_lines import TorqueLine
from .oldham_keys.rattle import KeyForces
from .scroll_gas.cycle import ScrollGasCycle


def gas_loads(cycle: ScrollGasCycle) -> Array:
    """Gas forces on the fixed scroll, and their reaction through pin and thrust face.

    The orbiting scroll passes its force on to the bearing housing; the moment about its own axis
    goes there through the keys and is theirs.

    Parameters
    ----------
    cycle : over uniform crank angles

    Returns
    -------
    shape (joint, component, samples), N and N m
    """
    force, (x, y) = cycle.on_fixed_scroll_n, cycle.line_of_action_m
    loads = np.zeros((len(JOINTS), JOINT_COMPONENTS, force.shape[-1]))
    loads[FIXED_SCROLL, :3] = force
    loads[FIXED_SCROLL, 3] = x * force[1] - y * force[0]
    loads[BEARING_HOUSING, :3] = -force
    return loads


def key_loads(forces: KeyForces, radius_m: float, stroke_m: float) -> Array:
    """Resultant of the keys on the bearing housing: x, y, moment about z, shape (3, samples).

    The forces in the scroll's slots come there through scroll, crank pin and main bearing; what
    they turn is the shaft, see `key_torque_n_m`. The housing's slots are loaded where the keys
    are, which move with the ring by r cos θ.

    Parameters
    ----------
    forces : in all four slots
    radius_m : of the keys
    stroke_m : r, of the ring
    """
    housing, scroll = forces.on_housing_slots_n, forces.on_scroll_slots_n
    push = housing.sum(axis=0) + scroll.sum(axis=0)
    turn = radius_m * (housing[0, 1] - housing[1, 1])
    turn += stroke_m * np.cos(forces.crank_angle) * housing[:, 1].sum(axis=0)
    return np.concatenate([push, turn[None]])


def key_torque_n_m(forces: KeyForces, stroke_m: float) -> Array:
    """Torque that the shaft needs against the keys, shape (samples,), N m.

    The scroll hands the keys' forces on to the crank pin, at r from the shaft's axis: the ring's
    inertia to and fro at twice the speed, and the friction of all keys.

    Parameters
    ----------
    forces : in all four slots
    stroke_m : r, the orbit radius
    """
    along_x, along_y = forces.on_scroll_slots_n.sum(axis=0)
    angle = forces.crank_angle
    return np.asarray(stroke_m * (along_x * np.sin(angle) - along_y * np.cos(angle)))


def stator_loads(lines: Sequence[TorqueLine]) -> tuple[ComplexArray, ComplexArray]:
    """Torque of the motor on the stator, and the roll moment on the whole machine, by line.

    Returns
    -------
    loads, roll_moment : complex peaks, shapes (joint, component, line) and (line,), N m
    """
    loads = np.zeros((len(JOINTS), JOINT_COMPONENTS, len(lines)), dtype=complex)
    loads[STATOR, 3] = [-line.motor_torque_n_m for line in lines]
    return loads, np.array([line.roll_moment_n_m for line in lines], dtype=complex)
