"""Files both ways with other programs: the table of the page `peers` is what came of it."""

import pytest
from peers import cells, committed, rows, versions

pytest.importorskip("asammdf")
KNOWN = ("right", "refused: ")
AT_FAULT = {
    ("vibroacoustics", "soundfile"): "m/s",  # it decodes Latin-1 as UTF-8
    ("asammdf", "vibroacoustics"): "asammdf wrote half of the numbers; a remark says so",
}
"""Words of outcomes that are neither right nor refused, by the program at fault."""


def test_the_table_is_what_came_of_each_file():
    outcomes = {cell: cell.outcome() for cell in cells()}
    assert len(outcomes) >= 60
    for cell, outcome in outcomes.items():
        words = AT_FAULT.get((cell.writer, cell.reader), "\n")
        assert outcome.startswith(KNOWN) or words in outcome, (cell[:3], outcome)
    if committed()[-len(versions()) :] == versions():
        assert committed()[: -len(versions())] == rows(outcomes)
