"""MDF, versions 3 and 4 (MF4) of ASAM, through asammdf (extra `mdf`)."""

import logging
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

from ...base.errors import ParameterError, StorageError
from ...base.registry import register
from ..claims import DEFLATE_RATIO, check_claim
from ..reader import Reader
from ..recorded import Recorded, Request, Samples, check_size, listed, numbered
from ..time_axis import even_part


@dataclass(frozen=True)
class _Channel:
    """A channel of a group: its place in the file, and the samples that the group claims."""

    name: str
    group: int
    index: int
    samples: int
    record_bytes: int


def read(request: Request) -> Recorded:
    """Channels of numbers on an even time axis; a group of channels has one.

    Raises
    ------
    ParameterError
        There is no channel, the chosen ones are of groups that differ, or times are not even.
    StorageError
        Samples are marked invalid, or the file claims more than the cap allows.
    """
    logging.getLogger("asammdf").disabled = True  # it writes there what it repairs
    from asammdf import MDF

    with warnings.catch_warnings(action="ignore"), MDF(request.path) as file:
        channels = _channels(file)
        names = numbered([channel.name for channel in channels])
        chosen = request.chosen(names)
        if not chosen:
            raise ParameterError("holds no channel")
        names, channels = [names[c] for c in chosen], [channels[c] for c in chosen]
        for channel in channels:
            what = f"samples of channel {channel.name!r}"
            check_claim(request.path, channel.samples, channel.record_bytes, what, DEFLATE_RATIO)
        first, last, rate_hz = _common_part(file, names, channels, request)
        check_size(len(channels), last - first)
        signals = [_signal(file, channel, first, last) for channel in channels]
        start = getattr(file.header, "start_time", None)
    texts = {n for n, signal in enumerate(signals) if signal.samples.dtype.kind not in "biuf"}
    if request.channels is not None or len(texts) == len(signals):
        texts = set()
    columns = [column for column in range(len(signals)) if column not in texts]
    return Recorded(
        names=[names[column] for column in columns],
        units=[signals[column].unit or "" for column in columns],
        samples=[_numbers(signals[column].samples) for column in columns],
        sample_rate_hz=rate_hz,
        start_time="" if start is None else start.isoformat(),
        first_sample=first,
        total_samples=channels[0].samples,
        remarks=[f"channel {names[column]!r} holds no numbers and is not read" for column in texts],
    )


def _channels(file: Any) -> list[_Channel]:
    return [
        _Channel(
            channel.name,
            group,
            index,
            int(content.channel_group.cycles_nr),
            max(1, int(content.channel_group.samples_byte_nr)),
        )
        for group, content in enumerate(file.groups)
        for index, channel in enumerate(content.channels)
        if index != file.masters_db.get(group) and content.channel_group.cycles_nr
    ]


def _common_part(
    file: Any, names: Sequence[str], channels: Sequence[_Channel], request: Request
) -> tuple[int, int, float]:
    """First sample, the one behind the last and the sample rate, which the channels share."""
    groups = {channel.group: channel for channel in channels}
    lengths = {channel.samples for channel in channels}
    if len(lengths) > 1:
        named = [f"{n} {c.samples}" for n, c in zip(names, channels, strict=True)]
        raise ParameterError(
            f"channels differ in length ({listed(named)}): choose channels of one group"
        )
    parts = [_part(file, group, lengths.copy().pop(), request) for group in groups]
    if any(part[:2] != parts[0][:2] for part in parts) or not _one_rate(parts):
        rates = [
            f"{groups[g].name} {part[2]:.9g} Hz" for g, part in zip(groups, parts, strict=True)
        ]
        raise ParameterError(
            f"channels differ in sample rate ({listed(rates)}): choose channels of one group"
        )
    return parts[0]


def _one_rate(parts: Sequence[tuple[int, int, float]]) -> bool:
    """Whether rates differ by less than a sample over the part."""
    first, last, rate_hz = parts[0]
    return all(abs(part[2] / rate_hz - 1.0) * (last - first) < 0.5 for part in parts)


def _part(file: Any, group: int, samples: int, request: Request) -> tuple[int, int, float]:
    if file.masters_db.get(group) is None and request.sample_rate_hz is None:
        raise ParameterError("a group has no time axis: choose other channels")
    return even_part(partial(_times, file, group), samples, request)


def _times(file: Any, group: int, first: int, last: int) -> Samples:
    """Times in s of one group, from one sample up to another."""
    times: Samples = file.get_master(group, record_offset=first, record_count=last - first)
    if len(times) != last - first:
        raise StorageError(
            f"is truncated: a group claims more than {first} samples, of which the file holds "
            f"{len(times)} from {first} to {last}"
        )
    return times


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


def _numbers(samples: Samples) -> Samples:
    return samples.astype(float) if samples.dtype.kind == "b" else samples


register(Reader("mf4", (".mf4", ".mdf"), "MDF and MF4", read, package="asammdf"))
