"""The machine of a study, or a sample of it with discrepancies, for which designs are computed."""

from collections.abc import Callable, Hashable
from dataclasses import dataclass, field
from typing import Final, NamedTuple

from ...base.arrays import Array
from ...machine.source import Result, Shared
from ...study.sampling import Sample

KEPT: Final = 64
"""Results that designs of a sample share, the latest ones."""


class Recent(Shared):
    """The latest results that designs share, each computed once."""

    def __call__(self, key: Hashable, compute: Callable[[], Result]) -> Result:
        """Return the result of a key, computed where it is not known any more."""
        result = super().__call__(key, compute)
        if len(self._known) > KEPT:
            del self._known[next(iter(self._known))]
        return result


@dataclass(frozen=True)
class Deviation:
    """Pairs of a discrepancy and a level of unmodelled noise that stay with a sample.

    Attributes
    ----------
    gain : factors on the power of sources, shape (pair, source, gain band)
    added : factors on what designs add, shape (pair,)
    """

    gain: Array
    added: Array


class Unmodelled(NamedTuple):
    """Noise beside the modelled sound of an option.

    Attributes
    ----------
    square : A-weighted mean square, with a measured baseline in its place, shape (pair, speed,
        receiver)
    thirds : unweighted mean square without a baseline, shape (pair, speed, receiver, gain band),
        Pa²
    """

    square: Array
    thirds: Array


@dataclass(frozen=True)
class MachineSample:
    """The machine with the values of a sample; without values it is the nominal one.

    Attributes
    ----------
    weight : weights of the pairs of the sample, shape (pair,)
    unmodelled : computes the noise beside the modelled sound of an option with nominal values
    values : values by table and field
    deviation : deviations of the pairs; none for the nominal machine
    shared : results that designs of the sample share
    """

    weight: Array
    unmodelled: Callable[[str], Unmodelled]
    values: Sample = field(default_factory=dict)
    deviation: Deviation | None = None
    shared: Shared = field(default_factory=Recent, repr=False)

    def without(self, chosen: frozenset[tuple[str, str]]) -> Sample:
        """Return the values but those that designs choose."""
        return {key: value for key, value in self.values.items() if key not in chosen}
