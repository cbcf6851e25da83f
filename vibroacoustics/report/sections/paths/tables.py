"""Transfer paths: sources, where they act and in which direction, in words and tables."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr

from ....base import rounding
from ....base.arrays import Array, ComplexArray
from ....base.decibel import amplitude_of_level, power_of_level, sound_pressure_level
from ....base.remembered import remembered
from ....base.vocabulary import REFERENCE_OPTION
from ....results.labels import DOF_WORDS
from ....results.stored_study import options, quoted_speed, source_name
from ...bands import percent
from ...tables import Table, dataset_csv

LEADING: Final = 10
"""Paths that are shown."""
_RELATIONS: Final = (
    (0.5, "works with it"),
    (0.1, "partly with it"),
    (-0.1, "across it"),
    (-0.5, "partly against it"),
    (-1.0, "works against it"),
)
"""Words from a cosine on."""
LEAST: Final = 0.005
"""Smaller shares are not told in words."""
_KINDS: Final = {"f": "force along", "m": "moment about"}


def has_paths(results: xr.Dataset) -> bool:
    """Whether the results tell paths apart and any of them sounds."""
    return "path_share" in results and bool(results["path_share"].any())


def has_motions(results: xr.Dataset) -> bool:
    """Whether what radiates tells more than the paths do: of several sources, or of modes."""
    sources = set(results["path_source"].values.tolist())
    return len(sources) > 1 or results.sizes["radiating_motion"] > len(DOF_WORDS)


def path_speed(results: xr.Dataset) -> float:
    """Speed at which paths are shown: of the published level, or the nearest to it."""
    speeds = results["path_speed"].values
    return float(speeds[np.argmin(np.abs(speeds - quoted_speed(results)))])


@remembered
def at_path_speed(results: xr.Dataset, receiver: str, option: str = REFERENCE_OPTION) -> xr.Dataset:
    """Paths to a microphone at the speed that is shown."""
    names = [name for name in results.data_vars if "path_speed" in results.variables[name].dims]
    return results[names].sel(path_speed=path_speed(results), option=option, receiver=receiver)


def path_words(results: xr.Dataset, row: int) -> tuple[str, str]:
    """Source of a path, and where it acts in which direction, in plain words."""
    source, port, direction = (
        str(results.variables[f"path_{field}"].values[row])
        for field in ("source", "port", "direction")
    )
    kind = _KINDS.get(direction[0]) if len(direction) == 2 else None
    words = DOF_WORDS.get(direction) or (f"{kind} {direction[1]}" if kind else direction)
    return source_name(results, source), f"{port.replace('_', ' ')} {words}"


def leading(share: Array, count: int = LEADING) -> list[int]:
    """Rows of the paths with the largest shares, of whatever sign; of those above nothing."""
    order = np.argsort(-np.abs(share), kind="stable")[:count]
    return [int(row) for row in order if abs(share[row]) >= 0.0005]


def relation(share: float, alone_db: float, total_db: float) -> str:
    """How a path lies to the sum: share √(total/alone) is the cosine between the two."""
    cosine = float(np.clip(share * amplitude_of_level(total_db - alone_db), -1.0, 1.0))
    words = next(text for least, text in _RELATIONS if cosine >= least)
    return f"{words} ({rounding.signed(cosine, 2)})"


def leading_sentence(results: xr.Dataset, receiver: str) -> str:
    """The two paths with the largest shares, and the one that works against most."""
    share = at_path_speed(results, receiver)["path_share"].values
    first = " and ".join(with_share(results, row, share) for row in leading(share, 2))
    against = int(np.argmin(share))
    less = (
        f" Against it works most: {with_share(results, against, share)}."
        if share[against] <= -LEAST
        else ""
    )
    return (
        f"Of the modelled A-weighted energy at {receiver} and {path_speed(results):g} rpm without "
        f"a balancer most comes by: {first}.{less}"
    )


def phasor_shares(pressure: ComplexArray) -> Array:
    """Re{p Σp*}/|Σp|² of the phasors (path,) of one line: they add up to one; 0 of silence."""
    total = pressure.sum()
    size = float(np.abs(total)) ** 2
    return np.asarray((pressure * np.conj(total)).real / size if size else pressure.real * 0.0)


def with_share(results: xr.Dataset, row: int, share: Array) -> str:
    """A path in one phrase, with its share."""
    return f"{': '.join(path_words(results, row))}, {signed_percent(float(share[row]))}"


def signed_percent(share: float) -> str:
    """A share with its sign, where it works against the others."""
    return f"−{percent(-share)}" if share < 0.0 else percent(share)


def modelled_level(results: xr.Dataset, receiver: str, option: str) -> float:
    """A-weighted level of all modelled sources at the speed that is shown, dB."""
    level = results["level_modelled"].sel(receiver=receiver, option=option, weighting="A")
    return float(level.sel(speed=path_speed(results)))


def loudest_order(results: xr.Dataset, receiver: str) -> float:
    """Of the orders at which paths are told apart, after weighting by A."""
    orders = results["path_order"].values
    there = results["order_level"].sel(receiver=receiver, option=REFERENCE_OPTION, weighting="A")
    level = there.sel(speed=path_speed(results), order=orders)
    return float(orders[int(np.argmax(level.values))])


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


def foot_orders(results: xr.Dataset, speed: float) -> list[int]:
    """Those of the first two orders at which a foot is pressed."""
    forces = abs(_forces(results, speed, [1, 2]).sum("source")).max(("foot", "axis"))
    return [int(one) for one in forces["order"].values[forces.values > rounding.FORCE_FLOOR]]


def foot_forces(results: xr.Dataset, speed: float) -> xr.DataArray:
    """Complex peaks without a balancer, over source, foot, axis and order, N."""
    return _forces(results, speed, foot_orders(results, speed))


def foot_table(results: xr.Dataset, speed: float) -> Table:
    """Peak force of each foot along each axis, and of what presses it most by itself."""
    forces = foot_forces(results, speed)
    rows = [
        (
            str(foot).replace("_", " "),
            str(axis),
            *(cell for order in there["order"].values for cell in _cells(there.sel(order=order))),
        )
        for foot in forces["foot"].values
        for axis in forces["axis"].values
        for there in [forces.sel(foot=foot, axis=axis)]
    ]
    orders = forces["order"].values
    head = [text for order in orders for text in (f"{order:g}×, N", f"{order:g}×, largest part")]
    words = frozenset({0, 1, *range(3, 2 + len(head), 2)})
    caption = f"{speed:g} rpm, option {REFERENCE_OPTION}: force into each foot, peak"
    return Table(caption, ("Foot", "along", *head), tuple(rows), words)


def _forces(results: xr.Dataset, speed: float, orders: list[int]) -> xr.DataArray:
    at = {"speed": speed, "option": REFERENCE_OPTION, "order": orders}
    return results["foot_force_order"].sel(at)


def _cells(there: xr.DataArray) -> tuple[str, str]:
    """Force of all that moves, and the largest of one of them alone."""
    alone = np.abs(there.values)
    first = int(np.argmax(alone))
    if alone[first] < rounding.FORCE_FLOOR:
        return "0", rounding.NOTHING
    source = str(there["source"].values[first]).replace("_", " ")
    total = rounding.significant(float(np.abs(there.values.sum())))
    return total, f"{source}, {rounding.significant(float(alone[first]))} N alone"
