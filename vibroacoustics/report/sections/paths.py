"""Transfer paths from sources to microphones, in words and tables; forces into the feet."""

from typing import Final

import numpy as np
import xarray as xr

from ...base import rounding
from ...base.arrays import Array
from ...base.decibel import power_of_level
from ...base.registry import register
from ...base.vocabulary import REFERENCE_OPTION
from ...results.bands import INTERVAL, band, percent
from ...results.estimates import has_samples
from ...results.labels import DOF_WORDS
from ...results.stored_study import at_catalogue, catalogue_receiver
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
from ..tables import DataTable, Table, data_table
from . import Section

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


def relation(cosine: float) -> str:
    """Name the phase of a path to the sum by the cosine between the two."""
    words = next(text for least, text in _RELATIONS if cosine >= least)
    return f"{words} ({rounding.signed(cosine, 2)})"


def leading_sentence(results: xr.Dataset, receiver: str) -> str:
    """The two paths with the largest shares, and that with the most negative one."""
    share = at_path_speed(results, receiver)["path_share"].values

    def words(row: int) -> str:
        return f"{': '.join(path_words(results, row))}, {_share(results, receiver, row)}"

    first = " and ".join(map(words, leading(share, 2)))
    against = int(np.argmin(share))
    less = f" Most negative: {words(against)}." if share[against] <= -LEAST else ""
    return (
        f"Dominant paths to {receiver} at {path_speed(results):g} rpm without a balancer: {first} "
        f"of the modelled energy.{less}"
    )


def _share(results: xr.Dataset, receiver: str, row: int) -> str:
    """Share of a path in the modelled energy with its interval, such as `−9 % (−20 % to 0 %)`."""
    path = results["path"].values[row]
    share = band(
        results, "path_share", receiver=receiver, path_speed=path_speed(results), path=path
    )
    return share.in_percent()


def _with_share(results: xr.Dataset, row: int, share: Array) -> str:
    """A path in one phrase, with its share, which is negative where it works against the others."""
    size = f"{'−' * bool(share[row] < 0.0)}{percent(abs(float(share[row])))}"
    return f"{': '.join(path_words(results, row))}, {size}"


_SHOWN: Final = 5
_ORDERS: Final = 6


def paths_table(results: xr.Dataset, receiver: str) -> Table:
    """The leading paths of the A-weighted level."""
    at_speed, speed = at_path_speed(results, receiver), path_speed(results)
    share, alone = at_speed["path_share"].values, at_speed["path_level"].values
    total = band(results, "level_modelled", **at_catalogue(results, receiver=receiver, speed=speed))
    bands = at_speed["path_band_share"].transpose("path", "band")
    energy = np.abs(bands.values) * power_of_level(at_speed["modelled_band_level"].values)
    rows = tuple(
        (
            *path_words(results, row),
            rounding.level(float(alone[row])),
            _share(results, receiver, row),
            relation(float(at_speed["path_cosine"].values[row])),
            f"{bands['band'].values[int(energy[row].argmax())]:g}",
        )
        for row in leading(share, _SHOWN)
    )
    of_level, of_share = (", median", f", mean ({INTERVAL})") if has_samples(results) else ("", "")
    head = (
        "Source", "acts on", f"Alone, dB(A){of_level}", f"Share{of_share}", "Phase to the sum",
        "Most in band, Hz",
    )  # fmt: skip
    caption = (
        f"{receiver}, {speed:g} rpm, without a balancer: {len(rows)} of {len(share)} paths; all "
        f"modelled sound is {total.middle_text(rounding.level)} dB(A)"
    )
    return Table(caption, head, rows, frozenset({0, 1, 4}))


