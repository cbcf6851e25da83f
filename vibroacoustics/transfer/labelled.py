"""Motion of a study's machine on its mounts, labelled."""

from typing import Any, Final

import numpy as np
import xarray as xr

from ..base.arrays import Array, ComplexArray
from ..base.ellipse import semi_major_axis
from ..base.vocabulary import (
    AXES,
    REFERENCE_OPTION,
    RIGID_BODY_DOFS,
    check,
    stamp,
)
from ..machine.suspension import Suspension
from ..study.study import Study
from .feet import corners
from .machine import MachineOnMounts, Response, on_mounts

MOUNT_FREQUENCY_HZ: Final[Array] = np.asarray(np.geomspace(1.0, 200.0, 400), dtype=np.float64)

Labelled = dict[str, tuple[Any, dict[str, Any]]]
"""Values and coordinates of variables by name."""
_WRENCH: Final = ("force_order", "moment_order")
_DOFS: Final = {"dof": list(RIGID_BODY_DOFS)}


def housing_variables(study: Study, results: xr.Dataset) -> xr.Dataset:
    """Motion of the housing on its mounts and the forces into the feet.

    Every option moves on its own mounts; the natural modes are those of the machine as it is.
    """
    machines = {
        name: on_mounts(option.built_into(study.machine)) for name, option in study.options.items()
    }
    reference = machines[REFERENCE_OPTION]
    responses = _responses(list(machines.values()), results)
    foot_force = np.stack([response.foot_force for response in responses], axis=1)
    foot_force = np.moveaxis(foot_force, (-2, -1), (-3, -2))
    total = semi_major_axis(foot_force.sum(axis=2), axis=3)
    coords = {name: results[name] for name in ("speed", "option", "source", "order")}
    by_foot = {name: coords[name] for name in ("speed", "option", "order")}
    velocities = {"velocity_order": [response.velocity for response in responses]}
    if reference.suspension is not None:
        velocities["block_velocity_order"] = [response.block_velocity for response in responses]
    arrays: Labelled = _at_springs(machines, responses, results) | {
        name: (np.moveaxis(np.stack(velocity, axis=1), -1, -2), {**coords, **_DOFS})
        for name, velocity in velocities.items()
    }
    feet = {"foot": list(reference.stand.names)}
    arrays["foot_force_order"] = (foot_force, {**coords, **feet, "axis": list(AXES)})
    arrays["foot_force_amplitude"] = (total, {**by_foot, **feet})
    arrays["largest_foot_force"] = (total.max(axis=2), by_foot)
    arrays |= _of_mounts(reference) | _with_bodies(machines)
    return check(
        xr.Dataset(
            {
                name: stamp(name, values, coordinates)
                for name, (values, coordinates) in arrays.items()
            },
            coords={"foot_position": (("foot", "axis"), reference.foot_position)},
        )
    )


def _at_springs(
    machines: dict[str, MachineOnMounts], responses: list[Response], results: xr.Dataset
) -> Labelled:
    """Displacement of a suspended block at its springs; nothing without a suspension."""
    frequency = results["order_frequency"].transpose("speed", "order").values
    displacement = [
        spring_displacement(
            machine.suspension,
            response.velocity.sum(axis=1),
            response.block_velocity.sum(axis=1),
            frequency,
        )
        for machine, response in zip(machines.values(), responses, strict=True)
        if machine.suspension is not None
    ]
    if len(displacement) < len(machines):
        return {}
    coords = {"speed": results["speed"], "option": list(machines)}
    return {"spring_displacement": (np.stack(displacement, axis=1), coords)}


def _responses(machines: list[MachineOnMounts], results: xr.Dataset) -> list[Response]:
    """Responses of each option's machine, shapes (speed, source, order, ...).

    Options on equal mounts are solved at once.
    """
    parts = [results[name].transpose("option", ..., "order", "axis") for name in _WRENCH]
    loads = np.concatenate([part.values for part in parts], axis=-1)
    frequency = results["order_frequency"].values[:, None, :]
    by_row: dict[int, Response] = {}
    for machine in dict.fromkeys(machines):
        rows = [row for row, other in enumerate(machines) if other == machine]
        by_row |= zip(rows, machine.response(loads[rows], frequency).unstacked(), strict=True)
    return [by_row[row] for row in range(len(machines))]


