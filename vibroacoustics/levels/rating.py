"""Rating level at windows: level, adjustments and operating time (TA Lärm, A.1.4; ISO 1996-1)."""

from collections.abc import Sequence

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.decibel import level_of_power, power_of_level
from ..base.vocabulary import stamped
from ..study.rating import Rating, Window
from ..study.rating_rule import RatingRules
from ..study.study import Study
from .axes import LevelAxes
from .sample_levels import Levels


def stepped_adjustment_db(audibility_db: Array, rules: RatingRules) -> Array:
    """Return the adjustment for tones K_T by the steps of rules, dB.

    Parameters
    ----------
    audibility_db : mean audibility, any shape, dB
    rules : with the largest audibility of each step
    """
    edges, steps = np.array(rules.tonal_steps).T
    every = np.append(steps, rules.largest_adjustment_db)
    return np.asarray(every[np.searchsorted(edges, audibility_db)])


def rating_level_db(level_db: Array, duration_s: Array, rating_time_s: float) -> Array:
    """Average the levels of parts of the rating time (TA Lärm 1998, A.1.4, equation G2).

    L_r = 10 lg(Σ T_j 10^(0.1 (L_Aeq,j + K_T,j + K_I,j + K_R,j)) / T_r), without the correction
    for the weather C_met, which lowers levels only far away.

    Parameters
    ----------
    level_db : level of each part, with its adjustments, shape (part, ...), dB
    duration_s : duration of each part, shape (part,), s
    rating_time_s : T_r, s

    Returns
    -------
    shape (...), dB
    """
    energy: Array = power_of_level(level_db).T @ (duration_s / rating_time_s)
    return np.asarray(level_of_power(energy).T)


def at_window(rating: Rating, window: Window, level_db: Array, adjustment_db: Array) -> Array:
    """Compute the rating level at a window, the shape of the levels, dB.

    Parameters
    ----------
    rating : rules, which give the rating time and the hours of raised sensitivity
    window : operating time
    level_db : A-weighted level of the running machine, shape (...), dB
    adjustment_db : K_T, shape (...), dB
    """
    rules = rating.applied
    raised = rules.sensitive_raise_db if window.area in rules.sensitive_areas else 0.0
    running_db = level_db + adjustment_db + window.impulse_adjustment_db
    durations = np.array([rating.operating_s(window) - window.sensitive_s, window.sensitive_s])
    parts = np.stack([running_db, running_db + raised])
    return rating_level_db(parts, durations, rules.rating_time_s[window.period])


def rating_levels(
    rating: Rating, receivers: Sequence[str], level_db: Array, audibility_db: Array
) -> dict[str, Array]:
    """Compute rating levels at all windows, and whether they meet the limits.

    Parameters
    ----------
    rating : windows and rules
    receivers : microphones in the order of the arrays
    level_db : A-weighted level of the machine, shape (..., receiver), dB
    audibility_db : decisive audibility of its tones, shape (..., receiver), dB

    Returns
    -------
    variables of the vocabulary, shape (..., window); `limit_probability` is 1 or 0
    """
    columns = [list(receivers).index(window.receiver) for window in rating.windows.values()]
    adjustment = stepped_adjustment_db(audibility_db, rating.applied)[..., columns]
    windows = rating.windows.values()
    levels = [
        at_window(rating, window, level_db[..., column], adjustment[..., number])
        for number, (window, column) in enumerate(zip(windows, columns, strict=True))
    ]
    level = np.stack(levels, axis=-1)
    limits = np.array([rating.limit_dba(window) for window in windows])
    return {
        "rating_level": level,
        "rating_adjustment": adjustment,
        "limit_probability": (level <= limits).astype(float),
    }


def rating_variables(rating: Rating, results: xr.Dataset) -> xr.Dataset:
    """Label rating levels and limits with the nominal values.

    Parameters
    ----------
    rating : windows and rules
    results : with `level_total` and `decisive_audibility`
    """
    dims = ("speed", "option", "receiver")
    level, audibility = (
        results[name].transpose(*dims).values for name in ("level_total", "decisive_audibility")
    )
    values = rating_levels(rating, results["receiver"].values.tolist(), level, audibility)
    limits = np.array([rating.limit_dba(window) for window in rating.windows.values()])
    coords = {name: results[name].values for name in ("speed", "option")}
    labels = {**coords, "rating_window": list(rating.windows)}
    return stamped({**values, "rating_limit": limits}, labels)


def sampled_rating(study: Study, axes: LevelAxes, levels: Levels) -> Levels:
    """Compute the rating levels of a sample; nothing of a study without windows.

    Parameters
    ----------
    study : windows and rules
    axes : microphones
    levels : levels of the sample, with the audibility of its tones
    """
    if study.rating is None:
        return {}
    audibility = levels["decisive_audibility"]
    return rating_levels(study.rating, axes.receivers, levels["level_total"], audibility)
