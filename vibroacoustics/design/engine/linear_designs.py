"""Designs whose loads and matrices are sums of products: chunk by chunk."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Final

from ...base.arrays import Array
from .deviating import Gains
from .expansion import Expansion
from .fixed_mounts import FixedMounts, is_fixed
from .hearing import HEARING
from .on_mounts import Lines, lines_of_speed, seen_of
from .probe import Probe
from .seen import Need
from .sound_way import SoundWay

CHUNK_BYTES: Final = 32e6
"""Of the largest array of designs that are computed side by side."""


@dataclass(frozen=True)
class LinearDesigns:
    """Designs that differ in variables with a basis only.

    Attributes
    ----------
    needs : what is asked
    lines : by speed
    expansions : by speed, last that of the body; without arrays on the same mounts
    fixed : where all stand on the same mounts
    """

    needs: tuple[Need, ...]
    lines: tuple[Lines, ...]
    expansions: tuple[Expansion, ...]
    fixed: FixedMounts | None

    @classmethod
    def of(
        cls,
        needs: tuple[Need, ...],
        probe: Probe,
        speeds_rpm: Sequence[float],
        expansions: Sequence[Expansion],
        way: SoundWay,
        gains: Sequence[Gains | None],
        unmodelled: Sequence[Array | None],
        designs: Array,
    ) -> "LinearDesigns":
        """Prepared for what is asked.

        Parameters
        ----------
        needs : what is asked
        probe : of any of the designs
        speeds_rpm : of the study
        expansions : by speed, last that of the body
        way : to the microphones
        gains : of the sample by speed; none of the nominal machine
        unmodelled : noise by speed, shape (pair, receiver, band), Pa²; none where not asked for
        designs : that fill the space, shape (design, variable)
        """
        each = zip(speeds_rpm, probe.frequency_hz, probe.order, strict=True)
        beside = zip(gains, unmodelled, strict=True)
        lines = tuple(
            lines_of_speed(*one, way, *two) for one, two in zip(each, beside, strict=True)
        )
        *by_speed, body = expansions
        fixed = None
        if is_fixed(by_speed, body):
            expansions = [replace(one, factors={}) for one in expansions]  # large
            fixed = FixedMounts.of(needs, lines, by_speed, body, designs)
        return cls(needs, lines, tuple(expansions), fixed)

    def seen(self, values: Array) -> Iterator[tuple[slice, dict[Need, Array]]]:
        """What is seen of designs, shape (design, variable), chunk by chunk."""
        for first in range(0, len(values), self.chunk):
            part = slice(first, min(first + self.chunk, len(values)))
            yield part, self._of_chunk(values[part])

    @property
    def chunk(self) -> int:
        """Number of designs that are computed side by side."""
        if self.fixed is not None:
            numbers = 4 * len(self.expansions[0].terms.products)
        else:
            numbers = 32 * self._lines_and_pairs
        if any(need in HEARING for need in self.needs):
            receivers = len(self.lines[0].per_velocity)
            numbers = max(numbers, 8 * receivers * self._lines_and_pairs)
        return max(int(CHUNK_BYTES / (8.0 * numbers)), 1)

    @property
    def _lines_and_pairs(self) -> int:
        """Most lines of a speed times pairs of a discrepancy and an unmodelled level."""
        pairs = [1 if one.gains is None else one.gains.added.size for one in self.lines]
        return max(one.order.size for one in self.lines) * max(pairs)

    def _of_chunk(self, values: Array) -> dict[Need, Array]:
        if self.fixed is not None:
            return self.fixed.seen(self.needs, values)
        *by_speed, body = (expansion.at(values) for expansion in self.expansions)
        return seen_of(self.needs, self.lines, by_speed, body, len(values))
