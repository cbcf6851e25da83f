"""TDMS of National Instruments, through npTDMS."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final

from ...base.errors import ParameterError, StorageError
from ...base.registry import register
from ..axes import Axis, line_of
from ..claims import check_claim
from ..counts import count_words
from ..named_arrays import is_rate
from ..quantities import axis_factor
from ..reader import Reader
from ..recorded import MissingError, Recorded, Request, check_rate, check_size

if TYPE_CHECKING:
    from ..tdms_segments import Change

_X_UNIT, _X_NAME = "wf_xunit_string", "wf_xname"
"""Properties of the axis of a channel."""
_TIME_NAMES: Final = ("", "time", "zeit", "t")


def read(request: Request) -> Recorded:
    """Channels of numbers; `group/channel` where the file has several groups."""
    from nptdms import TdmsFile

    from .. import tdms_segments as segments

    with TdmsFile.open(request.path) as file:
        _check_whole(file)
        names, channels, remarks = _channels(file, request)
        reader = segments.SegmentReader(request.path)
        pieces = [reader.pieces(channel) for channel in channels]
        check_claim(request.path, max(map(len, channels)), len(channels))  # of a byte each
        axes, origin = _axes(file, names, channels, pieces, reader.origin_s, request)
        line = line_of(names, axes, request)
        check_size(len(names), line.last - line.first)
        parts = line.planned(request).parts
        about = list(zip(names, channels, pieces, parts, strict=True))
        units = [
            str(segments.check_constant(name, piece, segments.UNIT, part, time.rate_hz) or "")
            for (name, _, piece, part), time in zip(about, line.times, strict=True)
        ]
        stored = [
            segments.scaled(channel, file, piece, *part)
            for channel, piece, part in zip(channels, pieces, line.parts, strict=True)
        ]
        gaps = [
            segments.gap_line(piece, 1.0 / axis.rate_hz, part)
            for (_, _, piece, part), axis in zip(about, axes, strict=True)
            if axis.rate_hz
        ]
        counts = [
            ""
            if segments.has_scale(channel, file)
            else count_words(unit, values, channel.properties)
            for channel, unit, values in zip(channels, units, stored, strict=True)
        ]
    remarks += dict.fromkeys(filter(None, gaps))
    return line.recorded(names, units, stored, origin, remarks, counts=counts)


def _channels(file: Any, request: Request) -> tuple[list[str], list[Any], list[str]]:
    """Names and channels that are wanted, and remarks on those that are omitted."""
    candidates = [channel for group in file.groups() for channel in group.channels()]
    candidates = [channel for channel in candidates if channel.dtype.kind in "iuf" and len(channel)]
    has_groups = len({channel.group_name for channel in candidates}) > 1
    names = [f"{c.group_name}/{c.name}" if has_groups else c.name for c in candidates]
    units = [str(channel.properties.get("unit_string", "")) for channel in candidates]
    chosen = request.chosen(names, units)
    if not chosen:
        raise ParameterError("holds no channel of numbers")
    omissions = request.omissions(names, units)
    return [names[c] for c in chosen], [candidates[c] for c in chosen], omissions


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


def _axes(
    file: Any, names: Sequence[str], channels: Sequence[Any], pieces: "Sequence[Sequence[Change]]",
    origin_s: int, request: Request,
) -> tuple[list[Axis], str]:  # fmt: skip
    """Time axis of each channel, and the start time of their origin."""
    from .. import tdms_segments as segments

    factors = [_time_factor(n, c.properties) for n, c in zip(names, channels, strict=True)]
    firsts = [piece[0][1] for piece in pieces]
    starts = [segments.start_s(p, f, origin_s) for p, f in zip(firsts, factors, strict=True)]
    axes = []
    for name, channel, piece, factor, start in zip(
        names, channels, pieces, factors, starts, strict=True
    ):
        rate_hz = request.sample_rate_hz or _rate_hz(file, name, channel, piece[0][1], factor)
        segments.check_constant(name, piece, segments.INCREMENT, (0, len(channel)), rate_hz)
        offset_s = factor * float(piece[0][1].get(segments.OFFSET, 0.0))
        axes.append(Axis(len(channel), rate_hz, offset_s if start is None else start))
    dated = next((p for p, s in zip(firsts, starts, strict=True) if s is not None), None)
    return axes, "" if dated is None else segments.date_of(dated, origin_s)


def _time_factor(name: str, properties: Mapping[str, Any]) -> float:
    """Factor to s of the axis of a channel.

    Raises
    ------
    ParameterError
        The axis is no time.
    """
    unit, axis = str(properties.get(_X_UNIT, "") or "s"), str(properties.get(_X_NAME, ""))
    factor = axis_factor(f"channel {name!r}: axis {axis or _X_NAME!r}", unit)
    if properties.get(_X_UNIT) or axis.strip().lower() in _TIME_NAMES:
        return factor
    raise ParameterError(
        f"channel {name!r}: its axis is {axis!r} ({_X_NAME}) without a unit: must be time"
    )


def _rate_hz(file: Any, name: str, channel: Any, first: Mapping[str, Any], factor: float) -> float:
    """Rate from the first increment, or from a property of channel, group or file."""
    increment = first.get("wf_increment")
    if increment is None:
        return _stated_rate_hz(file, name, channel)
    if not float(increment) > 0.0:
        raise ParameterError(f"channel {name!r}: wf_increment is {increment} s, must be above zero")
    return 1.0 / (factor * float(increment))


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
