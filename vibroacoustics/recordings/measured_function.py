"""Functions of frequency between points of a structure, as hammer tests and analysers give them."""

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..base.errors import ParameterError

KINDS: Final = {
    "auto spectrum": 2,
    "cross spectrum": 3,
    "frequency response": 4,
    "coherence": 6,
    "spectrum": 12,
}
"""Kinds of functions and their function types of dataset 58."""
DIRECTIONS: Final = {0: ""} | {
    sign * (number + 3 * turn): ("+" if sign > 0 else "-") + "r" * turn + axis
    for number, axis in enumerate("xyz", 1)
    for turn in (0, 1)
    for sign in (1, -1)
}
"""Directions of dataset 58, record 6: none of a scalar, along `+x`, about `+rx`, and so on."""
DERIVATIVES: Final = {"m": 0, "m/s": 1, "m/s²": 2}
"""Number of derivatives of a displacement by time, by its unit."""


@dataclass(frozen=True)
class Node:
    """Position and direction at which something acts or is measured.

    Attributes
    ----------
    number : number of the node
    direction : `+x` to `-z`, about an axis `+rx`; empty for a scalar, such as sound pressure

    Examples
    --------
    >>> str(va.Node(12, "+z")), str(va.Node(101))
    ('12+z', '101')
    """

    number: int
    direction: str = ""

    def __post_init__(self) -> None:
        if self.direction not in DIRECTIONS.values():
            directions = ", ".join(filter(None, DIRECTIONS.values()))
            raise ParameterError(
                f"direction {self.direction!r}: must be one of {directions}, or none for a scalar"
            )
        if self.number < 0:
            raise ParameterError(f"node {self.number}: must be 0 or above")

    def __str__(self) -> str:
        return f"{self.number}{self.direction}"

    @property
    def opposite(self) -> "Node":
        """Node with the opposite direction; a scalar is its own."""
        signs = str.maketrans("+-", "-+")
        return Node(self.number, self.direction.translate(signs))


@dataclass(frozen=True)
class MeasuredFunction:
    """A function of frequency of one point, or of one point by another, in SI units.

    Attributes
    ----------
    kind : `frequency response`, `coherence`, `spectrum` (phasors), `auto spectrum` or
        `cross spectrum` (both mean squares; the cross spectrum has the response's phase over the
        reference's)
    frequency_hz : rising, shape (frequency,)
    values : complex, shape (frequency,)
    response : where it is measured
    reference : where the force acts, or the signal of reference is; none of a spectrum
    response_unit, reference_unit : `m/s²`, `m/s`, `m`, `N`, `Pa`; `1` of a coherence; of a
        spectrum no reference's

    Examples
    --------
    >>> frequency = np.array([50.0, 100.0])
    >>> function = va.MeasuredFunction(
    ...     "frequency response", frequency, np.array([0.1, 0.2j]), va.Node(12, "+z"),
    ...     va.Node(3, "+z"), "m/s²", "N")
    >>> str(function)
    'frequency response 12+z/3+z'
    """

    kind: str
    frequency_hz: Array
    values: ComplexArray
    response: Node
    reference: Node | None
    response_unit: str
    reference_unit: str = ""

    def __post_init__(self) -> None:
        if self.kind not in KINDS:
            raise ParameterError(f"kind {self.kind!r}: must be one of {', '.join(KINDS)}")
        if self.kind != "spectrum" and self.reference is None:
            raise ParameterError(f"{self}: needs a reference")
        if self.values.shape != self.frequency_hz.shape or self.values.size == 0:
            raise ParameterError(f"{self}: needs a value for each frequency")
        if not np.all(np.isfinite(self.values)) or not np.all(np.diff(self.frequency_hz) > 0.0):
            raise ParameterError(f"{self}: values must be finite and frequencies rise")

    def __str__(self) -> str:
        return f"{self.kind} {self.label}"

    @property
    def label(self) -> str:
        """Response, and reference where there is one."""
        return f"{self.response}" if self.reference is None else f"{self.response}/{self.reference}"

    def with_response_in(self, unit: str) -> "MeasuredFunction":
        """Accelerance, mobility and receptance, or such spectra, turned into one another.

        Parameters
        ----------
        unit : `m/s²`, `m/s` or `m`, or the unit that it has

        Raises
        ------
        ParameterError
            The response is none of the three, the unit is another, or it is to be integrated at
            0 Hz; or the function is a mean square or a coherence.
        """
        if unit == self.response_unit:
            return self
        if self.kind not in ("frequency response", "spectrum"):
            raise ParameterError(f"{self}: is not turned into another quantity")
        if not {unit, self.response_unit} <= set(DERIVATIVES):
            raise ParameterError(
                f"{self}: response in {self.response_unit} cannot be turned into {unit}"
            )
        power = DERIVATIVES[unit] - DERIVATIVES[self.response_unit]
        if power < 0 and np.any(self.frequency_hz <= 0.0):
            raise ParameterError(f"{self}: cannot be integrated at 0 Hz: leave that line out")
        values = self.values * (2.0j * np.pi * self.frequency_hz) ** power
        return replace(self, values=values, response_unit=unit)
