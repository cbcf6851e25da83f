"""Responses of designs: requests and arrays."""

from collections.abc import Mapping
from typing import Final, Literal, NamedTuple

from ...base.arrays import Array


class Need(NamedTuple):
    """Response of designs on which figures depend.

    Attributes
    ----------
    what : sound (mean square, Pa², by receiver; of an order, or A-weighted of everything), force
        and moment on the machine, foot (force into each), figure (reported), natural (frequencies),
        loudness (sone) and audibility (of tones, dB) by receiver, criterion (of scorings)
    order : order of sound, force, moment and foot; none for all sound
    name : name of the reported figure or the criterion

    Examples
    --------
    >>> va.Need("force", 2).order
    2
    """

    what: Literal[
        "sound", "force", "moment", "foot", "figure", "natural", "loudness", "audibility",
        "criterion",
    ]  # fmt: skip
    order: int | None = None
    name: str = ""


PAIRED: Final = ("sound", "loudness", "audibility")
"""Responses that an engine gives for each pair of a discrepancy and an unmodelled level."""
ResponsesByNeed = Mapping[Need, Array]
"""Responses by need, (design, speed, ...): receivers of sound, feet; (design, mode), Hz, of
`natural`.

An engine gives those of `PAIRED` as (design, pair, speed, receiver); a figure takes each pair as
a design.
"""
