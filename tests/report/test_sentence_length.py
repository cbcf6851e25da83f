"""No sentence of a report has more than 25 words, but for lists of several values."""

import re
from collections.abc import Iterator

import pytest
import xarray as xr
from support import tiny_run
from test_first_screens import KINDS

from vibroacoustics.report import render

MOST_WORDS = 25
LISTS = (
    "Number of parameters with a resolved share",
    "Dominant paths to ", "Without a balancer the 1× force and moment ",
    "Waves and the diffuse field of the power in the open differ by more than ",
)  # fmt: skip
"""Sentences that list names of paths, or values by speed or frequency."""


def long_sentences(page: str) -> Iterator[str]:
    """Sentences of a report in Markdown with too many words; tables and headings have none."""
    for line in page.splitlines():
        if not line.startswith(("|", "#", "!")):
            for sentence in re.split(r"(?<=[.!?])\s+(?=\S)", line.strip("-* ")):
                if len(sentence.split()) > MOST_WORDS and not sentence.startswith(LISTS):
                    yield sentence


@pytest.mark.parametrize("results", [tiny_run, *KINDS.values()], ids=["tiny", *KINDS])
def test_no_sentence_is_long(results) -> None:
    run: xr.Dataset = results()
    (page,) = [content for name, content in render(run).items() if name.endswith(".md")]
    assert not list(long_sentences(page.decode()))


def test_a_long_sentence_is_seen() -> None:
    long = "word " * MOST_WORDS + "word."
    assert list(long_sentences(f"Short. {long}")) == [long]
    assert not list(long_sentences(f"| {long} |"))
