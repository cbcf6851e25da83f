"""Mean squares of the paths of sound, alone and in the sum of all."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..machine.source import CaseKey
from ..mechanics.contributions import Contributions, PathName
from .axes import LevelAxes
from .bands import Band
from .by_source import gain_band_number, membership, weighting_power


class PathEnergies(NamedTuple):
    """Mean squares of the paths of one case.

    Attributes
    ----------
    names : names of the paths
    motions : motions that radiate
    path : energy of each path alone and what it adds to the sum of all, shape (2, path, receiver,
        bands, all of them A-weighted, orders), Pa²
    motion : energy of the lines of each motion likewise, A-weighted, shape (2, motion, receiver),
        Pa²
    """

    names: tuple[PathName, ...]
    motions: tuple[str, ...]
    path: Array
    motion: Array


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


Row = dict[float, PathEnergies]
"""Energies by speed."""


def path_rows(
    cases: Iterable[tuple[CaseKey, Contributions]],
    gain: Mapping[CaseKey, Array],
    axes: LevelAxes,
    orders: Sequence[int],
) -> list[Row]:
    """Compute the energies of the paths with every discrepancy, or without one.

    Parameters
    ----------
    cases : contributions of each speed without an option
    gain : factors on the power of sources, shape (discrepancy, source, receiver, gain band); empty
        without discrepancy
    axes : axes of the levels
    orders : shaft orders whose lines are kept
    """
    by_speed = {}
    for key, case in cases:
        every = [with_gain(case, of_pair) for of_pair in gain[key]] if gain else [case]
        by_speed[key[0]] = [path_energies(each, axes.bands, orders) for each in every]
    rows = zip(*by_speed.values(), strict=True)
    return [dict(zip(by_speed, row, strict=True)) for row in rows]


def path_energies(
    split: Contributions, bands: Sequence[Band], orders: Sequence[int]
) -> PathEnergies:
    """Compute the mean squares of each path alone and what each adds to the sum of all.

    Lines add as phasors: a path p adds ½ Re{p Σp*} to the mean square of a line, which is negative
    where it works against the others; lines of different frequencies add as energy.

    Parameters
    ----------
    split : contributions of a case
    bands : third octaves, unweighted
    orders : shaft orders whose lines are kept, without noise
    """
    of_orders = np.equal.outer(np.arange(split.frequency_hz.size), orders)
    of_lines = np.column_stack([_columns(split.frequency_hz, bands), of_orders])
    path = np.stack([part @ of_lines for part in _squares(split.pressure)])
    for noise in split.noise:
        of_noise = _columns(noise.frequency_hz, bands)
        path[:, list(noise.rows), :, : len(bands) + 1] += np.stack(
            [noise.alone @ of_noise, noise.part @ of_noise]
        )
    audible = _audible(split.frequency_hz)
    motion = np.stack([part @ audible for part in _squares(split.by_motion.sum(axis=1))])
    return PathEnergies(split.names, split.motions, path, motion)


def _squares(pressure: ComplexArray) -> tuple[Array, Array]:
    """Mean squares of phasors along the first axis alone and their parts in the sum, Pa²."""
    alone = 0.5 * np.abs(pressure) ** 2
    return alone, 0.5 * (pressure * pressure.sum(axis=0).conj()).real


def _columns(frequency_hz: Array, bands: Sequence[Band]) -> Array:
    """Weights of frequencies, shape (frequency, band + 1)."""
    return np.column_stack([membership(frequency_hz, bands), _audible(frequency_hz)])


def _audible(frequency_hz: Array) -> Array:
    return weighting_power("A", frequency_hz) * (frequency_hz > 0.0)
