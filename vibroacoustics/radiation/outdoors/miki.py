"""Impedance of porous ground from its flow resistivity."""

import numpy as np

from ..arrays import Array, ComplexArray


def normalised_impedance(frequency_hz: Array, flow_resistivity_pa_s_per_m2: float) -> ComplexArray:
    """Surface impedance of deep porous ground over that of air, time factor exp(+jωt).

    Z/(ρc) = 1 + 5.50 x^-0.632 - j 8.43 x^-0.632, x = 1000 f/σ (Miki, J. Acoust. Soc. Jpn. (E) 11
    (1990) 19, eq. 30 and 31 with the flow resistivity in SI).

    Parameters
    ----------
    frequency_hz : above zero, shape (...)
    flow_resistivity_pa_s_per_m2 : σ, effective for the ground
    """
    ratio = 1e3 * np.asarray(frequency_hz, dtype=float) / flow_resistivity_pa_s_per_m2
    return np.asarray(1.0 + (5.50 - 8.43j) * ratio**-0.632)
