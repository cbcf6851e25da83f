"""Named arrays of a MAT, HDF5 or netCDF file, and what their names say."""

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np

from .packing import unpacked, unsigned
from .recorded import MINIMUM_SAMPLES, Samples

RATE_NAMES: Final = ("sample_rate_hz", "sample_rate", "fs", "SampleFrequency", "SamplingRate")
"""Names of a sample rate; capitals, blanks and underscores do not count."""
TIME_NAMES: Final = ("time", "time_s", "t")
UNIT_NAMES: Final = ("units", "unit", "unit_string")
_STARTS: Final = frozenset(
    {"wfstartoffset", "startoffset", "starts", "startoffsets", "t0", "t0s", "timeoffset", "offsets"}
)
_TIME_OF: Final = re.compile(r"(?:(?:t|time)_(?P<before>\w+)|(?P<behind>\w+)_(?:t|time))(?:_s)?")
"""Names of the time of one array: `t_front`, `time_front`, `front_t`, `front_time`."""
_RATES: Final = frozenset(
    f"{verb}{noun}{unit}"
    for verb in ("sample", "sampling")
    for noun in ("rate", "frequency", "freq")
    for unit in ("", "hz")
) | {"fs", "fshz"}
_TIMES: Final = frozenset({"time", "times"})


Part = tuple[slice, ...]
"""One slice a dimension."""


@dataclass(frozen=True, eq=False)
class NamedArray:
    """An array in a file: what its header says, and how to read its values.

    Attributes
    ----------
    name : with the path to it
    shape : shape that the header claims
    is_number : whether it holds numbers
    load : stored values of a part, one slice a dimension
    attributes : units, sample rate and how the values are packed
    check : refuses a part that the bytes of the file cannot hold
    dimensions : names of the arrays that are the coordinates of its dimensions; empty without
    is_whole : whether its numbers are stored as whole ones
    """

    name: str
    shape: tuple[int, ...]
    is_number: bool
    load: Callable[[Part], Any]
    attributes: Mapping[str, Any] = field(default_factory=dict)
    check: Callable[[Part], None] = lambda _: None
    dimensions: tuple[str, ...] = ()
    is_whole: bool = False

    def values(self, part: Part | None = None) -> Samples:
        """Values of a part, by default of all; see `unpacked`."""
        every = tuple(slice(0, side) for side in self.shape)
        stored = np.asarray(self.load(every if part is None else part))
        return unpacked(unsigned(stored, self.attributes), self.attributes)

    @property
    def size(self) -> int:
        """Number of values."""
        return int(np.prod(self.shape))

    @property
    def time_axis(self) -> int:
        """The longer side; of a square the last."""
        return int(len(self.shape) == 2 and self.shape[1] >= self.shape[0])

    @property
    def may_be_channels(self) -> bool:
        """Whether it is a vector or table of numbers, with samples enough."""
        return (
            self.is_number
            and len(self.shape) in (1, 2)
            and self.shape[self.time_axis] >= MINIMUM_SAMPLES
        )


def as_text(value: Any) -> str:
    """Text of an attribute: bytes and arrays of one element too."""
    value = value.item() if isinstance(value, np.ndarray) and value.size == 1 else value
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)


def is_rate(name: str) -> bool:
    """Whether an array, attribute or property of this name is a sample rate."""
    return "".join(character for character in _leaf(name).lower() if character.isalnum()) in _RATES


def is_time(name: str) -> bool:
    """Whether an array of this name is a time axis."""
    leaf = _leaf(name)
    return leaf == "t" or leaf.lower().removesuffix("_s") in _TIMES


def owner_of(name: str) -> str:
    """Name of the array whose time an array of this name may be; empty where it is none."""
    match = _TIME_OF.fullmatch(_leaf(name))
    return "" if match is None else _parent(name) + (match["before"] or match["behind"])


def names_of_times(name: str) -> tuple[str, ...]:
    """Names that the time of an array of this name may have."""
    parent, leaf = _parent(name), _leaf(name)
    stems = [f"{stem}_{leaf}" for stem in ("t", "time")] + [
        f"{leaf}_{stem}" for stem in ("t", "time")
    ]
    return tuple(f"{parent}{stem}{end}" for stem in stems for end in ("", "_s"))


def is_start(name: str) -> bool:
    """Whether an attribute of this name is the time of the first sample."""
    return "".join(character for character in name.lower() if character.isalnum()) in _STARTS


def attribute_text(array: NamedArray, names: Sequence[str]) -> str:
    """Text of the first attribute of these names; empty without one."""
    return next((as_text(array.attributes[n]).strip() for n in names if n in array.attributes), "")


def nearest(arrays: Iterable[NamedArray], name: str) -> NamedArray | None:
    """The array that stands nearest to the named one: in its group, or in one around it."""
    around = [array for array in arrays if name.startswith(_parent(array.name))]
    return max(around, key=lambda array: len(_parent(array.name)), default=None)


def _leaf(name: str) -> str:
    return name[len(_parent(name)) :]


def _parent(name: str) -> str:
    """Path before a name, with its last `/` or `.`."""
    return name[: max(name.rfind("/"), name.rfind(".")) + 1]
