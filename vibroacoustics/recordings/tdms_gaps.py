"""Gaps in the time of a TDMS file, from the start times that its segments state."""

from collections.abc import Iterable, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any, Final

from nptdms.reader import TdmsReader

START, OFFSET, INCREMENT = "wf_start_time", "wf_start_offset", "wf_increment"
"""Properties of a waveform: when it starts, what is added to that in s, sampling interval in s."""
_SAMPLES: Final = 1.5
"""Least gap, in sampling intervals."""
_CLOCK: Final = 1e-4
"""Relative deviation between the clocks of the samples and of the start times."""

Start = tuple[int, float]
"""Number of a channel's sample, and the time that the file states of it in s."""


class _SegmentReader(TdmsReader):  # type: ignore[misc]
    """Metadata of a file with the start of each waveform, which npTDMS overwrites by the last.

    npTDMS reads a segment's samples first, then its properties.
    """

    def __init__(self, path: Path) -> None:
        super().__init__(str(path))
        self.starts: dict[str, list[Start]] = {}
        self._before: dict[str, int] = {}

    def _update_object_metadata(self, segment: Any) -> None:
        self._before = {path: each.num_values for path, each in self.object_metadata.items()}
        super()._update_object_metadata(segment)

    def _update_object_properties(self, segment_properties: Any) -> None:
        super()._update_object_properties(segment_properties)
        for path in segment_properties or ():
            properties = self.object_metadata[path].properties
            start = properties.get(START)
            if start is not None:
                fraction = start.second_fractions * 2.0**-64
                start_s = start.seconds + fraction + float(properties.get(OFFSET, 0.0))
                starts = self.starts.setdefault(path, [])
                if not starts or starts[-1][1] != start_s:
                    starts.append((self._before.get(path, 0), start_s))


def gap_lines(
    path: Path, channels: Iterable[str], interval_s: float, part: tuple[int, int]
) -> list[str]:
    """A line for the gaps of the channels, alike ones once.

    Parameters
    ----------
    path : TDMS file
    channels : paths of the channels within it
    interval_s : between two samples
    part : first sample, and the one behind the last, between which gaps count
    """
    reader = _SegmentReader(path)
    try:
        reader.read_metadata()
    finally:
        reader.close()
    lines = [_line(reader.starts.get(channel, ()), interval_s, part) for channel in channels]
    return list(dict.fromkeys(line for line in lines if line))


def _line(starts: Sequence[Start], interval_s: float, part: tuple[int, int]) -> str:
    gaps = []
    for (before, before_s), (sample, start_s) in pairwise(starts):
        recorded_s = (sample - before) * interval_s
        gap_s = start_s - before_s - recorded_s
        is_gap = abs(gap_s) > _SAMPLES * interval_s + _CLOCK * recorded_s
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
