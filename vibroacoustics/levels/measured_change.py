"""A measured sound changed by what a model says: new = measured - modelled + modelled, changed."""

import numpy as np

from ..base.arrays import Array, ComplexArray


def left_of_squares(measured: Array, modelled: Array) -> Array:
    """Mean square that a model leaves of a measured one, Pa²; nothing where it is louder.

    Parameters
    ----------
    measured, modelled : mean squares, of any one shape
    """
    return np.maximum(measured - modelled, 0.0)


def changed_orders(
    measured: ComplexArray, before: ComplexArray, after: ComplexArray, factor: Array, phase: Array
) -> Array:
    """Mean squares of orders after a change, shape (option, order), Pa².

    Where the phase was measured M - P0 + P1 as complex peaks, else as energies. What the model
    leaves passes the option's insertion loss.

    Parameters
    ----------
    measured : M, complex peaks; amplitudes where there is no phase, shape (order,)
    before : P0, modelled without an option, shape (order,)
    after : P1, modelled with each option, shape (option, order)
    factor : amplitude with each option's insertion loss over that without, (option, order)
    phase : whether the phase was measured, shape (order,)
    """
    by_phase = 0.5 * np.abs((measured - before) * factor + after) ** 2
    unmodelled = left_of_squares(0.5 * np.abs(measured) ** 2, 0.5 * np.abs(before) ** 2)
    by_energy = unmodelled * factor**2 + 0.5 * np.abs(after) ** 2
    return np.where(phase, by_phase, by_energy)
