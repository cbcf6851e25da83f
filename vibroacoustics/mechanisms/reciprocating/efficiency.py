"""Mechanical efficiency of a reciprocating compressor over its bore, and the best bore."""

from collections.abc import Sequence

import numpy as np
from scipy.optimize import minimize_scalar

from ...base.arrays import Array
from ...base.errors import ParameterError
from .cycle import SAMPLES, steady_cycle
from .parameters import ReciprocatingTables


def efficiency_map(
    machine: ReciprocatingTables,
    speed_rpm: Sequence[float] | Array,
    bore_m: Sequence[float] | Array,
    samples: int = SAMPLES,
) -> Array:
    """Mechanical efficiency at constant displacement (Tsuji et al. 2012, figure 5c).

    Parameters
    ----------
    machine : masses in kg, lengths in m, pressures in Pa
    speed_rpm : mean over time
    bore_m : of the designs
    samples : crank angles of a revolution

    Returns
    -------
    shape (speeds, bores)
    """
    return np.array(
        [
            [
                steady_cycle(machine, float(bore), float(speed), samples).mechanical_efficiency
                for bore in bore_m
            ]
            for speed in speed_rpm
        ]
    )


def optimum_bore(
    machine: ReciprocatingTables,
    speed_rpm: float,
    lowest_m: float,
    highest_m: float,
    samples: int = SAMPLES,
) -> tuple[float, float]:
    """Bore of the best efficiency at constant displacement (Tsuji et al. 2012, figure 6).

    Parameters
    ----------
    machine : masses in kg, lengths in m, pressures in Pa
    speed_rpm : mean over time
    lowest_m, highest_m : bores between which it is looked for
    samples : crank angles of a revolution

    Returns
    -------
    bore, efficiency : m and ratio

    Raises
    ------
    ParameterError
        The range is empty or the best bore lies on an end of it.
    """
    where = f"bore_mm from {1e3 * lowest_m:g} to {1e3 * highest_m:g} mm"
    if not 0.0 < lowest_m < highest_m < np.inf:
        raise ParameterError(f"{where}: must be two rising, positive lengths")
    optimum = minimize_scalar(
        lambda bore: -steady_cycle(machine, float(bore), speed_rpm, samples).mechanical_efficiency,
        bounds=(lowest_m, highest_m),
        method="bounded",
        options={"xatol": 1e-5},
    )
    if min(optimum.x - lowest_m, highest_m - optimum.x) < 1e-4:
        raise ParameterError(f"{where}: holds no optimum bore")
    return float(optimum.x), -float(optimum.fun)
