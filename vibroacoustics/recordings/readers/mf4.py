"""MDF, versions 3 and 4 (MF4) of ASAM, through asammdf (extra `mdf`)."""

import logging
import warnings
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, Final

from ...base.errors import ParameterError, StorageError
from ...base.registry import register
from ..axes import Axis, line_of
from ..claims import DEFLATE_RATIO, check_claim
from ..interleaved import interleaved_columns
from ..quantities import axis_factor
from ..reader import Reader
from ..recorded import Recorded, Request, Samples, check_size, listed, numbered

_TIME: Final = 1
_JUDGED: Final = 2**16
"""Samples by which columns in one channel are recognised."""
_AXES: Final = {1: "time", 2: "angle", 3: "distance", 4: "index"}
"""Kinds of the master channel of a group, `cn_sync_type` (ASAM MDF 4.1, block CN)."""


@dataclass(frozen=True)
class _Channel:
    """A channel of a group: its place in the file, and the samples that the group claims."""

    name: str
    unit: str
    group: int
    index: int
    samples: int
    record_bytes: int
    is_composed: bool


def read(request: Request) -> Recorded:
    """Channels of numbers; the groups' times make one time line."""
    logging.getLogger("asammdf").disabled = True  # it writes there what it repairs
    from asammdf import MDF

    with warnings.catch_warnings(action="ignore"), MDF(request.path) as file:
        channels, remarks = _channels_of(file, request)
        names = [channel.name for channel in channels]
        for channel in channels:
            what = f"samples of channel {channel.name!r}"
            check_claim(request.path, channel.samples, channel.record_bytes, what, DEFLATE_RATIO)
        axes = {channel.group: _axis(file, channel) for channel in channels}
        line = line_of(names, [axes[channel.group] for channel in channels], request)
        check_size(len(channels), line.last - line.first)
        stored = [
            _samples(file, channel, *part)
            for channel, part in zip(channels, line.parts, strict=True)
        ]
        start = getattr(file.header, "start_time", None)
        if file.identification.program_identification.startswith(b"amdf") and not request.is_block:
            remarks += _interleaved(names, stored)
    units = [channel.unit for channel in channels]
    date = "" if start is None else start.isoformat()
    return line.recorded(names, units, stored, date, remarks)


def _interleaved(names: Sequence[str], stored: Sequence[Samples]) -> list[str]:
    """Remarks on channels of which asammdf may have written columns one after the other."""
    columns = [interleaved_columns(samples[:_JUDGED].astype(float)) for samples in stored]
    return [
        f"channel {name!r}: its samples look like {number} columns one after the other, as asammdf "
        "writes an array of two dimensions: write each column as a signal"
        for name, number in zip(names, columns, strict=True)
        if number > 1
    ]


def _channels_of(file: Any, request: Request) -> tuple[list[_Channel], list[str]]:
    """Channels that are wanted, and remarks on those that are not read.

    Texts, arrays and structures are no channels; elements of arrays and structures are.
    """
    channels = _channels(file)
    names = numbered([channel.name for channel in channels])
    channels = [replace(each, name=name) for each, name in zip(channels, names, strict=True)]
    if request.channels is not None:
        return [_probed(file, channels[c])[0] for c in request.chosen(names)], []
    probed = [_probed(file, channel) for channel in channels]
    numbers = [channel for channel, is_number in probed if is_number]
    if not numbers:
        raise ParameterError(f"holds no channel of numbers; its channels: {listed(names)}")
    names, units = [each.name for each in numbers], [each.unit for each in numbers]
    remarks = [
        f"channel {channel.name!r} "
        + (
            "is an array or structure: its elements are read"
            if channel.is_composed
            else "holds no numbers and is not read"
        )
        for channel, is_number in probed
        if not is_number
    ]
    chosen = [numbers[c] for c in request.chosen(names, units)]
    return chosen, [*remarks, *request.omissions(names, units)]


def _channels(file: Any) -> list[_Channel]:
    return [
        _Channel(
            channel.name,
            "",
            group,
            index,
            int(content.channel_group.cycles_nr),
            max(1, int(content.channel_group.samples_byte_nr)),
            bool(content.channel_dependencies and content.channel_dependencies[index]),
        )
        for group, content in enumerate(file.groups)
        for index, channel in enumerate(content.channels)
        if index != file.masters_db.get(group) and content.channel_group.cycles_nr
    ]


def _probed(file: Any, channel: _Channel) -> tuple[_Channel, bool]:
    """Channel with its unit, and whether its first sample is one number."""
    signal = file.get(group=channel.group, index=channel.index, record_offset=0, record_count=1)
    is_number = signal.samples.dtype.kind in "biuf" and signal.samples.ndim == 1
    return replace(channel, unit=signal.unit or ""), is_number


def _axis(file: Any, channel: _Channel) -> Axis:
    """Time axis of a group; without one the sample rate must be given.

    Raises
    ------
    ParameterError
        The axis is an angle, a distance or an index.
    """
    group = channel.group
    if file.masters_db.get(group) is None:
        return Axis(channel.samples, None, 0.0, None)
    master = file.groups[group].channels[file.masters_db[group]]
    kind = _AXES.get(getattr(master, "sync_type", _TIME), "unknown")
    if kind != "time":
        raise ParameterError(
            f"channel {channel.name!r}: its axis {master.name!r} is of kind {kind}, unit "
            f"{master.unit or 'none'!r}: must be time"
        )
    factor = axis_factor(f"axis {master.name!r}", master.unit or "s")
    return Axis(channel.samples, None, 0.0, partial(_times, file, group, factor))


def _times(file: Any, group: int, factor: float, first: int, last: int) -> Samples:
    """Times in s of one group, from one sample up to another."""
    times: Samples = file.get_master(group, record_offset=first, record_count=last - first)
    if len(times) != last - first:
        raise StorageError(
            f"is truncated: a group claims more than {first} samples, of which the file holds "
            f"{len(times)} from {first} to {last}"
        )
    return times * factor


def _samples(file: Any, channel: _Channel, first: int, last: int) -> Samples:
    samples: Samples = _signal(file, channel, first, last).samples
    if samples.dtype.names is not None or samples.ndim > 1:
        kind = f"structure of {listed(samples.dtype.names)}" if samples.dtype.names else "array"
        raise ParameterError(
            f"channel {channel.name!r}: each sample is a {kind}: choose its elements"
        )
    return samples.astype(float) if samples.dtype.kind == "b" else samples


def _signal(file: Any, channel: _Channel, first: int, last: int) -> Any:
    signal = file.get(
        group=channel.group, index=channel.index, record_offset=first, record_count=last - first,
        ignore_invalidation_bits=False,
    )  # fmt: skip
    valid = len(signal.samples)
    bits = signal.invalidation_bits
    if bits is not None:
        valid -= int(bits.sum())
    if valid != last - first:
        raise StorageError(
            f"channel {channel.name!r}: {last - first - valid} of {last - first} samples are "
            "missing or marked invalid: choose a part without them"
        )
    return signal


register(Reader("mf4", (".mf4", ".mdf"), "MDF and MF4", read, package="asammdf"))
