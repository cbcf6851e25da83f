"""Motion of a study's machine on its mounts, labelled."""

from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array, ComplexArray
from ..base.vocabulary import (
    AXES,
    REFERENCE_OPTION,
    RIGID_BODY_DOFS,
    check,
    stamp,
)
from ..mechanics.ellipse import semi_major_axis
from ..study.study import Study
from .machine import on_mounts
from .mounts import FOOT_NAMES, RigidBodyOnMounts
from .suspended_block import SuspendedBlock

MOUNT_FREQUENCY_HZ: Final[Array] = np.asarray(np.geomspace(1.0, 200.0, 400), dtype=np.float64)


def housing_variables(study: Study, results: xr.Dataset) -> xr.Dataset:
    """Motion of the housing on its mounts and the forces into the feet.

    Every option moves on its own mounts; the natural modes are those of the machine as it is.
    """
    bodies = [on_mounts(option.applied_to(study.machine)) for option in study.options.values()]
    parts = [results[name].transpose("option", ..., "order", "axis") for name in _WRENCH]
    loads = np.concatenate([part.values for part in parts], axis=-1)
    frequency = results["order_frequency"].values[:, None, :]

    def response(name: str) -> ComplexArray:
        """Of each option's own body, shape (speed, option, source, order, ...)."""
        moved: dict[int, ComplexArray] = {}
        for body in dict.fromkeys(bodies):
            rows = [row for row, other in enumerate(bodies) if other == body]
            moved.update(zip(rows, getattr(body, name)(loads[rows], frequency), strict=True))
        return np.stack([moved[row] for row in range(len(bodies))], axis=1)

    body = bodies[list(study.options).index(REFERENCE_OPTION)]
    foot_force = np.moveaxis(response("foot_force"), (-2, -1), (-3, -2))
    frequencies, shapes = body.natural_modes()
    coords = {name: results[name] for name in ("speed", "option", "source", "order")}
    feet = {"foot": list(FOOT_NAMES), "axis": list(AXES)}
    modes = [f"mode_{number}" for number in range(1, len(frequencies) + 1)]
    ellipse = semi_major_axis(foot_force.sum(axis=2), axis=3)
    motions = {"velocity_order": "velocity"}
    if isinstance(body, SuspendedBlock):
        motions["block_velocity_order"] = "block_velocity"
    return check(
        xr.Dataset(
            {
                **{
                    name: stamp(
                        name,
                        np.moveaxis(response(motion), -1, -2),
                        {**coords, "dof": list(RIGID_BODY_DOFS)},
                    )
                    for name, motion in motions.items()
                },
                "foot_force_order": stamp("foot_force_order", foot_force, {**coords, **feet}),
                "foot_force_amplitude": stamp(
                    "foot_force_amplitude",
                    ellipse,
                    {
                        **{name: coords[name] for name in ("speed", "option", "order")},
                        "foot": feet["foot"],
                    },
                ),
                "natural_frequency": stamp("natural_frequency", frequencies, {"mode": modes}),
                "mode_shape": stamp(
                    "mode_shape",
                    shapes.reshape(len(modes), len(body.bodies), -1),
                    {"mode": modes, "body": list(body.bodies), "dof": list(RIGID_BODY_DOFS)},
                ),
                "mount_transmissibility": stamp(
                    "mount_transmissibility",
                    _transmissibility(body),
                    {"axis": list(AXES), "mount_frequency": MOUNT_FREQUENCY_HZ},
                ),
            },
            coords={"foot_position": (("foot", "axis"), body.foot_position)},
        )
    )


_WRENCH: Final = ("force_order", "moment_order")


def _transmissibility(body: RigidBodyOnMounts | SuspendedBlock) -> ComplexArray:
    """Sum of the foot forces along an axis per force along it, shape (axis, frequency)."""
    unit = np.eye(6)[:3].astype(complex)
    force = body.foot_force(unit[:, None, :], MOUNT_FREQUENCY_HZ[None, :])
    return np.stack([force[axis, :, :, axis].sum(axis=-1) for axis in range(3)])
