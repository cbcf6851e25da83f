"""Changes by options of what can be measured: 1x forces, the total level and the 1x line."""

from typing import Final, NamedTuple

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.arrays import Array
from ..base.decibel import amplitude_of_level, energy_sum, level_of_amplitude
from ..base.vocabulary import REFERENCE_OPTION, WEIGHTINGS, stamped
from ..base.weighting import WEIGHTING
from ..study.scoring import Measurable
from .hearing import hearing_threshold_db


def change_at(value: float, nodes: Array, change_db: Array) -> Array:
    """Interpolate the change of a level between nodes, linear in the value, shape (...), dB.

    Parameters
    ----------
    value : value of the parameter, between the first and the last node
    nodes : values at which the change is known, increasing, shape (node,)
    change_db : at the nodes, shape (node, ...)
    """
    upper = int(np.clip(np.searchsorted(nodes, value), 1, nodes.size - 1))
    share = (value - nodes[upper - 1]) / (nodes[upper] - nodes[upper - 1])
    return np.asarray((1.0 - share) * change_db[upper - 1] + share * change_db[upper])


def total_change(band_level_db: Array, change_db: Array) -> Array:
    """Compute the change of the total level from changes of its third octaves, shape (...), dB.

    Parameters
    ----------
    band_level_db : levels before the change, shape (..., band)
    change_db : sums of the changes by all parameters, shape (..., band)
    """
    after = energy_sum(band_level_db + change_db, axis=-1)
    return np.asarray(after - energy_sum(band_level_db, axis=-1))


FORCES: Final = ("force", "moment", "foot_force")
"""Amplitudes at 1x on the housing and, the largest, into a foot."""
TOTAL: Final = "level_total"
LINE: Final = "level_1x"
JUDGED: Final = (*FORCES, TOTAL, LINE)
MASKED_DB: Final = 15.0
"""A line so far below the total, both A-weighted, is not heard (assumed)."""
_LOWEST_HZ: Final = 20.0
"""Lowest frequency of the threshold of hearing; lower lines are compared with its level there."""


AMPLITUDES: Final = ("force_amplitude", "moment_amplitude", "largest_foot_force")
"""Variables of `FORCES` by order."""


class Changes(NamedTuple):
    """Changes of samples against no option.

    Attributes
    ----------
    force_db : change of `FORCES` at 1x, shape (force, sample, speed, option), dB
    increased, decreased : by what could be measured, of `JUDGED`, shape (sample, quantity, speed,
        option, receiver)
    """

    force_db: Array
    increased: Array
    decreased: Array


def change_db(amplitude: Array, reference: int) -> Array:
    """Compute the change of amplitudes (..., option) against an option, dB.

    Parameters
    ----------
    amplitude : amplitude, shape (..., option); values below `FORCE_FLOOR` count as that
    reference : number of the option
    """
    counted = np.maximum(amplitude, rounding.FORCE_FLOOR)
    return np.asarray(level_of_amplitude(counted / counted[..., [reference]]))


def changes_of(
    forces: Array,
    total_db: Array,
    line_db: Array,
    line_hz: Array,
    reference: int,
    least: Measurable,
) -> Changes:
    """Judge the changes of samples by what could be measured.

    A line rises only where it is heard afterwards, and falls only where it was heard before: above
    the threshold of hearing, and at most `MASKED_DB` below the total.

    Parameters
    ----------
    forces : amplitude of `FORCES` at 1x, shape (force, sample, speed, option), N or N m
    total_db : A-weighted, shape (sample, speed, option, receiver)
    line_db : level of the 1x line, unweighted, the same shape
    line_hz : its frequency, shape (speed,)
    reference : number of the option without a change
    least : smallest changes that could be measured
    """
    force_db = change_db(forces, reference)
    ratio = amplitude_of_level(force_db) - 1.0
    of_total = total_db - total_db[:, :, [reference]]
    counted = np.maximum(line_db, least.quietest_line_db)
    of_line = counted - counted[:, :, [reference]]
    audible = _is_audible(line_db, total_db, line_hz)
    before = np.broadcast_to(audible[:, :, [reference]], audible.shape)
    increased = [*(ratio > least.force_ratio), of_total > least.level_db]
    increased.append((of_line > least.level_db) & audible)
    decreased = [*(ratio < -least.force_ratio), of_total < -least.level_db]
    decreased.append((of_line < -least.level_db) & before)
    shape = total_db.shape
    return Changes(force_db, _by_sample(increased, shape), _by_sample(decreased, shape))


def _is_audible(line_db: Array, total_db: Array, line_hz: Array) -> Array:
    """Whether the line is heard, shape (sample, speed, option, receiver)."""
    hertz = np.maximum(line_hz, _LOWEST_HZ)
    threshold = np.array([hearing_threshold_db(frequency) for frequency in hertz.tolist()])
    weighted = line_db + WEIGHTING["A"](hertz)[:, None, None]
    return np.asarray((line_db >= threshold[:, None, None]) & (weighted >= total_db - MASKED_DB))


def _by_sample(judged: list[Array], shape: tuple[int, ...]) -> Array:
    """Stack judgements of all quantities, those of forces for every receiver."""
    parts = [np.broadcast_to(part if part.ndim == 4 else part[..., None], shape) for part in judged]
    return np.stack(parts, axis=1).astype(float)


def change_variables(least: Measurable, levels: xr.Dataset, forces: xr.Dataset) -> xr.Dataset:
    """Label the nominal changes of forces, and what changes by what could be measured: 1 or 0."""
    reference = levels["option"].values.tolist().index(REFERENCE_OPTION)
    first = [forces[name].sel(order=1).transpose("speed", "option").values for name in AMPLITUDES]
    changes = changes_of(
        np.array(first)[:, None],
        levels["level_total"].values[None],
        levels["order_level"].values[None, ..., 1, WEIGHTINGS.index("Z")],
        forces["order_frequency"].values[:, 1],
        reference,
        least,
    )
    coords = {name: levels[name].values for name in ("speed", "option", "receiver")}
    values = {
        f"{name}_change_1x": change[0]
        for name, change in zip(FORCES, changes.force_db, strict=True)
    }
    values |= {
        "increase_probability": changes.increased[0],
        "decrease_probability": changes.decreased[0],
    }
    return stamped(values, {**coords, "judged_quantity": list(JUDGED)})
