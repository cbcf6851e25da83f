"""TDMS of National Instruments, through npTDMS."""

from typing import Any

from ...base.errors import ParameterError, StorageError
from ...base.registry import register
from ..claims import check_claim
from ..named_arrays import is_rate
from ..reader import Reader
from ..recorded import MissingError, Recorded, Request, check_rate, check_size, listed

UNIT = "unit_string"
"""Property of a channel."""


def read(request: Request) -> Recorded:
    """Channels of numbers; `group/channel` where the file has several groups.

    Raises
    ------
    ParameterError
        There is no channel, or the chosen ones differ in length or rate.
    StorageError
        The file is truncated or too large.
    """
    from nptdms import TdmsFile

    from ..tdms_gaps import START, gap_lines

    with TdmsFile.open(request.path) as file:
        _check_whole(file)
        candidates = [channel for group in file.groups() for channel in group.channels()]
        candidates = [
            channel for channel in candidates if channel.dtype.kind in "iuf" and len(channel)
        ]
        has_groups = len({channel.group_name for channel in candidates}) > 1
        names = [f"{c.group_name}/{c.name}" if has_groups else c.name for c in candidates]
        chosen = request.chosen(names)
        if not chosen:
            raise ParameterError("holds no channel of numbers")
        names, channels = [names[c] for c in chosen], [candidates[c] for c in chosen]
        rate = _check_alike(file, names, channels, request)
        total = len(channels[0])
        first, last = request.part(total, rate)
        check_claim(request.path, total, len(channels))  # of a byte each, before it is scaled
        check_size(len(channels), last - first)
        return Recorded(
            names=names,
            units=[str(channel.properties.get(UNIT, "")) for channel in channels],
            samples=[channel[first:last] for channel in channels],
            sample_rate_hz=rate,
            start_time=str(channels[0].properties.get(START, "")),
            first_sample=first,
            total_samples=total,
            remarks=gap_lines(
                request.path,
                [channel.path for channel in channels],
                1.0 / rate,
                (first, last) if request.samples is None else (0, total),
            ),
        )


def _check_whole(file: Any) -> None:
    """npTDMS reads what there is of the last segment; half a recording is refused here."""
    status = file.file_status
    for path, length in (status.channel_statuses or {}).items():
        if length.read_length != length.expected_length:
            raise StorageError(
                f"is truncated: its last segment claims {length.expected_length} samples of "
                f"{path} and holds {length.read_length}"
            )
    if status.incomplete_final_segment:
        raise StorageError("is truncated: its last segment holds less than it claims")


def _check_alike(file: Any, names: list[str], channels: list[Any], request: Request) -> float:
    """The sample rate that the channels share; they share their length too."""
    descriptions, kinds = [], set()
    for name, channel in zip(names, channels, strict=True):
        rate = request.sample_rate_hz or _rate_hz(file, name, channel)
        kinds.add((len(channel), rate))
        descriptions.append(f"{name} {len(channel)} samples at {rate:.9g} Hz")
    if len(kinds) > 1:
        raise ParameterError(
            f"channels differ ({listed(descriptions)}): choose some that are alike"
        )
    return kinds.pop()[1]


def _rate_hz(file: Any, name: str, channel: Any) -> float:
    """Rate from the waveform's increment, or from a property of channel, group or file."""
    from ..tdms_gaps import INCREMENT

    increment = channel.properties.get(INCREMENT)
    if increment is None:
        return _stated_rate_hz(file, name, channel)
    if not float(increment) > 0.0:
        raise ParameterError(f"channel {name!r}: {INCREMENT} is {increment} s, must be above zero")
    return 1.0 / float(increment)


def _stated_rate_hz(file: Any, name: str, channel: Any) -> float:
    for properties in (
        channel.properties, file[channel.group_name].properties, file.properties
    ):  # fmt: skip
        for key, value in properties.items():
            if is_rate(key):
                rate = float(value)
                check_rate(rate)
                return rate
    raise MissingError(
        f"channel {name!r}: has no wf_increment and no property such as SampleFrequency: "
        "give sample_rate_hz"
    )


register(Reader("tdms", (".tdms",), "TDMS", read, package="nptdms"))
