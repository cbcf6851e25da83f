"""Why the verdict is as it is, and what each option does."""

from collections.abc import Sequence

import xarray as xr

from ....base.registry import register
from ...blocks import Block, Bullets, Definition, Definitions, Heading
from ...option_verdict import OptionVerdict, option_verdicts
from .. import Section
from . import tables as extremes
from . import words as verdict


def _blocks(results: xr.Dataset) -> list[Block]:
    verdicts = option_verdicts(results)
    tables = (verdict.options_table(verdicts), extremes.extremes_table(results))
    return [
        Bullets(tuple(verdict.reasons(results, verdicts))),
        *filter(None, tables),
        *_options(verdicts),
    ]


def _options(verdicts: Sequence[OptionVerdict]) -> list[Block]:
    entries = tuple(
        Definition(of_option.option, of_option.judgement, " ".join(of_option.sentences))
        for of_option in verdicts
    )
    title = Heading("Option by option, against no balancer")
    return [title, Definitions(entries)] if entries else []


register(Section("reasons", "Reasons, and each option in words", _blocks, position=15.0))
