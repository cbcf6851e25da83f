"""Balance quality grade that remains (ISO 21940-11)."""

from typing import Final, NamedTuple

import numpy as np

from ...base.arrays import Array
from ...base.quantiles import INTERVAL
from ...mechanics.balancing.moments import least_squares_moments
from .balanced_runs import BalancedRuns

GRADES_MM_PER_S: Final = (0.4, 1.0, 2.5, 6.3, 16.0, 40.0, 100.0, 250.0, 630.0, 1600.0, 4000.0)


class Grade(NamedTuple):
    """Product of eccentricity and angular speed, mm/s.

    Attributes
    ----------
    before : with the weights that stay in
    after : with the weights to add
    low, high : ends of the 80 % band of after; not a number where the scatter is unknown
    """

    before: float
    after: float
    low: float
    high: float


def grade_mm_per_s(moment_kg_m: Array, mass_kg: float, speed_rpm: float) -> Array:
    """Return G = e ω of residual unbalances, mm/s, of the shape of the moments.

    ISO 21940-11:2016, section 6: e = U/m, of the sum over the planes.

    Parameters
    ----------
    moment_kg_m : residual unbalance, any shape
    mass_kg : mass of the rotor
    speed_rpm : service speed
    """
    return np.asarray(1e3 * moment_kg_m / mass_kg * speed_rpm * np.pi / 30.0)


def grade_of(result: BalancedRuns) -> Grade | None:
    """Return the grade before and after; None where the mass of the rotor is not known.

    Parameters
    ----------
    result : answer for runs
    """
    rotor = result.settings.rotor
    if rotor.mass_kg is None:
        return None
    speed = rotor.service_speed_rpm or float(result.runs.speeds_rpm.max())
    response, influence = result.problem.weighted
    free = least_squares_moments(response[None], influence[None])  # whatever the planes hold
    sampled = np.abs(result.moment_samples - result.moment_kg_m).sum(axis=1)
    low, median, high = np.quantile(sampled, INTERVAL)
    after = np.abs(free - result.moment_kg_m).sum() if np.isnan(median) else median
    moments = np.array([np.abs(free).sum(), after, low, high])
    return Grade(*grade_mm_per_s(moments, rotor.mass_kg, speed).tolist())


def grade_name(value_mm_per_s: float) -> str:
    """Name of the smallest grade that a value meets, such as `G 2.5`.

    Parameters
    ----------
    value_mm_per_s : eccentricity times angular speed
    """
    names = [each for each in GRADES_MM_PER_S if value_mm_per_s <= each]
    return f"G {names[0]:g}" if names else "no grade"
