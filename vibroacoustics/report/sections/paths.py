"""Transfer paths from sources to microphones, in words and tables; forces into the feet."""

from typing import Final

import numpy as np
import xarray as xr

from ...base import rounding
from ...base.arrays import Array, ComplexArray
from ...base.decibel import amplitude_of_level, power_of_level, sound_pressure_level
from ...base.registry import register
from ...base.vocabulary import REFERENCE_OPTION
from ...results.bands import percent
from ...results.labels import DOF_WORDS
from ...results.stored_study import a_weighted, at_catalogue, catalogue_receiver, source_name
from ..blocks import Block, Heading, Pictures, Text
from ..figures.paths import (
    PARTS_OF_PATH,
    at_path_speed,
    foot_bars,
    foot_forces,
    foot_orders,
    leading,
    path_shares,
    path_speed,
    path_words,
)
from ..tables import DataTable, Table, data_table, phase_deg
from . import Section
from .sources.words import ranked, source_share

_RELATIONS: Final = (
    (0.5, "works with it"),
    (0.1, "partly with it"),
    (-0.1, "across it"),
    (-0.5, "partly against it"),
    (-1.0, "works against it"),
)
"""Words from a cosine on."""
LEAST: Final = 0.005
"""Smaller shares are omitted in sentences."""


def has_paths(results: xr.Dataset) -> bool:
    """Return whether the results hold transfer paths with sound."""
    return "path_share" in results and bool(results["path_share"].any())


def has_motions(results: xr.Dataset) -> bool:
    """Return whether motions differ from paths: several sources, or modes of the shell."""
    sources = set(results["path_source"].values.tolist())
    return len(sources) > 1 or results.sizes["radiating_motion"] > len(DOF_WORDS)


def relation(share: float, alone_db: float, total_db: float) -> str:
    """Name the phase of a path to the sum: share √(total/alone) is the cosine between the two."""
    cosine = float(np.clip(share * amplitude_of_level(total_db - alone_db), -1.0, 1.0))
    words = next(text for least, text in _RELATIONS if cosine >= least)
    return f"{words} ({rounding.signed(cosine, 2)})"


