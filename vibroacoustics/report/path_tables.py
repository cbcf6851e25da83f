"""Tables of the paths of sound: the leading ones, by order, by band, by option."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.arrays import Array
from ..base.decibel import power_of_level, sound_pressure_level
from ..base.vocabulary import REFERENCE_OPTION
from .labels import DOF_WORDS
from .paths import (
    LEAST,
    at_path_speed,
    leading,
    modelled_level,
    path_speed,
    path_words,
    phasor_shares,
    relation,
    signed_percent,
    with_share,
)
from .study import options
from .tables import Table, dataset_csv

_NAMED: Final = 2
"""Paths in a row of a table by order or band."""
_ORDERS: Final = 6
_HEAD: Final = ("first path", "second path", "works against most")


def paths_table(results: xr.Dataset, receiver: str) -> Table:
    """The leading paths of the A-weighted level."""
    there = at_path_speed(results, receiver)
    share, alone = there["path_share"].values, there["path_level"].values
    total = modelled_level(results, receiver, REFERENCE_OPTION)
    bands = there["path_band_share"].transpose("path", "band")
    energy = np.abs(bands.values) * power_of_level(there["modelled_band_level"].values)
    rows, so_far = [], 0.0
    for row in leading(share):
        so_far += share[row]
        loudest = bands["band"].values[int(energy[row].argmax())]
        rows.append(
            (
                *path_words(results, row),
                rounding.level(float(alone[row])),
                signed_percent(share[row]),
                signed_percent(so_far),
                relation(share[row], float(alone[row]), total),
                f"{loudest:g}",
            )
        )
    head = (
        "Source", "acts on", "Alone, dB(A)", "Share", "Shares so far", "Phase to the sum",
        "Most in band, Hz",
    )  # fmt: skip
    caption = (
        f"{receiver}, {path_speed(results):g} rpm, option {REFERENCE_OPTION}: the leading paths of "
        f"{len(share)}; all modelled sound is {rounding.level(total)} dB(A)"
    )
    return Table(caption, head, tuple(rows), frozenset({0, 1, 5}))


def motions_table(results: xr.Dataset, receiver: str) -> Table:
    """The leading motions that radiate: of the housing as a rigid body, modes of its shell."""
    there = at_path_speed(results, receiver)
    share, alone = there["motion_share"].values, there["motion_level"].values
    rows, so_far = [], 0.0
    for row in leading(share):
        so_far += share[row]
        name = str(there["radiating_motion"].values[row])
        words = f"housing {DOF_WORDS[name]}" if name in DOF_WORDS else f"shell mode {name}"
        cells = rounding.level(float(alone[row])), signed_percent(share[row])
        rows.append((words, *cells, signed_percent(so_far)))
    head = ("Motion", "Alone, dB(A)", "Share", "Shares so far")
    caption = f"{receiver}: motions that radiate the lines of all sources; noise is not in it"
    return Table(caption, head, tuple(rows))


def orders_table(results: xr.Dataset, receiver: str) -> Table:
    """The leading paths of each of the loudest orders."""
    there = at_path_speed(results, receiver)["path_pressure"].transpose("path", "path_order")
    level = sound_pressure_level(there.values.sum(axis=0))
    loudest = np.argsort(-level, kind="stable")[:_ORDERS]
    shown = sorted(at for at in loudest if level[at] >= rounding.LEVEL_FLOOR_DB)
    rows = [
        (f"{there['path_order'].values[at]:g}×", rounding.level(float(level[at])), *named)
        for at in shown
        for named in [_named(results, phasor_shares(there.values[:, at]))]
    ]
    caption = f"{receiver}: paths of the loudest orders, with their share of its energy"
    return Table(caption, ("Order", "Level, dB", *_HEAD), tuple(rows), frozenset({0, 2, 3, 4}))


def bands_table(results: xr.Dataset, receiver: str) -> Table:
    """The leading paths of each third octave."""
    there = at_path_speed(results, receiver)
    share = there["path_band_share"].transpose("band", "path").values
    rows = [
        (f"{band:g}", rounding.level(float(level)), *_named(results, of_band))
        for band, level, of_band in zip(
            there["band"].values, there["modelled_band_level"].values, share, strict=True
        )
        if of_band.any()
    ]
    caption = f"{receiver}: paths of each third octave, with their share of its energy"
    return Table(caption, ("Band, Hz", "Level, dB", *_HEAD), tuple(rows),
                 frozenset({2, 3, 4}))  # fmt: skip


def partial_sums_table(results: xr.Dataset, receiver: str, order: float) -> Table:
    """Phasors of an order, the largest share first, and the level of their sum so far."""
    pressure = at_path_speed(results, receiver)["path_pressure"].sel(path_order=order).values
    share, total = phasor_shares(pressure), pressure.sum()
    rows, so_far = [], 0j
    for row in leading(share):
        so_far += pressure[row]
        turned = float(np.degrees(np.angle(pressure[row] * np.conj(total))))
        rows.append(
            (
                *path_words(results, row),
                _level(pressure[row]),
                f"{rounding.signed(turned, 0)}°",
                signed_percent(share[row]),
                _level(so_far),
            )
        )
    head = ("Source", "acts on", "Alone, dB", "Phase to the sum", "Share",
            "Sum so far, dB")  # fmt: skip
    caption = f"{receiver}: order {order:g} as a sum of phasors, {_level(complex(total))} dB"
    return Table(caption, head, tuple(rows), frozenset({0, 1}))


def options_table(results: xr.Dataset, receiver: str) -> Table:
    """What each option leaves of the leading paths."""
    rows = []
    for option in options(results):
        share = at_path_speed(results, receiver, option)["path_share"].values
        level = rounding.level(modelled_level(results, receiver, option))
        rows.append((option, level, *_named(results, share)))
    caption = f"{receiver}, {path_speed(results):g} rpm: the leading paths with each option"
    return Table(caption, ("Option", "Modelled, dB(A)", *_HEAD), tuple(rows),
                 frozenset({0, 2, 3, 4}))  # fmt: skip


def paths_csv(results: xr.Dataset) -> bytes:
    """One row per option, speed, microphone and path, to nine significant digits."""
    columns = {
        "option": results["option"],
        "speed_rpm": results["path_speed"],
        "receiver": results["receiver"],
        **{name: results[f"path_{name}"] for name in ("source", "port", "direction")},
        "level_dba": results["path_level"],
        "share_of_modelled_energy": results["path_share"],
    }
    return dataset_csv(("option", "path_speed", "receiver", "path"), columns)


def _named(results: xr.Dataset, share: Array) -> Sequence[str]:
    """The paths with the largest shares, and the one that works against most."""
    with_it = [row for row in np.argsort(-share, kind="stable")[:_NAMED] if share[row] >= LEAST]
    cells = [with_share(results, int(row), share) for row in with_it]
    cells += [rounding.NOTHING] * (_NAMED - len(cells))
    against = int(np.argmin(share))
    has_one = share[against] <= -LEAST
    return *cells, with_share(results, against, share) if has_one else rounding.NOTHING


def _level(pressure: complex) -> str:
    return rounding.level(float(sound_pressure_level(np.asarray(pressure))))
