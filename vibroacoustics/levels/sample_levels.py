"""Levels of a sample with its discrepancies, at all speeds, options and receivers."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..base.vocabulary import REFERENCE_OPTION, WEIGHTINGS
from ..machine.machine import Machine
from ..machine.source import CaseKey
from ..mechanics.loads import Lines
from ..mechanics.received_sound import ReceivedSound
from ..study.study import Study
from .axes import LevelAxes
from .baseline import baseline_orders, points_of, with_baseline
from .by_source import SourceSound, gain_band_number, membership, weighting_power
from .labelled import level, level_changes, source_levels, weighted, with_measured
from .lines import order_columns, unmodelled_in_bands
from .measured_points import BASELINE_BANDS
from .remainder import remaining

Levels = dict[str, Array]
"""Arrays by variable of the vocabulary, the first axis is the discrepancy."""


class Deviating(NamedTuple):
    """Sound of a sample with its discrepancies.

    Attributes
    ----------
    received : lines and noise of every case, without discrepancy
    gain : factors on the power of sources, of every case, shape (discrepancy, source, receiver,
        gain band)
    sounds : mean squares of every case, by discrepancy
    machine : machine of the sample
    unmodelled : noise at the published point, A-weighted, shape (discrepancy, band), Pa²
    """

    received: Mapping[CaseKey, ReceivedSound]
    gain: Mapping[CaseKey, Array]
    sounds: Sequence[Mapping[CaseKey, SourceSound]]
    machine: Machine
    unmodelled: Array


class CaseLines(NamedTuple):
    """Lines and noise of all sources of a case together, with discrepancies.

    Attributes
    ----------
    order : level of the shaft orders, shape (discrepancy, receiver, order), dB
    band : mean square of lines and noise in `BASELINE_BANDS`, shape (discrepancy, receiver, band),
        Pa²
    noise : mean square of the noise alone, the same shape, Pa²
    weighted : mean square of lines and noise by `WEIGHTINGS`, shape (discrepancy, receiver,
        weighting), Pa²
    """

    order: Array
    band: Array
    noise: Array
    weighted: Array


def with_gain(received: ReceivedSound, gain: Array) -> ComplexArray:
    """Return the pressure at the lines with gains, shape (discrepancy, source, receiver, line), Pa.

    Parameters
    ----------
    received : received sound of a case
    gain : factors on the power, shape (discrepancy, source, receiver, gain band)
    """
    root = np.sqrt(gain)[..., gain_band_number(received.lines.frequency_hz)]
    return np.asarray(root * received.pressure)


def with_discrepancy(received: ReceivedSound, gain: Array) -> ReceivedSound:
    """Return the sound of a case with the gains of one discrepancy.

    Parameters
    ----------
    received : received sound of a case
    gain : factors on the power, shape (source, receiver, gain band)
    """
    noise = tuple(
        replace(
            part,
            power=gain[part.source][..., gain_band_number(part.frequency_hz)] * part.power,
        )
        for part in received.noise
    )
    return ReceivedSound(received.lines, with_gain(received, gain[None])[0], noise)


def loads_with_gain(lines: Lines, gain: Array) -> Lines:
    """Return lines whose loads have the gains of one discrepancy, as for one microphone.

    Parameters
    ----------
    lines : loads of all sources
    gain : factors on the power, shape (source, gain band)
    """
    root = np.sqrt(gain)[:, gain_band_number(lines.frequency_hz)]
    loads = {
        source: {port: factor * load for port, load in by_port.items()}
        for factor, (source, by_port) in zip(root, lines.loads.items(), strict=True)
    }
    return replace(lines, loads=loads)


def lines_of(received: ReceivedSound, gain: Array, orders: int) -> CaseLines:
    """Compute the lines and noise of a case with gains.

    Parameters
    ----------
    received, gain : see `with_gain`
    orders : number of shaft orders, from zero on
    """
    hertz = received.lines.frequency_hz
    every = 0.5 * np.abs(with_gain(received, gain).sum(axis=1)) ** 2
    square = every * (hertz > 0.0)
    columns, lines = order_columns(received, orders)
    order = np.zeros((*every.shape[:-1], orders))
    order[..., columns] = every[..., lines]
    weights = np.stack([weighting_power(name, hertz) for name in WEIGHTINGS], axis=-1)
    weighted, band = square @ weights, square @ membership(hertz, BASELINE_BANDS)
    noise = np.zeros_like(band)
    for part in received.noise:
        part_hz = part.frequency_hz
        power = gain[:, part.source][..., gain_band_number(part_hz)] * part.power
        noise += power @ membership(part_hz, BASELINE_BANDS)
        weighted += power @ np.stack(
            [weighting_power(name, part_hz) for name in WEIGHTINGS], axis=-1
        )
    return CaseLines(level(order), band + noise, noise, weighted)


def line_squares(axes: LevelAxes, sample: Deviating, names: Sequence[str]) -> tuple[Array, Array]:
    """Compute the mean squares of lines of a sample, and their frequencies.

    Returns
    -------
    frequency : not a number where there is no line, shape (speed, line), Hz
    square : mean square of all sources together, shape (discrepancy, speed, option, receiver,
        line), Pa²
    """
    column = {name: number for number, name in enumerate(names)}
    pairs, receivers = len(sample.unmodelled), len(axes.receivers)
    square = np.zeros((pairs, len(axes.speeds), len(axes.options), receivers, len(names)))
    frequency = np.full((len(axes.speeds), len(names)), np.nan)
    for s, speed in enumerate(axes.speeds):
        for o, option in enumerate(axes.options):
            received = sample.received[speed, option]
            hertz = received.lines.frequency_hz
            rows = [n for n, name in enumerate(received.lines.names) if name in column and hertz[n]]
            columns = [column[received.lines.names[n]] for n in rows]
            pressure = with_gain(received, sample.gain[speed, option]).sum(axis=1)[..., rows]
            square[:, s, o][..., columns] = 0.5 * np.abs(pressure) ** 2
            frequency[s, columns] = hertz[rows]
    return frequency, square


def sample_levels(study: Study, axes: LevelAxes, order_hz: Array, sample: Deviating) -> Levels:
    """Compute the levels of a sample.

    Parameters
    ----------
    study : options and published level
    axes : axes of the levels
    order_hz : frequencies of the orders, shape (speed, order), Hz
    sample : sound with its discrepancies

    Returns
    -------
    variables of the vocabulary, the first axis is the discrepancy
    """
    noise = [remaining(study, axes, sample.machine, of_pair) for of_pair in sample.unmodelled]
    points = points_of(study, axes)
    residual = np.array(
        [
            with_baseline(study, axes, points, sound, of_noise)
            for sound, of_noise in zip(sample.sounds, noise, strict=True)
        ]
    )
    lines = _gathered(axes, sample, order_hz.shape[1])
    order_level = lines.order
    if points:
        measured = np.array(
            [baseline_orders(study, axes, points, sound) for sound in sample.sounds]
        )
        order_level = with_measured(order_level, measured, axes.measured_orders)
    unmodelled = unmodelled_in_bands(np.array(noise))
    levels = _of_sources(axes, sample, residual) | {
        "order_level": weighted(order_level, order_hz),
        "level_modelled": level(lines.weighted),
        "noise_band_level": level(lines.noise),
        "sources_band_level": level(lines.band),
        "unmodelled_band_level": level(unmodelled),
        "level_unmodelled": level(sample.unmodelled.sum(axis=-1)),
    }
    if not points:
        levels["total_band_level"] = level(lines.band + unmodelled)
    return levels | level_changes(levels, list(axes.options).index(REFERENCE_OPTION))


def _gathered(axes: LevelAxes, sample: Deviating, orders: int) -> CaseLines:
    """Lines and noise of all cases, axes (discrepancy, speed, option, receiver, ...)."""
    cases = [
        lines_of(sample.received[s, o], sample.gain[s, o], orders)
        for s in axes.speeds
        for o in axes.options
    ]
    shape = (len(axes.speeds), len(axes.options))
    parts = (np.stack(part, axis=1) for part in zip(*cases, strict=True))
    return CaseLines(*(part.reshape(len(part), *shape, *part.shape[2:]) for part in parts))


def _of_sources(axes: LevelAxes, sample: Deviating, residual: Array) -> Levels:
    """Levels and shares of the sources, and totals; A-weighted."""
    each = [
        source_levels(axes, sound, noise)
        for sound, noise in zip(sample.sounds, residual, strict=True)
    ]
    levels = {name: np.array([of_pair[name] for of_pair in each]) for name in each[0]}
    modelled = np.array(
        [axes.gathered(sound, "part")[:, :, 0].sum(axis=2) for sound in sample.sounds]
    )
    return {"level_total": level(modelled + residual), **levels}
