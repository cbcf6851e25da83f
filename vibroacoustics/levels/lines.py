"""Sound pressure by source at all lines and by third octave, labelled."""

from collections.abc import Iterable, Mapping
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array, IndexArray
from ..base.decibel import amplitude_of_level, level_shift, sound_pressure_level
from ..base.vocabulary import stamped
from ..machine.source import CaseKey
from ..mechanics.received_sound import ReceivedSound
from .axes import LevelAxes
from .by_source import membership, weighting_power
from .labelled import level
from .measured_points import BASELINE_BANDS, MIDDLE_HZ, UNMODELLED_BANDS

_UNMODELLED_COLUMNS: Final = [BASELINE_BANDS.index(band) for band in UNMODELLED_BANDS]


def noise_levels(
    axes: LevelAxes, received: Mapping[CaseKey, ReceivedSound], remaining: Array
) -> xr.Dataset:
    """Label the levels in third octaves of noise and, without a baseline, of all sound; unweighted.

    Parameters
    ----------
    axes : speeds, options and receivers
    received : sound of these cases, and of others
    remaining : A-weighted unmodelled noise in `UNMODELLED_BANDS`, shape (speed, option, receiver,
        band), Pa²
    """
    noise = np.array([[_noise(received[s, o], axes) for o in axes.options] for s in axes.speeds])
    unmodelled = unmodelled_in_bands(remaining)
    bands = {"noise_band": [band.nominal_hz for band in BASELINE_BANDS]}
    lines = [[_lines(received[s, o]) for o in axes.options] for s in axes.speeds]
    sources = np.array(lines) + noise
    values = {
        "noise_band_level": level(noise),
        "sources_band_level": level(sources),
        "unmodelled_band_level": level(unmodelled),
    }
    if not axes.measured_orders:
        values["total_band_level"] = level(sources + unmodelled)
    return stamped(values, axes.by_receiver | bands)


def unmodelled_in_bands(remaining: Array) -> Array:
    """Return unmodelled noise without weighting in `BASELINE_BANDS`, shape (..., band), Pa².

    Parameters
    ----------
    remaining : A-weighted, in `UNMODELLED_BANDS`, shape (..., band), Pa²
    """
    unmodelled = np.zeros((*remaining.shape[:-1], len(BASELINE_BANDS)))
    unmodelled[..., _UNMODELLED_COLUMNS] = remaining / weighting_power(
        "A", MIDDLE_HZ[_UNMODELLED_COLUMNS]
    )
    return unmodelled


def _lines(sound: ReceivedSound) -> Array:
    """Mean squares of the lines of all sources together, shape (receiver, band), Pa²."""
    square = 0.5 * np.abs(sound.pressure.sum(axis=0)) ** 2
    return np.asarray(square @ membership(sound.lines.frequency_hz, BASELINE_BANDS))


def _noise(sound: ReceivedSound, axes: LevelAxes) -> Array:
    """Mean squares of all sources' noise, shape (receiver, band), Pa²."""
    square = np.zeros((len(axes.receivers), len(BASELINE_BANDS)))
    for part in sound.noise:
        square += part.power @ membership(part.frequency_hz, BASELINE_BANDS)
    return square


_ORDER = "order "
"""Prefix of the names of lines that are orders."""


def order_columns(received: ReceivedSound, orders: int) -> tuple[IndexArray, IndexArray]:
    """Return shaft orders below a number, and the columns of their lines."""
    columns = {
        int(name.removeprefix(_ORDER)): column
        for column, name in enumerate(received.lines.names)
        if name.startswith(_ORDER)
    }
    order = np.array([column for column in columns if column < orders], dtype=np.intp)
    return order, np.array([columns[number] for number in order.tolist()], dtype=np.intp)


def with_order_levels(lines: xr.Dataset, order_level: xr.DataArray) -> xr.Dataset:
    """Return lines whose orders have given levels and their own phases.

    Parameters
    ----------
    lines : result of `line_pressure`
    order_level : level of the orders, with weightings, dB
    """
    pressure = lines["pressure_line"]
    orders = order_level.sizes["order"]
    wanted = order_level.sel(weighting="Z").transpose("speed", "option", "receiver", "order").values
    current = sound_pressure_level(pressure.values[..., :orders].sum(axis=2))
    factor = amplitude_of_level(level_shift(wanted, current))
    scaled = pressure.values.copy()
    scaled[..., :orders] *= factor[:, :, None]
    return lines.assign(pressure_line=pressure.copy(data=scaled))


def line_pressure(
    axes: LevelAxes, received: Mapping[CaseKey, ReceivedSound], others: Iterable[str] = ()
) -> xr.Dataset:
    """Pressure by source at all lines; tones of one name are one line, empty where it is none.

    Orders come first, from zero, the tones of all cases after them.
    """
    cases = {(s, o): received[s, o] for s in axes.speeds for o in axes.options}
    every = (name for sound in cases.values() for name in sound.lines.names)
    names = list(dict.fromkeys([*others, *every]))
    names.sort(key=lambda name: not name.startswith(_ORDER))  # orders first, else as they come
    column = {name: number for number, name in enumerate(names)}
    sizes = map(len, (axes.speeds, axes.options, axes.sources, axes.receivers, names))
    pressure = np.zeros(tuple(sizes), dtype=complex)
    frequency = np.full((len(axes.speeds), len(names)), np.nan)
    for (speed, option), sound in cases.items():
        s, o = axes.speeds.index(speed), axes.options.index(option)
        columns = [column[name] for name in sound.lines.names]
        pressure[s, o][..., columns] = sound.pressure
        frequency[s, columns] = sound.lines.frequency_hz
    orders = [
        float(name.removeprefix(_ORDER)) if name.startswith(_ORDER) else np.nan for name in names
    ]
    coords = {"tone_frequency": (("speed", "line"), frequency), "line_order": ("line", orders)}
    labelled = stamped({"pressure_line": pressure}, {**axes.by_source, "line": names})
    return labelled.assign_coords(coords)
