"""Designs whose loads and matrices are sums of products: chunk by chunk."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Final

from ...base.arrays import Array
from .expansion import Expansion
from .fixed_mounts import FixedMounts, is_fixed
from .hearing import HEARING, Spectrum
from .on_mounts import Lines, seen_of, spectra_of
from .seen import Need, Seen

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
        lines: tuple[Lines, ...],
        expansions: Sequence[Expansion],
        designs: Array,
    ) -> "LinearDesigns":
        """Prepared for what is asked.

        Parameters
        ----------
        needs : what is asked
        lines : by speed
        expansions : by speed, last that of the body
        designs : that fill the space, shape (design, variable)
        """
        *by_speed, body = expansions
        fixed = None
        if is_fixed(by_speed, body):
            expansions = [replace(one, factors={}) for one in expansions]  # large
            fixed = FixedMounts.of(needs, lines, by_speed, body, designs)
        return cls(needs, lines, tuple(expansions), fixed)

    def seen(self, values: Array) -> Iterator[tuple[slice, Seen, list[Spectrum]]]:
        """What is seen of designs, shape (design, variable), chunk by chunk.

        The spectra are empty where neither loudness nor audibility is asked for.
        """
        for first in range(0, len(values), self.chunk):
            part = slice(first, min(first + self.chunk, len(values)))
            yield part, *self._of_chunk(values[part])

    @property
    def chunk(self) -> int:
        """Number of designs that are computed side by side."""
        if self.fixed is None:
            return chunk_of(self.needs, self.lines)
        return chunk_of(self.needs, self.lines, 4 * len(self.expansions[0].terms.products))

    def _of_chunk(self, values: Array) -> tuple[Seen, list[Spectrum]]:
        is_heard = any(need in HEARING for need in self.needs)
        if self.fixed is not None:
            spectra = self.fixed.spectra_of(values) if is_heard else []
            return self.fixed.seen(self.needs, values), spectra
        *by_speed, body = (expansion.at(values) for expansion in self.expansions)
        designs = self.lines, by_speed, body, len(values)
        return seen_of(self.needs, *designs), spectra_of(*designs) if is_heard else []


def chunk_of(needs: Sequence[Need], lines: Sequence[Lines], numbers: int | None = None) -> int:
    """Return the number of designs that are computed side by side.

    Parameters
    ----------
    needs : what is asked
    lines : by speed
    numbers : that each design takes; those of its lines where not given
    """
    pairs = [1 if one.gains is None else one.gains.added.size for one in lines]
    lines_and_pairs = max(one.order.size for one in lines) * max(pairs)
    most = 32 * lines_and_pairs if numbers is None else numbers
    if any(need in HEARING for need in needs):
        most = max(most, 8 * lines[0].receivers * lines_and_pairs)
    return max(int(CHUNK_BYTES / (8.0 * most)), 1)
