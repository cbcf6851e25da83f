"""Levels and shares of the paths of sound, labelled."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.decibel import SILENCE_DB, amplitude_of_level, level_shift, sound_pressure_level
from ..base.vocabulary import stamped
from ..machine.source import CaseKey
from ..mechanics.contributions import Contributions, PathName
from .axes import LevelAxes
from .bands import Band
from .by_source import gain_band_number, membership, weighting_power
from .labelled import level

MEDIANS: Final = ("order_level", "sources_band_level", "level_modelled")
"""Levels of all samples that the sums of the paths get."""
SILENT: Final = 1e-12
"""Share of the largest mean square, 120 dB below it: a smaller sum is near rounding and has no
shares."""


def with_gain(split: Contributions, gain: Array) -> Contributions:
    """Return the contributions with the gains of a discrepancy.

    Parameters
    ----------
    split : contributions of a case
    gain : factors on the power, shape (source, receiver, gain band)
    """
    root = np.sqrt(gain)[..., gain_band_number(split.frequency_hz)]
    number = [split.sources.index(name.source) for name in split.names]
    noise = []
    for part in split.noise:
        sources = [number[row] for row in part.rows]
        factor = gain[sources][..., gain_band_number(part.frequency_hz)]
        noise.append(replace(part, alone=factor * part.alone, part=factor * part.part))
    return replace(
        split,
        pressure=root[number] * split.pressure,
        noise=tuple(noise),
        by_motion=root * split.by_motion,
    )


def energies(split: Contributions, bands: Sequence[Band]) -> tuple[Array, Array]:
    """Mean squares of each path alone and what each adds to the sum of all.

    Lines add as phasors: a path p adds ½ Re{p Σp*} to the mean square of a line, which is negative
    where it works against the others; lines of different frequencies add as energy.

    Returns
    -------
    alone, part : shape (path, receiver, band + 1), Pa²; unweighted by band, A-weighted in all last
    """
    pressure = split.pressure
    of_lines = _columns(split.frequency_hz, bands)
    alone = 0.5 * np.abs(pressure) ** 2 @ of_lines
    part = 0.5 * (pressure * pressure.sum(axis=0).conj()).real @ of_lines
    for noise in split.noise:
        of_noise = _columns(noise.frequency_hz, bands)
        alone[list(noise.rows)] += noise.alone @ of_noise
        part[list(noise.rows)] += noise.part @ of_noise
    return alone, part


def of_motions(split: Contributions) -> Array:
    """A-weighted mean squares of the lines of each motion alone and of its part in the sum.

    Returns
    -------
    shape (2, motion, receiver), Pa²
    """
    pressure = split.by_motion.sum(axis=1)
    audible = _audible(split.frequency_hz)
    alone = 0.5 * np.abs(pressure) ** 2 @ audible
    return np.stack([alone, 0.5 * (pressure * pressure.sum(axis=0).conj()).real @ audible])


def _columns(frequency_hz: Array, bands: Sequence[Band]) -> Array:
    """Weights of frequencies, shape (frequency, band + 1)."""
    return np.column_stack([membership(frequency_hz, bands), _audible(frequency_hz)])


def _audible(frequency_hz: Array) -> Array:
    return weighting_power("A", frequency_hz) * (frequency_hz > 0.0)


def contribution_variables(
    axes: LevelAxes,
    cases: Mapping[CaseKey, Contributions],
    orders: Sequence[int],
    medians: xr.Dataset | None = None,
) -> xr.Dataset:
    """Label the pressure of the paths at some orders, levels alone and shares in band and in all.

    Parameters
    ----------
    axes : axes of the levels
    cases : contributions of every case
    orders : orders whose pressure is kept
    medians : `MEDIANS`; none with nominal values
    """
    names = list(dict.fromkeys(name for split in cases.values() for name in split.names))
    speeds = list(dict.fromkeys(speed for speed, _ in cases))
    shape = len(speeds), len(axes.options), len(names), len(axes.receivers)
    pressure = np.zeros((*shape, len(orders)), dtype=complex)
    alone, part = (np.zeros((*shape, len(axes.bands) + 1)) for _ in range(2))
    for (speed, option), split in cases.items():
        case = speeds.index(speed), axes.options.index(option)
        rows = [names.index(name) for name in split.names]
        held = [order for order in orders if order < split.frequency_hz.size]
        pressure[case][rows, :, : len(held)] = split.pressure[..., held]
        alone[case][rows], part[case][rows] = energies(split, axes.bands)
    motions = list(dict.fromkeys(name for split in cases.values() for name in split.motions))
    radiated = np.zeros((2, *shape[:2], len(motions), shape[3]))
    for (speed, option), split in cases.items():
        rows = [motions.index(name) for name in split.motions]
        radiated[:, speeds.index(speed), axes.options.index(option), rows] = of_motions(split)
    total = part.sum(axis=2, keepdims=True)
    share = _shares(part, total)
    lines = radiated[1].sum(axis=2, keepdims=True)
    values = {
        "path_pressure": pressure,
        "path_level": level(alone[..., -1]),
        "path_share": share[..., -1],
        "motion_level": level(radiated[0]),
        "motion_share": _shares(radiated[1], lines),
        "path_band_level": level(alone[..., :-1]),
        "path_band_share": share[..., :-1],
        "modelled_band_level": level(total[:, :, 0, :, :-1]),
    }
    coords = {
        **axes.by_receiver,
        "path_speed": speeds,
        "path": [f"{name.source}: {name.port} {name.direction}" for name in names],
        "path_order": [float(order) for order in orders],
        "radiating_motion": motions,
        "band": [band.nominal_hz for band in axes.bands],
    }
    of_paths = {
        f"path_{part}": ("path", [getattr(name, part) for name in names])
        for part in PathName._fields
    }
    paths = stamped(values, coords).assign_coords(of_paths)
    if medians is None:
        return paths
    return _at_medians(paths, level(total[:, :, 0, :, -1]), medians)


def _shares(part: Array, total: Array) -> Array:
    """Parts over their sum; none of what is silent beside the loudest."""
    sounds = total > SILENT * total.max(initial=0.0)
    return np.where(sounds, part / np.where(sounds, total, 1.0), 0.0)


def _at_medians(paths: xr.Dataset, total_db: Array, medians: xr.Dataset) -> xr.Dataset:
    """Return the paths of a sample with the median levels of all samples.

    Their sum has the level that the results have of each order, each third octave and in all.
    Shares and phases stay those of the sample.

    Parameters
    ----------
    paths : labelled paths
    total_db : their A-weighted levels, shape (speed, option, receiver), dB
    medians : `MEDIANS`
    """
    median = medians[list(MEDIANS)].reset_coords(drop=True).sel(speed=paths["path_speed"].values)
    median = median.rename(speed="path_speed")
    pressure = paths["path_pressure"].sum("path")
    order = median["order_level"].sel(weighting="Z", order=pressure["path_order"].values)
    order_db = level_shift(
        order.rename(order="path_order"), pressure.copy(data=sound_pressure_level(pressure.values))
    )
    bands = paths["modelled_band_level"]
    band = (
        median["sources_band_level"]
        .rename(noise_band="band")
        .reindex(band=bands["band"].values, fill_value=SILENCE_DB)
    )
    band_db = level_shift(band, bands)
    total = xr.DataArray(total_db, dims=("path_speed", "option", "receiver"))
    in_all_db = level_shift(median["level_modelled"].sel(weighting="A", drop=True), total)
    shifted = {
        "path_pressure": paths["path_pressure"] * amplitude_of_level(order_db),
        "path_level": paths["path_level"] + in_all_db,
        "motion_level": paths["motion_level"] + in_all_db,
        "path_band_level": paths["path_band_level"] + band_db,
        "modelled_band_level": bands + band_db,
    }
    return paths.assign(
        {
            name: values.transpose(*paths[name].dims).assign_attrs(paths[name].attrs)
            for name, values in shifted.items()
        }
    )