def _of_mounts(machine: MachineOnMounts) -> Labelled:
    """Natural modes of a machine and what its mounts pass on, with coordinates."""
    frequencies, shapes = machine.natural_modes()
    mode = {"mode": [f"mode_{number}" for number in range(1, len(frequencies) + 1)]}
    return {
        "natural_frequency": (frequencies, mode),
        "mode_shape": (shapes, {**mode, "body": machine.labels, **_DOFS}),
        "mode_energy": (_energy(machine, shapes), {**mode, "body": machine.labels, **_DOFS}),
        "mount_transmissibility": (
            _transmissibility(machine),
            {"axis": list(AXES), "mount_frequency": MOUNT_FREQUENCY_HZ},
        ),
    }


def _with_bodies(machines: dict[str, MachineOnMounts]) -> Labelled:
    """Natural modes of options that attach bodies, by option; nothing where none does.

    What a machine does not have is NaN.
    """
    attaching = {name: body for name, body in machines.items() if body.attached.bodies}
    if not attaching:
        return {}
    bodies = list(dict.fromkeys(label for body in attaching.values() for label in body.labels))
    modes = 6 * max(len(body.labels) for body in attaching.values())
    hertz = np.full((len(machines), modes), np.nan)
    energy = np.full((len(machines), modes, len(bodies), 6), np.nan)
    passed_on = np.full((len(machines), 3, MOUNT_FREQUENCY_HZ.size), np.nan, dtype=complex)
    for row, machine in enumerate(machines.values()):
        if machine.attached.bodies:
            passed_on[row] = _transmissibility(machine)
            frequencies, shapes = machine.natural_modes()
            hertz[row, : len(frequencies)] = frequencies
            columns = [bodies.index(label) for label in machine.labels]
            energy[row, : len(frequencies), columns] = np.moveaxis(_energy(machine, shapes), 1, 0)
    mode = {"option_mode": [f"mode_{number}" for number in range(1, modes + 1)]}
    coords = {"option": list(machines), **mode}
    at_mounts = {"axis": list(AXES), "mount_frequency": MOUNT_FREQUENCY_HZ}
    return {
        "option_natural_frequency": (hertz, coords),
        "option_mount_transmissibility": (passed_on, {"option": list(machines), **at_mounts}),
        "option_mode_energy": (energy, {**coords, "option_body": bodies, **_DOFS}),
    }


def _energy(machine: MachineOnMounts, shapes: Array) -> Array:
    """Share of each motion in the kinetic energy φ (Mφ) of a mode, whose sum is one."""
    flat = shapes.reshape(len(shapes), -1)
    return (flat * (flat @ machine.isolation.mass_matrix)).reshape(shapes.shape)


def _transmissibility(machine: MachineOnMounts) -> ComplexArray:
    """Sum of the foot forces along an axis per force along it, shape (axis, frequency)."""
    unit = np.eye(6)[:3].astype(complex)
    force = machine.response(unit[:, None, :], MOUNT_FREQUENCY_HZ[None, :]).foot_force
    return np.stack([force[axis, :, :, axis].sum(axis=-1) for axis in range(3)])


STEPS: Final = 360
"""Instants of a revolution."""


def spring_displacement(
    suspension: Suspension, shell: ComplexArray, block: ComplexArray, frequency_hz: Array
) -> Array:
    """Return the largest displacement of the four springs over a revolution, shape (speed,), m.

    Parameters
    ----------
    suspension : suspension of the block
    shell, block : velocity of the centre of mass, complex peaks from order 0, shape (speed, order,
        6), m/s and rad/s
    frequency_hz : frequency of the orders, shape (speed, order)
    """
    low = suspension.springs_height_m
    motion = [
        _body_at_springs(velocity, suspension.springs.pitch_m, height, frequency_hz)
        for velocity, height in ((block, low), (shell, low + suspension.height_m))
    ]
    order = np.arange(1, shell.shape[1])
    turn = np.exp(2j * np.pi * np.arange(STEPS)[:, None] * order / STEPS)
    over_time = np.einsum("to,sofa->stfa", turn, motion[0] - motion[1]).real
    return np.asarray(np.linalg.norm(over_time, axis=-1).max(axis=(1, 2)))


def _body_at_springs(
    velocity: ComplexArray, pitch_m: float, height_m: float, frequency_hz: Array
) -> ComplexArray:
    """Displacement of a body at the springs, shape (speed, order from 1, spring, axis), m."""
    motion = velocity[:, 1:] / (2j * np.pi * frequency_hz[:, 1:, None])
    turned = np.cross(motion[..., None, 3:], corners(pitch_m, height_m))
    return np.asarray(motion[..., None, :3] + turned)
