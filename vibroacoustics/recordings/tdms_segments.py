"""Properties of the segments of a TDMS file: start times, scales and units that change."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from types import SimpleNamespace
from typing import Any, Final

import numpy as np
from nptdms.reader import TdmsReader
from nptdms.scaling import get_scaling

from ..base.errors import ParameterError, StorageError
from .recorded import Samples

START, OFFSET, INCREMENT = "wf_start_time", "wf_start_offset", "wf_increment"
"""Properties of a waveform: when it starts, what is added to that in s, sampling interval in s."""
UNIT: Final = "unit_string"
_SCALE: Final = "NI_Scal"
_SCALES: Final = "NI_Number_Of_Scales"
_SAMPLES: Final = 1.5
"""Least gap, in sampling intervals."""
_CLOCK: Final = 1e-4
"""Relative deviation between the clocks of the samples and of the start times."""

Properties = Mapping[str, Any]
Change = tuple[int, Properties]
"""Number of a channel's sample, and the properties that hold from it on."""


@dataclass
class _History:
    """Properties of an object from segment to segment."""

    present: dict[str, Any] = field(default_factory=dict)
    changes: list[Change] = field(default_factory=list)

    def update(self, sample: int, properties: Iterable[tuple[str, Any]]) -> None:
        """Take the properties that a segment states from a sample on."""
        self.present = self.present | dict(properties)
        if not self.changes or self.changes[-1][1] != self.present:
            self.changes.append((sample, self.present))


class SegmentReader(TdmsReader):  # type: ignore[misc]
    """Metadata of a file with the properties of each segment, which npTDMS overwrites by the last.

    npTDMS reads a segment's samples first, then its properties.
    """

    def __init__(self, path: Path) -> None:
        super().__init__(str(path))
        self.histories: dict[str, _History] = {}
        self._before: dict[str, int] = {}
        try:
            self.read_metadata()
        finally:
            self.close()

    def _update_object_metadata(self, segment: Any) -> None:
        self._before = {path: each.num_values for path, each in self.object_metadata.items()}
        super()._update_object_metadata(segment)

    def _update_object_properties(self, segment_properties: Any) -> None:
        super()._update_object_properties(segment_properties)
        for path, properties in (segment_properties or {}).items():
            history = self.histories.setdefault(path, _History())
            history.update(self._before.get(path, 0), properties)

    @property
    def origin_s(self) -> int:
        """Whole second at which the first waveform starts, s since 1904; 0 without one."""
        first = [history.changes[0][1].get(START) for history in self.histories.values()]
        return min((int(start.seconds) for start in first if start is not None), default=0)

    def pieces(self, channel: Any) -> list[Change]:
        """Properties of a channel by the sample from which they hold; those of the last last.

        What is first stated after samples holds for those too.
        """
        changes = self.histories.get(channel.path, _History()).changes or [(0, {})]
        changes = [change for change in changes if change[0] < len(channel)] or changes[-1:]
        first = {**channel.properties, **changes[0][1]}
        later = [(sample, {**first, **properties}) for sample, properties in changes[1:]]
        return [(0, first), *later]


def changes_of(pieces: Sequence[Change], name: str) -> list[tuple[int, Any, Any]]:
    """Samples at which a property takes another value, with the value before and the new one."""
    return [
        (sample, before.get(name), now.get(name))
        for (_, before), (sample, now) in pairwise(pieces)
        if before.get(name) != now.get(name)
    ]


def check_constant(
    channel: str, pieces: Sequence[Change], name: str, part: tuple[int, int], rate_hz: float
) -> Any:
    """Value of a property in a part of a channel, None where it is not stated.

    Raises
    ------
    ParameterError
        It changes within the part.
    """
    for sample, before, now in changes_of(pieces, name):
        if part[0] < sample < part[1]:
            advice = "choose a part before or after it"
            if name == INCREMENT:  # of which a part is known by one increment
                advice = "save the parts before and after it as files"
            raise ParameterError(
                f"channel {channel!r}: {name} changes from {before} to {now} at sample "
                f"{sample + 1} ({sample / rate_hz:.9g} s): {advice}"
            )
    return [properties for sample, properties in pieces if sample <= part[0]][-1].get(name)


