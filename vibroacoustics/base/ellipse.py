"""Ellipse that the tip of a vector follows at an order."""

import numpy as np

from .arrays import Array, ComplexArray


def semi_major_axis(phasor: ComplexArray, axis: int) -> Array:
    """Largest magnitude that Re{X e^{jωt}} reaches in a period, peak.

    a² = (|X|² + |X·X|) / 2 with X·X = Σ X_i² (the vector of a linear oscillation has
    |X·X| = |X|², that of a circular one 0).

    Parameters
    ----------
    phasor : complex peak components along `axis`, shape (...), any unit
    axis : the axis of the components; it is removed

    Returns
    -------
    real, in the phasor's unit
    """
    squares = np.sum(np.abs(phasor) ** 2, axis=axis)
    return np.asarray(np.sqrt((squares + np.abs(np.sum(phasor**2, axis=axis))) / 2.0))
