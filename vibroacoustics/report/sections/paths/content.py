"""Which way the sound comes: paths from sources to microphones, forces into the feet."""

import xarray as xr

from ....base.registry import register
from ....results.stored_study import catalogue_receiver, other_receivers
from ...blocks import Block, Details, Heading, Pictures, Text
from ...figures.paths import foot_bars, path_shares
from .. import Section
from .tables import (
    bands_table,
    foot_orders,
    foot_table,
    has_motions,
    has_paths,
    leading_sentence,
    loudest_order,
    motions_table,
    options_table,
    orders_table,
    partial_sums_table,
    path_speed,
    paths_table,
)


def _blocks(results: xr.Dataset) -> list[Block]:
    receiver, speed = catalogue_receiver(results), path_speed(results)
    return [
        Text(leading_sentence(results, receiver), "strong"),
        Text(
            "A path is a source, where it acts and in which direction: motions of the housing as a "
            "rigid body, loads on parts in an elastic shell, flows into its gas. Lines of one "
            "frequency add as phasors: a path that works against the sum has a negative share, and "
            "shares add up to 100 %. In a run with samples the paths are those of the "
            "representative sample without discrepancy. Unmodelled noise is in no path.",
            "note",
        ),
        *_of_receiver(results, receiver),
        *(
            Details(f"Paths to {other}", tuple(_of_receiver(results, other)))
            for other in other_receivers(results)
        ),
        options_table(results, receiver),
        *(_of_feet(results, speed) if foot_orders(results, speed) else ()),
    ]


def _of_feet(results: xr.Dataset, speed: float) -> list[Block]:
    return [
        Heading("Forces into the feet"),
        foot_table(results, speed),
        Pictures((foot_bars(results, speed),)),
    ]


def _of_receiver(results: xr.Dataset, receiver: str) -> list[Block]:
    order = loudest_order(results, receiver)
    return [
        paths_table(results, receiver),
        Pictures((path_shares(results, receiver),)),
        *([motions_table(results, receiver)] if has_motions(results) else ()),
        orders_table(results, receiver),
        partial_sums_table(results, receiver, order),
        Details(f"By third octave at {receiver}", (bands_table(results, receiver),)),
    ]


register(Section("paths", "Which way the sound comes", _blocks, has_paths, 32.0))
