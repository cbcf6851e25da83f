"""Designs as products of loads, paths and bodies, or as sums of products chunk by chunk."""

from collections.abc import Callable, Hashable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from ...base.arrays import Array, ComplexArray, IndexArray
from ...base.errors import ParameterError, SolverError
from .contraction import Contraction, Layouts
from .expansion import Expansion
from .fixed_mounts import FixedMounts, is_fixed
from .hearing import HEARING, Spectrum
from .needs import Need, ResponsesByNeed
from .on_mounts import Lines, seen_of, spectra_of
from .probe import LoadsOfDesign, Parts, Stand
from .sound_path import PathOfDesign

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


LinesOf = Callable[[Layouts, PathOfDesign], tuple[Lines, ...]]
Joined = Iterator[tuple[IndexArray, ResponsesByNeed | Exception, list[Spectrum]]]
"""Numbers of designs, their responses, shape (design, ...), or why they failed, and their
spectra where loudness or audibility is requested."""


def joined_designs(
    contraction: Contraction, designs: Array, lines_of: LinesOf, needs: Sequence[Need]
) -> Joined:
    """Compute designs, those side by side that are alike but for the values of their arrays.

    Parameters
    ----------
    contraction : loads, paths and bodies of the designs
    designs : values of the designs, shape (design, variable)
    lines_of : makes the lines of all speeds from their layout and the path of a design
    needs : requested responses, without criteria
    """
    loads, on_loads = contraction.loads.of_each(designs)
    for rows, alike in _by_kind(loads, on_loads, _kind_of_loads):
        first = loads[alike[0]]
        if isinstance(first, Exception):
            yield rows, first, []
            continue
        parts = zip(*(loads[number].by_speed for number in alike), strict=True)
        stacks = [_stack(speed) for speed in parts]
        on_stack, layout = np.searchsorted(alike, on_loads[rows]), first.layout
        paths, on_path = contraction.paths(layout).of_each(designs[rows])
        stands, on_stand = contraction.stands(layout).of_each(designs[rows])
        for some, (number, *_) in _by_kind(paths, on_path, id):
            path = paths[number]
            if isinstance(path, Exception):
                yield rows[some], path, []
                continue
            try:
                lines = lines_of(layout, path)
            except (ParameterError, SolverError) as error:
                yield rows[some], error, []
                continue
            for members, stand in _by_kind(stands, on_stand[some], _kind_of_stand):
                of_stand = some[members]
                each = [stands[number] for number in stand]
                on_each = np.searchsorted(stand, on_stand[of_stand])
                of_path = _seen(needs, lines, stacks, on_stack[of_stand], each, on_each)
                for part, figures, spectra in of_path:
                    yield rows[of_stand[part]], figures, spectra


def _seen(
    needs: Sequence[Need],
    lines: Sequence[Lines],
    loads: Sequence[Parts],
    on_loads: IndexArray,
    stands: Sequence[Stand | Exception],
    on_stand: IndexArray,
) -> Iterator[tuple[slice, ResponsesByNeed | Exception, list[Spectrum]]]:
    """Compute designs of one path, chunk by chunk.

    Parameters
    ----------
    needs, lines : see `seen_of`
    loads : arrays by speed, shape (different loads, ...)
    on_loads : number of the loads of each design, shape (design,)
    stands : different bodies
    on_stand : number of the body of each design, shape (design,)
    """
    size, chunk = len(on_loads), chunk_of(needs, lines)
    if isinstance(stands[0], Exception):
        yield slice(0, size), stands[0], []
        return
    bodies = [stand for stand in stands if isinstance(stand, Stand)]
    body = _stack([stand.body for stand in bodies])
    added = [_stack(speed) for speed in zip(*(stand.by_speed for stand in bodies), strict=True)]
    for first in range(0, size, chunk):
        part = slice(first, min(first + chunk, size))
        by_speed = [
            {**_taken(load, on_loads[part]), **_taken(more, on_stand[part])}
            for load, more in zip(loads, added, strict=True)
        ]
        designs = lines, by_speed, _taken(body, on_stand[part]), part.stop - first
        try:
            spectra = spectra_of(*designs) if any(need in HEARING for need in needs) else []
            yield part, seen_of(needs, *designs), spectra
        except (ParameterError, SolverError) as error:
            yield part, error, []


def _by_kind(
    results: Sequence[object], number: IndexArray, kind_of: Callable[[object], Hashable]
) -> Iterator[tuple[IndexArray, IndexArray]]:
    """Give rows whose results are of one kind, and the numbers of these results."""
    kinds: dict[Hashable, list[int]] = {}
    for index, result in enumerate(results):
        kinds.setdefault(kind_of(result), []).append(index)
    of_result = np.zeros(len(results), dtype=np.intp)
    for kind, members in enumerate(kinds.values()):
        of_result[members] = kind
    of_row = of_result[number]
    for kind, members in enumerate(kinds.values()):
        rows = np.flatnonzero(of_row == kind)
        if rows.size:
            yield rows, np.array(members)


def _kind_of_loads(loads: object) -> Hashable:
    """Return what loads must have in common to be computed side by side."""
    if isinstance(loads, LoadsOfDesign):
        return loads.layout, tuple(map(_shapes, loads.by_speed))
    return id(loads)


def _kind_of_stand(stand: object) -> Hashable:
    if isinstance(stand, Stand):
        return tuple(map(_shapes, (*stand.by_speed, stand.body)))
    return id(stand)


def _shapes(parts: Parts) -> Hashable:
    return tuple((name, np.shape(part)) for name, part in parts.items())


def _stack(parts: Sequence[Parts]) -> dict[str, ComplexArray]:
    """Put arrays side by side, shape (part, ...); (1, ...) of those that are the same."""
    stack = {}
    for name in parts[0]:
        every = np.array([part[name] for part in parts])
        stack[name] = every[:1] if (every == every[:1]).all() else every
    return stack


def _taken(stack: Parts, index: IndexArray) -> dict[str, ComplexArray]:
    """Take the arrays of designs, shape (design or 1, ...)."""
    return {name: array if len(array) == 1 else array[index] for name, array in stack.items()}
