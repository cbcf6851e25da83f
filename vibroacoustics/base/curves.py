"""Inner curves of a machine: values over a crank angle, a speed or a length, with their words.

Whoever owns a curve gives its values in SI and the unit in which people read it; tables and
pictures follow from that. A dataset of curves is self-contained: it is drawn without the machine.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, Literal, NamedTuple

import numpy as np

from .arrays import Array
from .errors import ParameterError
from .units import UNITS

CRANK_ANGLES: Final = 720
"""Samples a revolution where a curve may choose: half a degree."""
MOST_AXES: Final = 3
ORBIT_AXES: Final = ("x", "y")


class Axis(NamedTuple):
    """What a curve is given over.

    Attributes
    ----------
    name : of the dimension
    values : numbers in SI, or words
    unit : key of `units.UNITS` in which they are read; empty for words
    label : in a picture; the name in words where empty
    """

    name: str
    values: Array | Sequence[str]
    unit: str = ""
    label: str = ""

    @property
    def words(self) -> bool:
        """Whether the values are words."""
        return not np.issubdtype(np.asarray(self.values).dtype, np.number)


@dataclass(frozen=True)
class Curve:
    """A curve, a family of curves, or families of curves in panels.

    Attributes
    ----------
    name : of the variable, and of its table and picture
    title : what is shown, in words
    values : SI, one dimension for each axis
    axes : the last is the abscissa, the one before parts the lines, the first of three the panels
    unit : key of `units.UNITS` in which the values are read
    source : document and figure or equation that it repeats; or what it is derived from
    picture : lines over the abscissa; or an orbit, the second of two axes `x`, `y` over the first,
        in a circle of one
    orders : shaft orders that a map of frequencies over the speed shows as lines
    """

    name: str
    title: str
    values: Array
    axes: tuple[Axis, ...]
    unit: str
    source: str
    picture: Literal["lines", "orbit"] = "lines"
    orders: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        if reason := self._why_not():
            raise ParameterError(f"curve {self.name}: {reason}")

    def _why_not(self) -> str | None:
        """Why the curve cannot be; None where it can."""
        if not self.name.isidentifier():
            return "the name must be a word of letters, digits and _"
        most = MOST_AXES + (self.picture == "orbit")
        if not 1 <= len(self.axes) <= most:
            return f"{len(self.axes)} axes; allowed 1 to {most}"
        shape = tuple(len(axis.values) for axis in self.axes)
        if np.shape(self.values) != shape or 0 in shape:
            return f"values of shape {np.shape(self.values)} over axes of {shape}"
        units = {self.unit, *(axis.unit for axis in self.axes if not axis.words)}
        if unknown := sorted(units - set(UNITS)):
            return f"unit {unknown[0]!r}: unknown; allowed {', '.join(UNITS)}"
        numbers = (self.values, *(axis.values for axis in self.axes if not axis.words))
        if not all(np.all(np.isfinite(np.asarray(part))) for part in numbers):
            return "values must be finite"
        if not self.title or not self.source:
            return "title and source must be said"
        orbit = self.picture == "orbit"
        if orbit and (len(self.axes) < 2 or tuple(self.axes[-2].values) != ORBIT_AXES):
            return "an orbit needs x and y as the last axis but one"
        return None


def angle_axis(crank_angle: Array, name: str = "crank_angle", label: str = "Crank angle") -> Axis:
    """Crank angle as an abscissa.

    Parameters
    ----------
    crank_angle : rad, shape (samples,)
    name : of the dimension
    label : in a picture
    """
    return Axis(name, crank_angle, "deg", label)


def in_words(name: str) -> str:
    """A variable's name as the words of a label."""
    text = name.replace("_", " ")
    return text[:1].upper() + text[1:]
