"""Why the verdict is as it is, and what each option does."""

import xarray as xr

from ....base.registry import register
from ...blocks import Block, Text
from ...option_verdict import option_verdicts
from .. import Section
from . import words


def _blocks(results: xr.Dataset) -> list[Block]:
    table = words.options_table(option_verdicts(results))
    return [*map(Text, words.reasons(results)), *filter(None, [table])]


register(Section("reasons", "Forces and options", _blocks, position=15.0))
