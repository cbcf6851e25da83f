"""A value in which designs differ."""

from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from ..base.arrays import Array
from ..base.errors import ParameterError
from ..base.rounding import to_digits
from ..base.units import split_key
from ..study.design import DesignVariable

_DIGITS: Final = 14
"""Digits of a value in a file: those that no change of its unit alters."""


@dataclass(frozen=True)
class Variable:
    """A value in which designs differ.

    Attributes
    ----------
    key : dotted, with the unit of the file; `option` for the choice among options
    unit : symbol of that unit
    factor : factor from that unit to SI
    limits : lowest and highest value in SI; numbers of the words where it takes words
    choices : values in SI that it may take, or words; none for any value between the limits
    points : number of points of a grid; none where it takes some values only, or none are given
    integer : whether the file writes whole numbers
    """

    key: str
    unit: str
    factor: float
    limits: tuple[float, float]
    choices: tuple[float | str, ...] | None = None
    points: int | None = None
    integer: bool = False

    @property
    def takes_words(self) -> bool:
        """Whether its values are numbers of words."""
        return self.choices is not None and isinstance(self.choices[0], str)

    @property
    def values(self) -> Array | None:
        """All values that it may take, shape (value,); none where any between the limits."""
        if self.choices is None:
            return None
        words = self.takes_words
        return np.array(range(len(self.choices)) if words else self.choices, dtype=float)

    def in_grid(self) -> Array:
        """Values of a grid, shape (value,).

        Raises
        ------
        ParameterError
            It takes any value of a range, and no number of points is given.
        """
        values = self.values
        if values is None and self.points is None:
            raise ParameterError(
                f"design.variables.{self.key}: a grid needs points, step or list; or choose "
                'sampling = "sobol" or "latin-hypercube"'
            )
        return np.asarray(np.linspace(*self.limits, self.points or 2)) if values is None else values

    def at_share(self, share: Array) -> Array:
        """Values that so large shares of its range lie below, each equally often."""
        low, high = self.limits
        values = self.values
        if values is None:
            return np.asarray(low + share * (high - low))
        return np.asarray(values[np.minimum((share * values.size).astype(int), values.size - 1)])

    def in_file(self, values: Array) -> Array:
        """Values as a study's file writes them, with 14 digits, shape (value,).

        Parameters
        ----------
        values : values in SI, or numbers of words, shape (value,)
        """
        if self.choices is not None and self.takes_words:
            return np.asarray(np.array(self.choices)[np.rint(values).astype(int)])
        rounded = to_digits(np.asarray(values, dtype=float) / self.factor, _DIGITS)
        is_whole = self.integer and bool(np.all(rounded == np.rint(rounded)))
        return np.asarray(rounded, dtype=int if is_whole else float)

    def written(self, value: float) -> Any:
        """A value as a study's file writes it."""
        return self.in_file(np.array([value]))[0].item()


def variable_of(key: str, entry: DesignVariable) -> Variable:
    """A variable as the file gives it.

    Raises
    ------
    ParameterError
        Words and numbers are mixed, or a step makes too many values.
    """
    unit = split_key(key.rpartition(".")[2])[1]
    symbol, factor = (unit.symbol, unit.factor) if unit else ("", 1.0)
    if entry.list is None:
        return _in_range(key, entry, symbol, factor)
    words = [value for value in entry.list if isinstance(value, str)]
    if words and len(words) < len(entry.list):
        raise ParameterError(f"design.variables.{key}.list: mixes words and numbers")
    if words:
        return Variable(key, "", 1.0, (0.0, len(words) - 1.0), tuple(words))
    numbers = tuple(factor * value for value in entry.list if not isinstance(value, str))
    integer = all(isinstance(value, int) for value in entry.list)
    return Variable(key, symbol, factor, (min(numbers), max(numbers)), numbers, integer=integer)


def _in_range(key: str, entry: DesignVariable, symbol: str, factor: float) -> Variable:
    low, high = entry.range or (0.0, 1.0)
    limits = (factor * low, factor * high)
    if entry.step is None:
        return Variable(key, symbol, factor, limits, points=entry.points)
    count = int((high - low) / entry.step + 1e-9) + 1
    if not 2 <= count <= 100_000:
        raise ParameterError(
            f"design.variables.{key}.step = {entry.step:g} {symbol}: makes {count} values; "
            "allowed 2 to 100000"
        )
    choices = tuple(factor * (low + entry.step * number) for number in range(count))
    integer = all(isinstance(value, int) for value in (low, high, entry.step))
    return Variable(key, symbol, factor, (choices[0], choices[-1]), choices, integer=integer)