def orders_table(results: xr.Dataset, receiver: str) -> Table:
    """The leading paths of each of the loudest orders."""
    shares = at_path_speed(results, receiver)["path_order_share"].transpose("path_order", "path")
    level = _order_level(results, receiver).sel(path_order=shares["path_order"]).values
    loudest = np.argsort(-level, kind="stable")[:_ORDERS]
    rows = []
    for index in sorted(index for index in loudest if level[index] >= rounding.LEVEL_FLOOR_DB):
        share = shares.values[index]
        order, first = f"{shares['path_order'].values[index]:g}×", int(np.argmax(share))
        rows.append(
            (order, rounding.level(float(level[index])), _with_share(results, first, share))
        )
    head = ("Order", "Level, dB", "Path with the largest share")
    return Table(f"{receiver}: loudest orders", head, tuple(rows), frozenset({0, 2}))


def _order_level(results: xr.Dataset, *receivers: str) -> xr.DataArray:
    """Levels of the orders at which paths are separated, without an option, dB."""
    coordinates = {"option": REFERENCE_OPTION, "speed": path_speed(results), "weighting": "Z"}
    level = results["order_level"].sel(coordinates, drop=True).rename(order="path_order")
    level = level.sel(path_order=results["path_order"])
    return level.sel(receiver=receivers[0]) if receivers else level


def path_data(results: xr.Dataset) -> dict[str, DataTable]:
    """Return the paths without an option, at one speed their bands, orders and motions; feet."""
    here = results.sel(path_speed=path_speed(results))
    named = {name: here[name] for name in PARTS_OF_PATH}
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
                "level_db": here["path_order_level"],
                "cosine_to_sum": here["path_order_cosine"],
                "share": here["path_order_share"],
                "order_level_db": _order_level(results),
            },
        ),
        "feet.csv": _feet(results),
    }
    if has_motions(results):
        columns = {"receiver": here["receiver"], "motion": here["radiating_motion"]}
        share = here["motion_share"].transpose("receiver", "radiating_motion")
        values = {"level_dba": here["motion_level"], "share": share}
        values["share_so_far"] = _so_far(share)
        dims = ("receiver", "radiating_motion")
        files["path_motions.csv"] = data_table(dims, {**columns, **values})
    return files


def _feet(results: xr.Dataset) -> DataTable:
    forces = foot_forces(results, path_speed(results))
    columns = {dim: forces[dim] for dim in ("foot", "axis", "order", "source")}
    values = {"peak_n": abs(forces), "all_sources_peak_n": abs(forces.sum("source"))}
    return data_table(tuple(columns), {**columns, **values})


def _so_far(share: xr.DataArray) -> xr.DataArray:
    """Running sums along the last dimension, the largest shares of whatever sign first."""
    order = np.argsort(-np.abs(share.values), axis=-1, kind="stable")
    running = np.cumsum(np.take_along_axis(share.values, order, -1), axis=-1)
    return share.copy(data=np.take_along_axis(running, np.argsort(order, axis=-1), -1))


def paths_data(results: xr.Dataset) -> DataTable:
    """One row per speed, microphone and path, without an option."""
    dims = ("path_speed", "receiver", "path")
    share = results["path_share"].transpose(*dims)
    heads = ("speed_rpm", "receiver", "source", "port", "direction")
    columns = {
        **{
            head: results[name]
            for head, name in zip(heads, (*dims[:2], *PARTS_OF_PATH), strict=True)
        },
        "level_dba": results["path_level"],
        "share_of_modelled_energy": share,
        "share_so_far": _so_far(share),
        "cosine_to_sum": results["path_cosine"],
    }
    return data_table(dims, columns)


def _blocks(results: xr.Dataset) -> list[Block]:
    receiver, speed = catalogue_receiver(results), path_speed(results)
    samples = " Shares and phases are means over the samples."
    means = samples if has_samples(results) else ""
    blocks: list[Block] = [
        Text(leading_sentence(results, receiver), "strong"),
        Text(
            "A path is a source, the part it acts on and a direction. Lines of one frequency add "
            "as phasors, so shares can be negative and add up to 100 %. Its phase to the sum is a "
            f"cosine: +1 works with it, −1 against it.{means}",
            "note",
        ),
        paths_table(results, receiver),
        Pictures((path_shares(results, receiver),)),
        orders_table(results, receiver),
        Text(
            "Other microphones and speeds are in paths.csv, bands and orders in path_bands.csv "
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
