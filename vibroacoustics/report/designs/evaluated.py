"""Evaluated designs as the report shows them: labelled columns of variables and objectives."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ...base.arrays import Array, IndexArray

Mask = npt.NDArray[np.bool_]


@dataclass(frozen=True)
class Column:
    """One quantity of all designs.

    Attributes
    ----------
    label : what it is
    unit : of its values; empty for a number or a choice
    values : shape (design,); of a choice the number among its words; not a number where a design
        has no such value
    words : of a choice
    """

    label: str
    unit: str
    values: Array
    words: tuple[str, ...] = ()

    @property
    def heading(self) -> str:
        """Label with its unit."""
        return f"{self.label}, {self.unit}" if self.unit else self.label

    def cell(self, design: int) -> str:
        """One value in words."""
        value = float(self.values[design])
        if np.isnan(value):
            return "–"
        return self.words[round(value)] if self.words else f"{value:.4g}"


@dataclass(frozen=True)
class Evaluated:
    """Designs with what was asked of them.

    Attributes
    ----------
    variables, objectives : columns
    met : which designs meet every constraint, shape (design,)
    front : of these, those of which none is better in every objective, shape (design,)
    best : numbers of the best few, the first one first
    """

    variables: tuple[Column, ...]
    objectives: tuple[Column, ...]
    met: Mask
    front: Mask
    best: IndexArray

    @property
    def count(self) -> int:
        """Number of designs."""
        return len(self.met)
