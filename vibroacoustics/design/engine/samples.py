"""Probes of designs, side by side, as long as they are alike."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from ...base.arrays import Array, ComplexArray
from ...base.errors import SolverError
from .probe import Probe

OneProbe = Callable[[Array], Probe]
"""Function of the values of a design, shape (variable,): its probe."""


class UnlikeError(SolverError):
    """Designs differ in more than the values of their arrays."""


def different(first: Probe, other: Probe) -> str | None:
    """Return how two probes differ beside their values; none where they do not."""
    for speed, other_speed in zip(first.layout, other.layout, strict=True):
        if speed.frequency_hz != other_speed.frequency_hz:
            return "changes the frequencies of lines"
        if speed != other_speed:
            return "changes the ports or where random loads act"
    for part, other_part in zip(first.groups(), other.groups(), strict=True):
        if _shapes(part) != _shapes(other_part):
            return "changes what there is to see"
    return None


def _shapes(arrays: Mapping[str, ComplexArray]) -> dict[str, tuple[int, ...]]:
    return {name: np.shape(array) for name, array in arrays.items()}


def stacked(probes: Sequence[Probe]) -> list[dict[str, ComplexArray]]:
    """Stack arrays of probes by speed, last those of the body, shape (design, ...).

    Raises
    ------
    UnlikeError
        They differ in more than their values.
    """
    for probe in probes[1:]:
        reason = different(probes[0], probe)
        if reason:
            raise UnlikeError(reason)
    groups = zip(*(probe.groups() for probe in probes), strict=True)
    return [
        {name: np.array([part[name] for part in group]) for name in group[0]} for group in groups
    ]


@dataclass
class Samples:
    """Probes of designs, each made once.

    Attributes
    ----------
    probe : computes the probe of a design
    """

    probe: OneProbe
    _known: dict[bytes, Probe] = field(default_factory=dict, repr=False)

    def probes_of(self, values: Array) -> list[Probe]:
        """Return the probes of designs, shape (design, variable)."""
        return [self._one(row) for row in values]

    def forget(self) -> None:
        """Let all probes go."""
        self._known.clear()

    def _one(self, row: Array) -> Probe:
        key = row.tobytes()
        if key not in self._known:
            self._known[key] = self.probe(row)
        return self._known[key]
