"""What a hammer test of the shell tells: before and after."""

import xarray as xr

from ....base.registry import register
from ...blocks import Block, Text
from .. import Section
from . import tables as shell_test


def _blocks(results: xr.Dataset) -> list[Block]:
    return [
        Text(shell_test.test_sentence(results)),
        Text(shell_test.peaks_sentence(results)),
        shell_test.before_and_after(results),
        Text(shell_test.samples_sentence(results), "note"),
    ]


register(Section("shell-test", "The shell, by hammer", _blocks, shell_test.applies, 34.0))
