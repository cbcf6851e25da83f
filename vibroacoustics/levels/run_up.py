"""Levels over speed, between the speeds of a study."""

from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.decibel import level_of_power
from ..base.vocabulary import REFERENCE_OPTION, stamped
from ..machine.remainder import UnmodelledNoise
from ..mechanics.received_sound import ReceivedSound
from .axes import LevelAxes
from .by_source import sound_by_source
from .energy import energy_of_lines, unmodelled_energy
from .labelled import level
from .lines import order_columns

_QUIETER_DB: Final = 40.0
"""Orders so far below the loudest at all speeds do not matter."""


def unmodelled_over_speed(
    band_level: xr.DataArray, growth: UnmodelledNoise, speed_rpm: float, speeds_rpm: Sequence[float]
) -> Array:
    """Compute the A-weighted mean square of unmodelled noise, shape (speed, receiver), Pa².

    Parameters
    ----------
    band_level : level of the noise at one speed, (receiver, noise_band), dB
    growth : growth of the noise with speed
    speed_rpm : speed of `band_level`
    speeds_rpm : speeds of the run-up
    """
    factor = growth.speed_factor(np.array(speeds_rpm), speed_rpm)
    square = unmodelled_energy(band_level.transpose("receiver", "noise_band")).sum(axis=1)
    return np.outer(factor, square)


def run_up_variables(
    axes: LevelAxes, sound: Mapping[float, ReceivedSound], unmodelled_pa2: Array
) -> xr.Dataset:
    """Label the A-weighted levels of sources, unmodelled noise, all sound and shaft orders.

    Parameters
    ----------
    axes : axes of sources and receivers
    sound : without an option at the receivers, by speed
    unmodelled_pa2 : mean square of unmodelled noise, shape (speed, receiver)
    """
    parts = [sound_by_source(received, axes.bands) for received in sound.values()]
    total = np.array([part.total[0] for part in parts]) + unmodelled_pa2
    order, energy = _orders(sound)
    values = {
        "run_up_source_level": level(np.array([part.alone for part in parts])),
        "run_up_unmodelled_level": level(unmodelled_pa2),
        "run_up_level": level(total),
        "run_up_order_level": level(energy),
    }
    coords = {
        "run_up_speed": list(sound),
        "sound_source": list(axes.sources),
        "receiver": list(axes.receivers),
        "run_up_order": order,
    }
    return stamped(values, coords)


def at_study_levels(
    run_up: xr.Dataset, results: xr.Dataset, published: tuple[str, float]
) -> xr.Dataset:
    """Raise the levels of a run-up to those of a study at its speeds; between, the course stays.

    Parameters
    ----------
    run_up : result of `run_up_variables`, of one sample
    results : medians of the samples
    published : microphone and speed of the published level, where unmodelled noise has its own
    """
    without = results.sel(option=REFERENCE_OPTION)
    orders = run_up["run_up_order"].values
    of_study = {
        "run_up_level": without["level_total"],
        "run_up_source_level": without["source_level"],
        "run_up_order_level": without["order_level"].sel(weighting="A").reindex(order=orders),
    }
    speeds_rpm, raised = run_up["run_up_speed"].values, {}
    for name, level_db in of_study.items():
        levels = run_up[name]
        wanted = level_db.rename(order="run_up_order") if "order" in level_db.dims else level_db
        wanted = wanted.transpose("speed", *levels.dims[1:])
        study_rpm = wanted["speed"].values
        shift = wanted.values - over_speed(study_rpm, speeds_rpm, levels.values)
        shift = np.nan_to_num(shift)  # of orders that the study lacks
        raised[name] = levels + over_speed(speeds_rpm, study_rpm, shift)
    noise = run_up["run_up_unmodelled_level"].sel(receiver=published[0])
    of_sample = over_speed(np.array([published[1]]), speeds_rpm, noise.values)
    shift = results["level_unmodelled"].item() - of_sample[0]
    raised["run_up_unmodelled_level"] = run_up["run_up_unmodelled_level"] + shift
    return run_up.assign({name: run_up[name].copy(data=each) for name, each in raised.items()})


def over_speed(wanted_rpm: Array, speed_rpm: Array, values: Array) -> Array:
    """Interpolate values (speed, ...) linearly; beyond the ends they are constant."""
    flat = values.reshape(len(speed_rpm), -1)
    columns = [np.interp(wanted_rpm, speed_rpm, column) for column in flat.T]
    return np.asarray(np.transpose(columns).reshape(len(wanted_rpm), *values.shape[1:]))


def _orders(sound: Mapping[float, ReceivedSound]) -> tuple[Array, Array]:
    """Orders up to the highest that matters; their mean squares, (speed, receiver, order), Pa²."""
    received = list(sound.values())
    highest = max(len(case.lines.names) for case in received)
    energy = np.zeros((len(received), received[0].pressure.shape[1], highest))
    for row, case in enumerate(received):
        order, columns = order_columns(case, highest)
        of_lines = energy_of_lines(case.pressure, case.lines.frequency_hz).sum(axis=0)
        energy[row][:, order] = of_lines[:, columns]
    loudest = level_of_power(energy.max(axis=(0, 1)))
    last = int(np.flatnonzero(loudest >= loudest.max() - _QUIETER_DB)[-1])
    return np.asarray(np.linspace(1.0, last, last), dtype=np.float64), energy[..., 1 : last + 1]
