"""Sound at the receivers by path: what makes it, where that acts, along or about which axis."""

from dataclasses import dataclass
from typing import NamedTuple

from ..base.arrays import Array, ComplexArray


class PathName(NamedTuple):
    """A path of sound.

    Attributes
    ----------
    source : name of the source
    port : where it acts: `housing`, a part in the shell, a space of gas, the stator's yoke
    direction : motion of the housing (`tx` … `rz`), force or moment on a part (`fx` … `mz`), a
        wave around the yoke, the flow into a space
    """

    source: str
    port: str
    direction: str


@dataclass(frozen=True)
class NoiseContribution:
    """Mean squares of a source's noise by path.

    Attributes
    ----------
    rows : rows of its paths among those of the case
    frequency_hz : shape (frequency,)
    alone : mean square of each path, shape (path, receiver, frequency), Pa²
    part : contribution of each path to the sum, negative where it works against it, shape of
        `alone`
    """

    rows: tuple[int, ...]
    frequency_hz: Array
    alone: Array
    part: Array


@dataclass(frozen=True)
class Contributions:
    """Sound of one case by path.

    Attributes
    ----------
    names : names of the paths
    frequency_hz : frequency of the lines, shape (line,), orders from zero first
    pressure : complex peaks, shape (path, receiver, line), Pa; their sum is that of all sources
    noise : noise of the sources that have some
    motions : motions that radiate: the housing's six motions as a rigid body, modes of its shell
    sources : names of the sources
    by_motion : pressure by motion and source, shape (motion, source, receiver, line), Pa; same sum
    """

    names: tuple[PathName, ...]
    frequency_hz: Array
    pressure: ComplexArray
    noise: tuple[NoiseContribution, ...]
    motions: tuple[str, ...]
    sources: tuple[str, ...]
    by_motion: ComplexArray
