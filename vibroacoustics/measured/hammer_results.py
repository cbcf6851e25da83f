"""Results of a hammer test from its time records."""

from dataclasses import dataclass, replace

import numpy as np

from ..base.arrays import Array
from ..recordings import MeasuredFunction, Node


@dataclass(frozen=True)
class HitOutcome:
    """Outcome of one hit.

    Attributes
    ----------
    file : name of its file
    reference : node and direction of the push
    time_s : time of its peak
    force_n : force at its peak
    omitted : reason why it is in no function; empty if it is in one
    """

    file: str
    reference: Node
    time_s: float
    force_n: float
    omitted: str


@dataclass(frozen=True)
class HammerFunction:
    """Function of one pair of points, over the hits.

    Attributes
    ----------
    h1, h2 : frequency responses
    coherence, scatter : shape (frequency,); of one hit not a number
    hits : number of hits
    """

    h1: MeasuredFunction
    h2: MeasuredFunction
    coherence: Array
    scatter: Array
    hits: int


@dataclass(frozen=True)
class HammerResults:
    """Results of a hammer test.

    Attributes
    ----------
    title : title of its settings
    pairs : a function for each response and reference
    hits : all hits that were found, used or not
    faults : a line for each fault of the records that leaves functions wrong
    remarks : a line for each fault that was corrected
    block_s : length of the blocks

    Examples
    --------
    >>> test = va.hammer_test("bench/hammer.toml")
    >>> [hit.omitted for hit in test.hits], test.faults
    (['', '', '', '', '', ''], ())
    """

    title: str
    pairs: tuple[HammerFunction, ...]
    hits: tuple[HitOutcome, ...]
    faults: tuple[str, ...]
    remarks: tuple[str, ...]
    block_s: float

    @property
    def functions(self) -> list[MeasuredFunction]:
        """H1 and coherence of each pair, as `predict` and `blocked_forces` read them."""
        functions: list[MeasuredFunction] = []
        for pair in self.pairs:
            functions.append(pair.h1)
            if pair.hits > 1:
                functions.append(replace(
                    pair.h1, kind="coherence", values=np.asarray(pair.coherence + 0j),
                    response_unit="1", reference_unit="",
                ))  # fmt: skip
        return functions
