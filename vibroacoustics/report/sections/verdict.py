"""What balancing does, in a few sentences, and what each option does."""

import xarray as xr

from ...base.registry import register
from .. import verdict
from ..blocks import Block, Bullets, Definition, Definitions, Heading, Text
from ..option_verdict import option_verdicts
from . import Section


def _blocks(results: xr.Dataset) -> list[Block]:
    table = verdict.extremes_table(results)
    return [
        Text(verdict.headline(results), "headline"),
        Bullets(tuple(verdict.reasons(results))),
        *([table] if table else []),
        *_options(results),
    ]


def _options(results: xr.Dataset) -> list[Block]:
    entries = tuple(
        Definition(of_option.option, of_option.judgement, " ".join(of_option.sentences))
        for of_option in option_verdicts(results)
    )
    title = Heading("Option by option, against no balancer")
    return [title, Definitions(entries)] if entries else []


register(Section("verdict", "Verdict", _blocks, position=10.0))
