"""A machine on its mounts as matrices that are linear in stiffness and loss of the mounts."""

from typing import Any, NamedTuple

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..machine.machine import Machine
from ..transfer import MachineOnMounts, on_mounts


class MountMatrices(NamedTuple):
    """Dynamic stiffness at ω: k_l L + k_v V + R + j(η (k_l L + k_v V) + S + ωC) - ω²M.

    Attributes
    ----------
    mass, lateral, vertical, elastic, elastic_loss, damping : M, L, V, R, S and C of all bodies, the
        body on the feet first, shape (6 bodies, 6 bodies)
    values : k_l and k_v of one mount, N/m, and its loss factor η
    mechanism : first row of the body with the mechanism
    """

    mass: Array
    lateral: Array
    vertical: Array
    elastic: Array
    elastic_loss: Array
    damping: Array
    values: tuple[float, float, float]
    mechanism: int


def is_over_frequency(machine: MachineOnMounts) -> bool:
    """Whether the mounts depend on frequency or the floor is compliant."""
    return machine.stand.is_over_frequency or machine.floor is not None


def stiffness_over_frequency(machine: MachineOnMounts, frequency_hz: Array) -> ComplexArray:
    """Stiffness of the body on the feet, with losses, as rows of its lower triangle.

    Parameters
    ----------
    machine : on its mounts
    frequency_hz : shape (line,)

    Returns
    -------
    shape (line, 21)
    """
    rows, columns = np.tril_indices(6)
    return machine.isolation.complex_stiffness(frequency_hz)[..., rows, columns]


def mount_matrices(machine: Machine) -> MountMatrices:
    """Matrices of a machine; where they change with frequency, those of constant stiffness."""
    stand = on_mounts(machine)
    mounts = machine.mounts
    values = (
        mounts.lateral_stiffness_n_per_m,
        mounts.vertical_stiffness_n_per_m,
        mounts.loss_factor_ratio,
    )
    stiffness = stand.isolation.stiffness_matrix
    lateral = (_stiffness(machine, "lateral") - stiffness) / values[0]
    vertical = (_stiffness(machine, "vertical") - stiffness) / values[1]
    of_mounts = values[0] * lateral + values[1] * vertical
    return MountMatrices(
        stand.isolation.mass_matrix,
        lateral,
        vertical,
        stiffness - of_mounts,
        stand.isolation.structural_damping_matrix - values[2] * of_mounts,
        stand.isolation.damping_matrix,
        values,
        6 * stand.row(stand.mechanism_port),
    )


def put_matrices(matrices: MountMatrices) -> dict[str, Any]:
    """The matrices as the page holds them, in full precision as they are few."""
    return {
        "size": len(matrices.mass),
        "values": matrices.values,
        "mechanism": matrices.mechanism,
        **{name: getattr(matrices, name).ravel().tolist() for name in matrices._fields[:-2]},
    }


def _stiffness(machine: Machine, along: str) -> Array:
    """Stiffness matrix with mounts twice as stiff along one direction, (6 bodies, 6 bodies)."""
    field = f"{along}_stiffness_n_per_m"
    mounts = machine.mounts.model_copy(update={field: 2.0 * getattr(machine.mounts, field)})
    twice = on_mounts(machine.model_copy(update={"mounts": mounts}))
    return np.asarray(twice.isolation.stiffness_matrix)
