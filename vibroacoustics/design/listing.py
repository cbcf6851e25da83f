"""Designs of a grid or a sample by number, made block by block: none is kept."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from ..base.arrays import Array, IndexArray

BLOCK: Final = 131_072
"""Designs that are listed at a time."""


@dataclass(frozen=True)
class Listing:
    """Designs of a sweep.

    Attributes
    ----------
    count : number of designs
    designs : function that gives the designs of some numbers, shape (design, variable), SI
    ordered : function that gives the numbers at some positions of the order of evaluation
    """

    count: int
    designs: Callable[[IndexArray], Array]
    ordered: Callable[[IndexArray], IndexArray]

    def blocks(self) -> Iterator[IndexArray]:
        """Give all numbers, block by block, in their order."""
        for first in range(0, self.count, BLOCK):
            yield np.arange(first, min(first + BLOCK, self.count), dtype=np.intp)


def listed_grid(axes: Sequence[Array], slow: Sequence[int]) -> Listing:
    """List all combinations of values, numbered with the last variable fastest.

    Parameters
    ----------
    axes : values of each variable
    slow : numbers of the variables that vary slowest in the order of evaluation
    """
    shape = tuple(axis.size for axis in axes)
    order = [*slow, *(number for number in range(len(axes)) if number not in slow)]

    def designs(numbers: IndexArray) -> Array:
        indices = np.unravel_index(numbers, shape)
        return np.stack([axis[n] for axis, n in zip(axes, indices, strict=True)], axis=1)

    def ordered(positions: IndexArray) -> IndexArray:
        indices = dict(zip(order, np.unravel_index(positions, [shape[n] for n in order]),
                          strict=True))  # fmt: skip
        return np.ravel_multi_index([indices[n] for n in range(len(shape))], shape)

    return Listing(int(np.prod(shape)), designs, ordered)


def listed_sample(designs: Array, slow: Sequence[int]) -> Listing:
    """List the designs of a sample.

    Parameters
    ----------
    designs : shape (design, variable), SI
    slow : numbers of the variables that vary slowest in the order of evaluation
    """
    order = np.lexsort(designs[:, slow[::-1]].T) if slow else None
    return Listing(
        len(designs), designs.__getitem__, (lambda n: n) if order is None else order.__getitem__
    )
