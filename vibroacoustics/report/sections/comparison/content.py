"""Every option beside every other: forces, levels and their changes."""

import xarray as xr

from ....base.registry import register
from ....base.rounding import FORCE_FLOOR, LEVEL_FLOOR_DB, fixed
from ....results.stored_study import catalogue_receiver, has_sources, other_receivers, overall_noise
from ...blocks import Block, Details, Heading, Text
from ...kept_columns import columns_of
from ...remainder import total_sentence
from ...shown_speeds import chosen_speeds
from .. import Section
from .tables import bands_sentence, comparison_tables


def _blocks(results: xr.Dataset) -> list[Block]:
    receiver, published = catalogue_receiver(results), overall_noise(results)
    return [
        _legend(results),
        *chosen_speeds(results, "comparison.csv"),
        *(Text(line, "note") for line in columns_of(results).left_out),
        Heading(f"{'Microphone of the overall level' if published else 'Microphone'}: {receiver}"),
        *comparison_tables(results, receiver),
        *(
            Details(f"Microphone {name}", tuple(comparison_tables(results, name)))
            for name in other_receivers(results)
        ),
    ]


def _legend(results: xr.Dataset) -> Text:
    sources = (
        f" Modelled and total levels include all sources. {bands_sentence(results)} Those of "
        "each source are in What carries the level."
        if has_sources(results)
        else ""
    )
    links = [
        ("assumptions", "assumptions"),
        *([("What carries the level", "sources")] if sources else []),
    ]
    floor = f"{1e6 * FORCE_FLOOR:g}"
    return Text(
        "1× and 2× are once and twice per shaft revolution. Forces (N) and moments (N m, about "
        "the centre of mass) are peak values: the semi-major axis of the ellipse that the "
        "resultant draws. The foot force is the largest over the feet. Values below "
        f"{floor} µN or µN m are rounding errors and shown as 0. Levels are in dB re 20 µPa, rms; "
        f"below {fixed(LEVEL_FLOOR_DB, 0)} dB they are silent. {total_sentence(results)}{sources} "
        "Δ is the change against none; “–” stands where the line without a balancer is silent, "
        "“silent” where the option silences it.",
        "note",
        tuple(links),
    )


register(Section("comparison", "Comparison", _blocks, position=20.0))
