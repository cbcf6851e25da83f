"""What is asked of designs, and what is seen of them."""

from collections.abc import Mapping
from typing import Final, Literal, NamedTuple

from ...base.arrays import Array


class Need(NamedTuple):
    """Something that figures are made of.

    Attributes
    ----------
    what : sound (mean square, Pa², by receiver; of an order, or A-weighted of everything), force
        and moment on the machine, foot (force into each), figure (reported), natural (frequencies),
        loudness (sone) and audibility (of tones, dB) by receiver, criterion (of scorings)
    order : of sound, force, moment and foot; none for all sound
    name : of the reported figure or the criterion

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
"""What an engine gives of each pair of a discrepancy and an unmodelled level."""
Seen = Mapping[Need, Array]
"""By need, (design, speed, ...): receivers of sound, feet; of `natural` (design, mode), Hz.

An engine gives what is `PAIRED` as (design, pair, speed, receiver); a figure sees each pair as a
design.
"""
