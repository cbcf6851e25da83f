"""Contact laws with hysteresis damping: F = K δ^1.5 (1 + β δ̇/δ̇₋), δ̇₋ the speed of approach."""

from collections.abc import Callable
from typing import Final

import numba
import numpy as np


def lankarani_nikravesh(restitution: float) -> float:
    """β = 3/4 (1 - e²) (Lankarani & Nikravesh 1990, J. Mech. Des. 112:369); for e near 1."""
    return 0.75 * (1.0 - restitution**2)


def flores(restitution: float) -> float:
    """β = 8 (1 - e)/(5 e) (Flores et al. 2011, Multibody Syst. Dyn. 25:357); for all e."""
    return 1.6 * (1.0 - restitution) / restitution


CONTACT_LAWS: Final[dict[str, Callable[[float], float]]] = {
    "lankarani-nikravesh": lankarani_nikravesh,
    "flores": flores,
}


@numba.njit(cache=True, nogil=True, error_model="numpy", inline="always")
def contact_force(depth: float, closing_ratio: float, stiffness: float, hysteresis: float) -> float:
    """Push of a face, N; never a pull.

    Parameters
    ----------
    depth : δ, m
    closing_ratio : δ̇/δ̇₋
    stiffness : K, N/m^1.5
    hysteresis : β
    """
    push = 1.0 + hysteresis * closing_ratio
    if depth <= 0.0 or push <= 0.0:
        return 0.0
    return float(stiffness * depth * np.sqrt(depth) * push)
