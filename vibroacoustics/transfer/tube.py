"""Stiffness of a bent tube or rod between its two ends, such as a discharge tube."""

from itertools import pairwise

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..base.errors import ParameterError
from ..mechanics.bushings import motion_at


def tube_stiffness(
    path_m: Array,
    outer_diameter_m: float,
    inner_diameter_m: float,
    youngs_modulus_pa: float,
    poisson_ratio: float,
) -> Array:
    """Stiffness of a clamped tube at the end of its path, shape (6, 6), N/m, N and N m.

    Unit-load method (Castigliano): the flexibilities of straight pieces in tension, torsion and
    bending (Euler-Bernoulli, without shear) add up, each moved to the end. The tube has no mass,
    hence holds below its own first resonance. Axes are those of the path.

    Parameters
    ----------
    path_m : points of the centre line, from one body to the other, shape (points, 3), points >= 2
    outer_diameter_m, inner_diameter_m : diameters of the tube; inner zero for a rod
    youngs_modulus_pa : Young's modulus
    poisson_ratio : Poisson's ratio

    Raises
    ------
    ParameterError
        A dimension or constant is outside its range, or two points of the path coincide.
    """
    _check_tube(outer_diameter_m, inner_diameter_m, youngs_modulus_pa, poisson_ratio)
    path = np.asarray(path_m, dtype=float)
    if path.ndim != 2 or path.shape[0] < 2 or path.shape[1] != 3 or not np.all(np.isfinite(path)):
        raise ParameterError(f"path_m: must be of shape (2 or more, 3), got {path.shape}")
    area = np.pi / 4.0 * (outer_diameter_m**2 - inner_diameter_m**2)
    second_moment = np.pi / 64.0 * (outer_diameter_m**4 - inner_diameter_m**4)
    rigidity = youngs_modulus_pa * np.array([area, second_moment])
    flexibility = np.zeros((6, 6))
    for start, end in pairwise(path):
        flexibility += _piece_flexibility(start, end, path[-1], rigidity, poisson_ratio)
    stiffness = np.linalg.inv(flexibility)
    return np.asarray(0.5 * (stiffness + stiffness.T))


def _check_tube(
    outer_diameter_m: float, inner_diameter_m: float, youngs_modulus_pa: float, poisson_ratio: float
) -> None:
    if not 1e-5 <= outer_diameter_m <= 1.0:
        raise ParameterError(
            f"outer_diameter_m = {outer_diameter_m:g} m: allowed from 1e-05 to 1 m"
        )
    if not 0.0 <= inner_diameter_m <= 0.999 * outer_diameter_m:
        raise ParameterError(
            f"inner_diameter_m = {inner_diameter_m:g} m: allowed from 0 to 0.999 of "
            f"outer_diameter_m = {outer_diameter_m:g} m"
        )
    if not (youngs_modulus_pa > 0.0 and -1.0 < poisson_ratio <= 0.5):
        raise ParameterError(
            f"youngs_modulus_pa = {youngs_modulus_pa:g} Pa, poisson_ratio = {poisson_ratio:g}: "
            "allowed above 0 Pa, above -1 to 0.5"
        )


def _piece_flexibility(
    start: Array, end: Array, reference: Array, rigidity: Array, poisson_ratio: float
) -> Array:
    """Flexibility of one straight piece, moved to the reference point, shape (6, 6)."""
    length = float(np.linalg.norm(end - start))
    if length == 0.0:
        raise ParameterError("path_m: two points of the path coincide")
    tangent = (end - start) / length
    along = np.outer(tangent, tangent)
    across = np.eye(3) - along
    axial, bending = rigidity
    # About its middle, force and moment do not couple; bending there leaves L³/(12 EI).
    middle = np.zeros((6, 6))
    middle[:3, :3] = length / axial * along + length**3 / (12.0 * bending) * across
    middle[3:, 3:] = length / bending * ((1.0 + poisson_ratio) * along + across)
    displacement = motion_at(reference, 0.5 * (start + end))
    return np.asarray(displacement @ middle @ displacement.T)


def tube_end_reactions(
    path_m: Array,
    force_n: ComplexArray,
    stiffness: Array,
    outer_diameter_m: float,
    inner_diameter_m: float,
    youngs_modulus_pa: float,
    poisson_ratio: float,
) -> tuple[ComplexArray, ComplexArray]:
    """Return the reactions at both ends of a clamped tube without mass to forces at its points.

    The far end, freed, would move by the flexibility of the pieces up to each loaded point; its
    clamp takes the force that this motion needs, the near end the rest.

    Parameters
    ----------
    path_m : points of the centre line, shape (points, 3)
    force_n : at each point, shape (points, 3, line)
    stiffness : stiffness of the far end, see `tube_stiffness`
    outer_diameter_m, inner_diameter_m, youngs_modulus_pa, poisson_ratio : see `tube_stiffness`

    Returns
    -------
    near, far : wrench on the body at either end about the last point, shape (6, line)
    """
    area = np.pi / 4.0 * (outer_diameter_m**2 - inner_diameter_m**2)
    second_moment = np.pi / 64.0 * (outer_diameter_m**4 - inner_diameter_m**4)
    rigidity = youngs_modulus_pa * np.array([area, second_moment])
    flexibility, free = np.zeros((6, 6)), np.zeros((6, force_n.shape[-1]), dtype=complex)
    total = np.zeros_like(free)
    for number, force in enumerate(force_n):
        if number:
            piece = path_m[number - 1], path_m[number], path_m[-1]
            flexibility += _piece_flexibility(*piece, rigidity, poisson_ratio)
        arm = path_m[number] - path_m[-1]
        wrench = np.concatenate([force, np.cross(arm[:, None], force, axis=0)])
        free += flexibility @ wrench
        total += wrench
    far = stiffness @ free
    return total - far, far
