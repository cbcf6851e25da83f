"""Two charts of the first screen; forces, lines and the machine folded."""

import xarray as xr

from ....base.registry import register
from ....results.left_out import lines_of
from ....results.stored_study import parameters
from ....results.version_2 import RAISED
from ...blocks import Beside, Block, Bullets, Details, Pictures, Text
from ...drawing import machine_picture
from ...option_verdict import option_verdicts
from .. import Section
from ..scores.words import ranking_sentence
from . import words as first_screen
from .charts import lights


def _blocks(results: xr.Dataset) -> list[Block]:
    return [
        *left_out_words(results),
        *coarse_words(results),
        *_charts(results),
        *_details(results),
    ]


def left_out_words(results: xr.Dataset) -> list[Block]:
    """Say what is omitted, as it failed or was not wanted; nothing where nothing is."""
    lines = lines_of(results)
    return [Text("This report is not complete:"), Bullets(tuple(lines))] if lines else []


def coarse_words(results: xr.Dataset) -> list[Block]:
    """What was made coarser for a first look; nothing of a run as its study says."""
    coarsened = parameters(results).get("coarsened", ())
    first = "This is a first look, coarser than the study says:"
    blocks: list[Block] = [Text(first), Bullets(tuple(coarsened))] if coarsened else []
    if RAISED in results.attrs:
        blocks.append(Text("Made by an earlier version: values without an interval are nominal."))
    return blocks


def _charts(results: xr.Dataset) -> list[Block]:
    contributions, changes = first_screen.contributions(results), first_screen.changes(results)
    return [contributions] if changes is None else [Beside(contributions, changes)]


def _details(results: xr.Dataset) -> list[Block]:
    """The machine, and each option's forces and lines."""
    picture, chart = machine_picture(results), lights(results)
    blocks: list[Block] = [Pictures((picture,))] if picture else []
    if chart is not None:
        blocks += [chart, Text(ranking_sentence(results, option_verdicts(results)))]
    return [Details("Machine, 1× forces and lines, ranking", tuple(blocks))] if blocks else []


register(Section("verdict", "Summary", _blocks, position=10.0, folded=False))
