"""What balancing does, in a few sentences, and what each option does."""

from collections.abc import Sequence

import xarray as xr

from ...base.registry import register
from .. import extremes, verdict
from ..blocks import Block, Bullets, Definition, Definitions, Heading, Text
from ..option_verdict import OptionVerdict, option_verdicts
from ..study import parameters
from . import Section


def _blocks(results: xr.Dataset) -> list[Block]:
    table = extremes.extremes_table(results)
    verdicts = option_verdicts(results)
    return [
        Text(verdict.headline(results), "headline"),
        *coarse_words(results),
        Bullets(tuple(verdict.reasons(results, verdicts))),
        *filter(None, [verdict.options_table(verdicts), table]),
        *_options(verdicts),
    ]


def coarse_words(results: xr.Dataset) -> list[Block]:
    """What was made coarser for a first look; nothing of a run as its study says."""
    coarsened = parameters(results).get("coarsened", ())
    first = "This is a first look, coarser than the study says:"
    return [Text(first), Bullets(tuple(coarsened))] if coarsened else []


def _options(verdicts: Sequence[OptionVerdict]) -> list[Block]:
    entries = tuple(
        Definition(of_option.option, of_option.judgement, " ".join(of_option.sentences))
        for of_option in verdicts
    )
    title = Heading("Option by option, against no balancer")
    return [title, Definitions(entries)] if entries else []


register(Section("verdict", "Verdict", _blocks, position=10.0))