def leading_sentence(results: xr.Dataset, receiver: str) -> str:
    """The two paths with the largest shares, and that with the most negative one."""
    share = at_path_speed(results, receiver)["path_share"].values
    first = " and ".join(with_share(results, row, share) for row in leading(share, 2))
    against, less = int(np.argmin(share)), ""
    if share[against] <= -LEAST:
        less = f" Most negative: {with_share(results, against, share)}."
    whose = ", representative sample" if "representative_value" in results else ""
    return (
        f"Dominant paths to {receiver} at {path_speed(results):g} rpm without a balancer{whose}: "
        f"{first} of the modelled energy.{less}"
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


_SHOWN: Final = 5
_ORDERS: Final = 6


def paths_table(results: xr.Dataset, receiver: str) -> Table:
    """The leading paths of the A-weighted level."""
    at_speed = at_path_speed(results, receiver)
    share, alone = at_speed["path_share"].values, at_speed["path_level"].values
    coordinates = at_catalogue(results, receiver=receiver, speed=path_speed(results))
    total = float(a_weighted(results["level_modelled"]).sel(coordinates))
    bands = at_speed["path_band_share"].transpose("path", "band")
    energy = np.abs(bands.values) * power_of_level(at_speed["modelled_band_level"].values)
    rows = tuple(
        (
            *path_words(results, row),
            rounding.level(float(alone[row])),
            signed_percent(share[row]),
            relation(share[row], float(alone[row]), total),
            f"{bands['band'].values[int(energy[row].argmax())]:g}",
        )
        for row in leading(share, _SHOWN)
    )
    head = ("Source", "acts on", "Alone, dB(A)", "Share", "Phase to the sum", "Most in band, Hz")
    caption = (
        f"{receiver}, {path_speed(results):g} rpm, without a balancer: {len(rows)} of {len(share)} "
        f"paths; all modelled sound is {rounding.level(total)} dB(A)"
    )
    return Table(caption, head, rows, frozenset({0, 1, 4}))


def orders_table(results: xr.Dataset, receiver: str) -> Table:
    """The leading paths of each of the loudest orders."""
    pressure = at_path_speed(results, receiver)["path_pressure"].transpose("path", "path_order")
    level = sound_pressure_level(pressure.values.sum(axis=0))
    loudest = np.argsort(-level, kind="stable")[:_ORDERS]
    rows = []
    for index in sorted(index for index in loudest if level[index] >= rounding.LEVEL_FLOOR_DB):
        share = phasor_shares(pressure.values[:, index])
        order, first = f"{pressure['path_order'].values[index]:g}×", int(np.argmax(share))
        rows.append((order, rounding.level(float(level[index])), with_share(results, first, share)))
    head = ("Order", "Level, dB", "Path with the largest share")
    return Table(f"{receiver}: loudest orders", head, tuple(rows), frozenset({0, 2}))


def path_data(results: xr.Dataset) -> dict[str, DataTable]:
    """Return paths of all options; bands, orders, motions without a balancer; forces into feet."""
    here = results.sel(option=REFERENCE_OPTION, path_speed=path_speed(results))
    named = {name: here[name] for name in PARTS_OF_PATH}
    pressure = here["path_pressure"].transpose("receiver", "path_order", "path")
    total = pressure.sum("path")
    size = abs(total) ** 2
    share = (pressure * np.conj(total)).real / size.where(size > 0.0)
    files = {
        "paths.csv": paths_data(results),
        "path_bands.csv": data_table(
            ("receiver", "band", "path"),
            {
                "receiver": here["receiver"],
                "band_hz": here["band"],
                **named,
                "level_db": here["path_band_level"],
                "share": here["path_band_share"],
                "band_level_db": here["modelled_band_level"],
            },
        ),
        "path_orders.csv": data_table(
            ("receiver", "path_order", "path"),
            {
                "receiver": here["receiver"],
                "order": here["path_order"],
                **named,
                "level_db": _levels(pressure),
                "phase_to_sum_deg": phase_deg(pressure * np.conj(total)),
                "share": share,
                "sum_so_far_db": _levels(_so_far(pressure, share)),
                "order_level_db": _levels(total),
            },
        ),
        "feet.csv": _feet(results),
    }
    if has_motions(results):
        columns = {"receiver": here["receiver"], "motion": here["radiating_motion"]}
        share = here["motion_share"].transpose("receiver", "radiating_motion")
        values = {"level_dba": here["motion_level"], "share": share}
        values["share_so_far"] = _so_far(share, share)
        dims = ("receiver", "radiating_motion")
        files["path_motions.csv"] = data_table(dims, {**columns, **values})
    return files


def _feet(results: xr.Dataset) -> DataTable:
    forces = foot_forces(results, path_speed(results))
    columns = {dim: forces[dim] for dim in ("foot", "axis", "order", "source")}
    values = {"peak_n": abs(forces), "all_sources_peak_n": abs(forces.sum("source"))}
    return data_table(tuple(columns), {**columns, **values})


def _so_far(values: xr.DataArray, share: xr.DataArray) -> xr.DataArray:
    """Running sums along the last dimension, the largest shares of whatever sign first."""
    order = np.argsort(-np.abs(share.values), axis=-1, kind="stable")
    running = np.cumsum(np.take_along_axis(values.values, order, -1), axis=-1)
    return values.copy(data=np.take_along_axis(running, np.argsort(order, axis=-1), -1))


def _levels(pressure: xr.DataArray) -> xr.DataArray:
    return pressure.copy(data=sound_pressure_level(pressure.values))


def paths_data(results: xr.Dataset) -> DataTable:
    """One row per option, speed, microphone and path."""
    dims = ("option", "path_speed", "receiver", "path")
    share = results["path_share"].transpose(*dims)
    level = results["level_modelled"].sel(weighting="A", drop=True).rename(speed="path_speed")
    total = level.sel(path_speed=results["path_speed"])
    heads = ("option", "speed_rpm", "receiver", "source", "port", "direction")
    columns = {
        **{
            head: results[name]
            for head, name in zip(heads, (*dims[:3], *PARTS_OF_PATH), strict=True)
        },
        "level_dba": results["path_level"],
        "share_of_modelled_energy": share,
        "share_so_far": _so_far(share, share),
        "cosine_to_sum": share * amplitude_of_level(total - results["path_level"]),
    }
    return data_table(dims, columns)


def _in_samples(results: xr.Dataset) -> str:
    """Say what one sample cannot show: the share of the largest source in all samples."""
    if "representative_value" not in results:
        return ""
    speed = path_speed(results)
    first = ranked(results, speed)[0]
    share = source_share(results, first, speed).in_percent()
    return (
        " Shares and phases are those of the representative sample, levels are medians of all "
        f"samples. The share of {source_name(results, first)} in the energy of the machine, "
        f"unmodelled noise included, is {share} over all samples."
    )


def _blocks(results: xr.Dataset) -> list[Block]:
    receiver, speed = catalogue_receiver(results), path_speed(results)
    blocks: list[Block] = [
        Text(leading_sentence(results, receiver), "strong"),
        Text(
            "A path is a source, the part it acts on and a direction. Lines of one frequency add "
            f"as phasors, so shares can be negative and add up to 100 %.{_in_samples(results)}",
            "note",
        ),
        paths_table(results, receiver),
        Pictures((path_shares(results, receiver),)),
        orders_table(results, receiver),
        Text(
            "Other microphones and options are in paths.csv, bands and orders in path_bands.csv "
            f"and path_orders.csv{', motions in path_motions.csv' * has_motions(results)}.",
            "note",
        ),
    ]
    if foot_orders(results, speed):
        blocks += [
            Heading("Forces into the feet"),
            Pictures((foot_bars(results, speed),)),
            Text("Values by source are in feet.csv.", "note"),
        ]
    return blocks


register(Section("paths", "Transfer paths", _blocks, has_paths, 32.0, tables=path_data))
