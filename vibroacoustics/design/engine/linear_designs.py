"""Designs whose loads and matrices are sums of products: chunk by chunk."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Final

from ...base.arrays import Array
from .expansion import Expansion
from .fixed_mounts import FixedMounts, is_fixed
from .hearing import HEARING, Spectrum
from .needs import Need, ResponsesByNeed
from .on_mounts import Lines, seen_of, spectra_of

CHUNK_BYTES: Final = 32e6
"""Size of the largest array of designs that are computed side by side."""


@dataclass(frozen=True)
class LinearDesigns:
    """Designs that differ in variables with a basis only.

    Attributes
    ----------
    needs : requested responses
    lines : lines by speed
    expansions : expansions by speed, last that of the body; without arrays on the same mounts
    fixed : designs on the same mounts; none where mounts differ
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
        """Prepare designs for the requested responses.

        Parameters
        ----------
        needs : requested responses
        lines : lines by speed
        expansions : expansions by speed, last that of the body
        designs : designs that fill the space, shape (design, variable)
        """
        *by_speed, body = expansions
        fixed = None
        if is_fixed(by_speed, body):
            expansions = [replace(part, factors={}) for part in expansions]  # large
            fixed = FixedMounts.of(needs, lines, by_speed, body, designs)
        return cls(needs, lines, tuple(expansions), fixed)

    def results(self, values: Array) -> Iterator[tuple[slice, ResponsesByNeed, list[Spectrum]]]:
        """Compute the responses of designs, shape (design, variable), chunk by chunk.

        The spectra are empty where neither loudness nor audibility is requested.
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

    def _of_chunk(self, values: Array) -> tuple[ResponsesByNeed, list[Spectrum]]:
        is_heard = any(need in HEARING for need in self.needs)
        if self.fixed is not None:
            spectra = self.fixed.spectra_of(values) if is_heard else []
            return self.fixed.results(self.needs, values), spectra
        *by_speed, body = (expansion.arrays_of(values) for expansion in self.expansions)
        designs = self.lines, by_speed, body, len(values)
        return seen_of(self.needs, *designs), spectra_of(*designs) if is_heard else []


def chunk_of(needs: Sequence[Need], lines: Sequence[Lines], numbers: int | None = None) -> int:
    """Return the number of designs that are computed side by side.

    Parameters
    ----------
    needs : requested responses
    lines : lines by speed
    numbers : number of values of each design; by default those of its lines
    """
    pairs = [1 if speed.gains is None else speed.gains.added.size for speed in lines]
    lines_and_pairs = max(speed.order.size for speed in lines) * max(pairs)
    most = 32 * lines_and_pairs if numbers is None else numbers
    if any(need in HEARING for need in needs):
        most = max(most, 8 * lines[0].receivers * lines_and_pairs)
    return max(int(CHUNK_BYTES / (8.0 * most)), 1)