def scaled(channel: Any, file: Any, pieces: Sequence[Change], first: int, last: int) -> Samples:
    """Samples of a channel, each segment with the scale that it states, shape (time,).

    Raises
    ------
    StorageError
        npTDMS does not know a scale, or cannot apply one that changes.
    """
    group = file[channel.group_name].properties
    _check_scales(channel, file, pieces)
    ends = [sample for sample, _ in pieces[1:]] + [max(last, len(channel))]
    if len({_scale(properties) for _, properties in pieces}) == 1:
        return np.asarray(channel[first:last])
    values = []
    for (begin, properties), end in zip(pieces, ends, strict=True):
        start, stop = max(first, begin), min(last, end)
        if start >= stop:
            continue
        raw = channel.read_data(start, stop - start, scaled=False)
        if isinstance(raw, dict):
            raise StorageError(
                f"channel {channel.name!r}: its scale changes at sample {begin + 1} and its "
                "samples are raw ones of DAQmx: convert it with LabVIEW"
            )
        scale = get_scaling(properties, group, file.properties)
        values.append(raw if scale is None else scale.scale(SimpleNamespace(data=raw)))
    return np.concatenate(values) if values else np.asarray(channel[first:last])


def _scale(properties: Properties) -> tuple[tuple[str, str], ...]:
    return tuple(sorted((k, repr(v)) for k, v in properties.items() if k.startswith(_SCALE)))


def has_scale(channel: Any, file: Any) -> bool:
    """Whether the file states how numbers of a channel become values."""
    return any(
        properties.get("NI_Scaling_Status") == "scaled" or int(properties.get(_SCALES, 0)) > 0
        for properties in _levels(channel, file)
    )


def _levels(channel: Any, file: Any) -> list[Properties]:
    """Properties of a channel, its group and the file."""
    return [channel.properties, file[channel.group_name].properties, file.properties]


def _check_scales(channel: Any, file: Any, pieces: Sequence[Change]) -> None:
    """Refuse a scale that npTDMS does not know: it gives the numbers without it."""
    for sample, properties in pieces:
        levels = [properties, *_levels(channel, file)[1:]]
        stated = next((each for each in levels if int(each.get(_SCALES, 0)) > 0), None)
        if stated is None or stated.get("NI_Scaling_Status") == "scaled":
            continue
        if get_scaling(*levels) is None:
            kinds = [str(v) for k, v in stated.items() if k.endswith("_Scale_Type")]
            raise StorageError(
                f"channel {channel.name!r}: its scale ({', '.join(kinds)}) from sample "
                f"{sample + 1} on is unknown: export it with LabVIEW"
            )


def date_of(properties: Properties, origin_s: int) -> str:
    """Date of an origin, ISO 8601, s since 1904, by a waveform that states its start time."""
    start = properties[START]
    epoch = np.datetime64(str(start).partition(".")[0], "s") - np.timedelta64(start.seconds, "s")
    return str(epoch + np.timedelta64(origin_s, "s"))


def start_s(properties: Properties, factor: float = 1.0, origin_s: int = 0) -> float | None:
    """Start of a waveform, s from an origin; None where no start time is stated.

    Parameters
    ----------
    properties : properties of the channel
    factor : factor of the start offset to s
    origin_s : origin, s since 1904
    """
    start = properties.get(START)
    if start is None:
        return None
    fraction = start.second_fractions * 2.0**-64
    return float(start.seconds - origin_s + fraction + factor * float(properties.get(OFFSET, 0.0)))


def gap_line(pieces: Sequence[Change], interval_s: float, part: tuple[int, int]) -> str:
    """A line on the gaps of a channel; empty without any.

    Parameters
    ----------
    pieces : properties by sample
    interval_s : between two samples
    part : first sample, and the one behind the last, between which gaps count
    """
    starts = [(sample, start_s(properties)) for sample, properties in pieces]
    dated = [(sample, start) for sample, start in starts if start is not None]
    gaps = []
    for (before, before_s), (sample, now_s) in pairwise(dated):
        recorded_s = (sample - before) * interval_s
        gap_s = now_s - before_s - recorded_s
        is_gap = abs(gap_s) > _SAMPLES * interval_s + _CLOCK * recorded_s and now_s != before_s
        if is_gap and part[0] < sample < part[1]:
            gaps.append((sample, gap_s))
    if not gaps:
        return ""
    (sample, gap_s), number = gaps[0], f"{len(gaps)} gap{'s' if len(gaps) > 1 else ''}"
    return (
        f"{number} in the time that its segments state, the first of {gap_s:.4g} s at "
        f"{sample * interval_s:.9g} s: the samples on both sides are joined; choose a part between "
        "gaps"
    )
