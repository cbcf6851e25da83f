"""The cosine series of the pressure in a box of air."""

import numpy as np

from ...base.constants import SPEED_OF_SOUND_M_PER_S
from ..arrays import Array
from .cutting import AirBox


def wavenumbers(length_m: float, nodes: int) -> Array:
    """Of the terms along one axis, n pi/L, rad/m, (term,)."""
    numbers: Array = np.pi * np.arange(nodes) / length_m
    return numbers


def inverse_norms(length_m: float, nodes: int) -> Array:
    """One over the integral of cos² of each term along one axis, 1/m, (term,)."""
    inverse = np.full(nodes, 2.0 / length_m)
    inverse[0] = 1.0 / length_m
    return inverse


def cosines(points_m: Array, length_m: float, nodes: int) -> Array:
    """Terms at points along one axis, counted from the box's lower end, (point, term)."""
    values: Array = np.cos(np.outer(points_m, wavenumbers(length_m, nodes)))
    return values


def slopes(points_m: Array, length_m: float, nodes: int) -> Array:
    """Derivatives of the terms along the axis, 1/m, (point, term)."""
    k = wavenumbers(length_m, nodes)
    values: Array = -k * np.sin(np.outer(points_m, k))
    return values


def angular_frequencies(box: AirBox) -> Array:
    """c |k| of all terms, rad/s, (x, y, z)."""
    kx, ky, kz = (wavenumbers(*of) for of in zip(box.size, box.nodes, strict=True))
    k = np.sqrt(kx[:, None, None] ** 2 + ky[:, None] ** 2 + kz**2)
    omega: Array = SPEED_OF_SOUND_M_PER_S * k
    return omega


def flux_gain(omega: Array, time_step_s: float) -> Array:
    """What a term takes of a flux at a wall: cos²(omega dt/2).

    With fluxes in the middle of the steps a term at resonance answers to its mean flux by
    omega/(2 tan(omega dt/2)/dt) sin(omega dt)/(omega dt) too much; this undoes it. It is the
    correction of k-Wave's sources (E. Wise, B. Treeby et al.), once for the flux and once for its
    mean over a step.
    """
    gain: Array = np.cos(omega * time_step_s / 2.0) ** 2
    return gain


def left_out(
    points_m: Array, length_m: float, nodes: int, time_step_s: float
) -> tuple[Array, Array]:
    """What a series lacks of the answer to a flux at its lower end, m; its derivative; (point,).

    Terms far above the frequencies of interest follow a flux at once: the pressure lacks
    P(x)/c dU/dt with P(x) = 2/L sum of cos(n pi x/L)/k² over n >= N, and what `flux_gain` takes
    from the terms that are kept. P(0) is the length of air that stands for them at the end.
    The sum over all n >= 1 of cos(n theta)/n² is pi²/6 - pi theta/2 + theta²/4.
    """
    numbers = np.arange(1, nodes)
    phase = np.pi * numbers / length_m * SPEED_OF_SOUND_M_PER_S * time_step_s / 2.0
    weight = ((phase / np.tan(phase)) ** 2) / numbers**2
    theta = np.pi * points_m / length_m
    total = np.pi**2 / 6.0 - np.pi * theta / 2.0 + theta**2 / 4.0
    even = (SPEED_OF_SOUND_M_PER_S * time_step_s / 2.0) ** 2 * 2.0 / 3.0 / length_m
    scale = 2.0 * length_m / np.pi**2
    values: Array = scale * (total - np.cos(np.outer(theta, numbers)) @ weight) + even
    slope = np.sin(np.outer(theta, numbers)) @ (weight * numbers) + (theta - np.pi) / 2.0
    slopes_: Array = scale * np.pi / length_m * slope
    return values, slopes_


def series_mass_m(length_m: float, nodes: int, time_step_s: float) -> float:
    """Length of air at the end of a series that stands for what it lacks, m."""
    values, _ = left_out(np.zeros(1), length_m, nodes, time_step_s)
    return float(values[0])
