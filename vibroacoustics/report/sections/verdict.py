"""The first screen: what balancing does, in one sentence, one drawing and one chart."""

import xarray as xr

from ...base.registry import register
from ...results.left_out import lines_of
from .. import verdict
from ..blocks import Beside, Block, Bullets, Pictures, Text
from ..drawing import machine_picture
from ..lights import lights
from ..option_verdict import option_verdicts
from ..ranking_words import ranking_sentence
from ..study import parameters
from . import Section


def _blocks(results: xr.Dataset) -> list[Block]:
    return [
        Text(verdict.headline(results), "headline"),
        *left_out_words(results),
        *coarse_words(results),
        *_drawing_and_chart(results),
    ]


def left_out_words(results: xr.Dataset) -> list[Block]:
    """Say what is omitted, as it failed or was not wanted; nothing where nothing is."""
    lines = lines_of(results)
    return [Text("This report is not complete:"), Bullets(tuple(lines))] if lines else []


def coarse_words(results: xr.Dataset) -> list[Block]:
    """What was made coarser for a first look; nothing of a run as its study says."""
    coarsened = parameters(results).get("coarsened", ())
    first = "This is a first look, coarser than the study says:"
    return [Text(first), Bullets(tuple(coarsened))] if coarsened else []


def _drawing_and_chart(results: xr.Dataset) -> list[Block]:
    picture, chart = machine_picture(results), lights(results)
    if chart is None:
        return [Pictures((picture,))] if picture else []
    ranking = Text(ranking_sentence(results, option_verdicts(results)))
    if picture is None:
        return [chart, ranking]
    return [Beside(Pictures((picture,)), chart), ranking]


register(Section("verdict", "Verdict", _blocks, position=10.0, folded=False))
