"""Levels, shares and phases of transfer paths: statistics of the weighted samples, labelled."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ..base.arrays import Array
from ..base.quantiles import INTERVAL, weighted_quantiles
from ..base.vocabulary import HIGH, LOW, SUFFIXES, stamped
from ..levels.axes import LevelAxes
from ..levels.contributions import Row
from ..levels.labelled import level
from ..mechanics.contributions import PathName

SILENT: Final = 1e-12
"""Share of the largest mean square, 120 dB below it: a smaller sum is near rounding and has no
shares."""


def path_variables(
    axes: LevelAxes,
    orders: Sequence[int],
    samples: Sequence[Sequence[Row]],
    counts: Sequence[int] | None = None,
) -> xr.Dataset:
    """Label levels of the paths, medians over samples, and means of their shares and phases.

    The shares of a sample add up to one, and so do their means. The phase of a path to the sum is
    a cosine, Re{p Σp*}/|p||Σp| of a line, weighted by energy over several lines.

    Parameters
    ----------
    axes : axes of the levels
    orders : orders that the energies hold
    samples : rows of each sample, one for each of its discrepancies; one of the nominal values
    counts : how many times each sample counts; None with the nominal values
    """
    rows = [row for of_sample in samples for row in of_sample]
    weight = np.repeat(counts or 1.0, [len(of_sample) for of_sample in samples])
    weight = weight / weight.sum()
    every = [case for row in rows for case in row.values()]
    names = list(dict.fromkeys(name for case in every for name in case.names))
    motions = list(dict.fromkeys(name for case in every for name in case.motions))
    of_speeds = []
    for speed in rows[0]:
        cases = [row[speed] for row in rows]
        paths = _gathered([case.path for case in cases], [case.names for case in cases], names)
        moving = _gathered(
            [case.motion for case in cases], [case.motions for case in cases], motions
        )
        of_speeds.append(_of_paths(paths, weight, len(axes.bands)) | _of_motions(moving, weight))
    values = {name: np.stack([each[name] for each in of_speeds]) for name in of_speeds[0]}
    if counts is None:
        values = {name: array for name, array in values.items() if name not in _ENDS}
    coords = {
        "receiver": list(axes.receivers),
        "path_speed": [*rows[0]],
        "path": [f"{name.source}: {name.port} {name.direction}" for name in names],
        "path_order": [float(order) for order in orders],
        "radiating_motion": motions,
        "band": [band.nominal_hz for band in axes.bands],
    }
    of_paths = {
        f"path_{part}": ("path", [getattr(name, part) for name in names])
        for part in PathName._fields
    }
    return stamped(values, coords).assign_coords(of_paths)


_ENDS: Final = tuple(f"path_share{SUFFIXES[end]}" for end in (LOW, HIGH))


def _gathered(
    energies: Sequence[Array], names: Sequence[Sequence[object]], every: Sequence[object]
) -> Array:
    """Energies of all samples, zero where one lacks a path, (2, sample, path, receiver, ...)."""
    gathered = np.zeros((2, len(energies), len(every), *energies[0].shape[2:]), dtype="f4")
    for number, (energy, of_sample) in enumerate(zip(energies, names, strict=True)):
        gathered[:, number, [every.index(name) for name in of_sample]] = energy
    return gathered


def _of_paths(energy: Array, weight: Array, bands: int) -> dict[str, Array]:
    """Statistics of paths, shape (path, receiver, ...), in bands, in all and by order."""
    alone, part = energy
    total = part.sum(axis=1, keepdims=True)
    sounds = _sounds(total)
    share = _ratio(part, total, sounds)
    cosine = np.clip(_ratio(part, np.sqrt(alone * np.maximum(total, 0.0)), sounds), -1.0, 1.0)
    (level_db,) = weighted_quantiles(level(alone), weight, [0.5])
    (total_db,) = weighted_quantiles(level(np.maximum(total[:, 0], 0.0)), weight, [0.5])
    values = {"modelled_band_level": total_db[..., :bands]}
    low, _, high = weighted_quantiles(share[..., bands], weight, INTERVAL)
    values |= dict(zip(_ENDS, (low, high), strict=True))
    means = {"share": _mean(share, sounds, weight), "cosine": _mean(cosine, sounds, weight)}
    for name, each in {"level": level_db, **means}.items():
        values[f"path_{name}"] = each[..., bands]
        values[f"path_order_{name}"] = each[..., bands + 1 :]
    values |= {"path_band_level": level_db[..., :bands]}
    return values | {"path_band_share": means["share"][..., :bands]}


def _of_motions(energy: Array, weight: Array) -> dict[str, Array]:
    """Median levels of motions and means of their shares, shape (motion, receiver)."""
    alone, part = energy
    total = part.sum(axis=1, keepdims=True)
    (level_db,) = weighted_quantiles(level(alone), weight, [0.5])
    share = _mean(_ratio(part, total, _sounds(total)), _sounds(total), weight)
    return {"motion_level": level_db, "motion_share": share}


def _sounds(total: Array) -> NDArray[np.bool_]:
    """Whether a sum is not silent beside the loudest one."""
    return np.asarray(total > SILENT * total.max(initial=0.0))


def _ratio(part: Array, total: Array, sounds: NDArray[np.bool_]) -> Array:
    """Parts over a total; none of what is silent."""
    return np.asarray(part / np.where(sounds & (total > 0.0), total, np.inf))


def _mean(values: Array, sounds: NDArray[np.bool_], weight: Array) -> Array:
    """Mean over the samples whose sum sounds, along the first axis; 0 without one."""
    counting = np.tensordot(weight, sounds, axes=1)
    return np.asarray(
        np.tensordot(weight, values, axes=1) / np.where(counting > 0.0, counting, 1.0)
    )
