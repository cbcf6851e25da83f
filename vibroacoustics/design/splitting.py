"""Pieces of designs that are computed together, here and by workers alike."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ..base.arrays import Array
from .engine.option_engine import ON_PATH
from .engine.recognition import Route


@dataclass(frozen=True)
class Splitting:
    """Variables that decide which designs are computed together.

    Attributes
    ----------
    paths : numbers of the variables that change the path from the loads to the microphones
    loads : numbers of the other variables of which every value takes runs
    variables : number of variables of a design; a further column is the number of a run
    most : largest number of designs of a piece
    """

    paths: tuple[int, ...]
    loads: tuple[int, ...]
    variables: int
    most: int

    @classmethod
    def of(cls, routes: Sequence[Sequence[Route]], most: int) -> "Splitting":
        """Sort the variables of designs by their routes.

        Parameters
        ----------
        routes : routes of each variable, by option
        most : largest number of designs of a piece
        """
        numbers = range(len(routes))
        paths = [n for n in numbers if any(route.reason == ON_PATH for route in routes[n])]
        runs = [n for n in numbers if not all(route.linear for route in routes[n])]
        loads = tuple(n for n in runs if n not in paths)
        return cls(tuple(paths), loads, len(routes), most)

    @property
    def slow(self) -> list[int]:
        """Numbers of the variables that take runs, those of the path first."""
        return [*self.paths, *self.loads]

    def pieces(self, designs: Array) -> Iterator[Array]:
        """Split designs into pieces with one path, and with one load that no piece before has.

        A process that computes all pieces makes one run a piece at most. Every numbered run is a
        piece.

        Parameters
        ----------
        designs : shape (design, variable), SI; or (design, variable + 1) of numbered runs
        """
        loads = designs[:, [*self.loads, *range(self.variables, designs.shape[1])]]
        begins = np.zeros(len(designs), dtype=bool)
        if loads.size:
            begins[np.unique(loads, axis=0, return_index=True)[1]] = True
        begins[1:] |= (np.diff(designs[:, self.paths], axis=0) != 0.0).any(axis=1)
        for part in np.split(designs, np.flatnonzero(begins[1:]) + 1):
            yield from (part[first : first + self.most] for first in range(0, len(part), self.most))
