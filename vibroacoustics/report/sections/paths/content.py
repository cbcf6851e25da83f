"""Transfer paths from sources to microphones, forces into the feet."""

import xarray as xr

from ....base.registry import register
from ....results.stored_study import catalogue_receiver
from ...blocks import Block, Heading, Pictures, Text
from ...figures.paths import foot_bars, path_shares
from .. import Section
from .tables import (
    foot_orders,
    has_motions,
    has_paths,
    leading_sentence,
    orders_table,
    path_data,
    path_speed,
    paths_table,
)


def _blocks(results: xr.Dataset) -> list[Block]:
    receiver, speed = catalogue_receiver(results), path_speed(results)
    blocks: list[Block] = [
        Text(leading_sentence(results, receiver), "strong"),
        Text(
            "A path is a source, the part it acts on and a direction. Lines of one frequency add "
            "as phasors, so shares can be negative and add up to 100 %. With samples, paths are "
            "those of the representative sample.",
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
