"""A recording that is read in blocks: from memory, or from a file that memory does not hold."""

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..base.arrays import Array
from ..base.errors import ParameterError
from ..base.recording_blocks import BLOCK_BYTES, READ_BYTES, RecordingBlocks
from .asked import Asked, naming_file
from .child_process import read_in_child
from .extent import Extent
from .recorded import (
    MAXIMUM_RECORDING_BYTES,
    Request,
    Samples,
    TooLargeError,
    check_part,
    check_rate,
    listed,
)
from .remarks import SuspectWarning, overload_lines, remark
from .scaling import check_finite, scale_in_place, si_scale
from .suspects import Suspect, header_extents, suspect_channels

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True)
class FileBlocks:
    """A recording in a file; each block is read by a process of its own, of limited memory.

    Samples that `hold_recording` has read already are converted from memory.
    """

    file_request: Asked
    header: Mapping[str, Any]
    first_sample: int
    samples: int
    channel_units: Sequence[str]
    calibration_factors: Sequence[float]
    remarks: dict[str, str] = field(default_factory=dict)
    """Remarks for the user: of the file, and of overloads the first of each channel."""
    stored: Samples | None = None
    """Samples of the file, not in SI units, shape (channel, time); None where not yet read."""
    further: Mapping[str, Any] = field(default_factory=dict)
    """Attributes of what was read all at once: hash, and begin of a part."""
    extents: dict[str, Extent] = field(default_factory=dict)
    """Extent of what was read of each channel, in the unit of the file."""
    suspects: list[Suspect] = field(default_factory=list)
    """Channels that are dead or impossible; known when all samples were read."""

    @property
    def sample_rate_hz(self) -> float:
        """Actual sample rate."""
        return float(self.header["sample_rate_hz"])

    @property
    def channels(self) -> Sequence[str]:
        """Names, each once."""
        return tuple(self.file_request.new_names(self.header))

    @property
    def read_bytes(self) -> int:
        """Samples that are best read at a time, in bytes of float64."""
        return READ_BYTES if self.stored is None else BLOCK_BYTES

    @property
    def attributes(self) -> Mapping[str, Any]:
        """Attributes as `read_recording` gives them; a hash of what was read all at once."""
        attributes: dict[str, Any] = {
            "sample_rate_hz": self.sample_rate_hz,
            "source_file": self.file_request.path.name,
            **self.further,
        }
        if self.header["start_time"]:
            attributes["start_time"] = self.header["start_time"]
        if self.stored is None and self.samples < self.header["total_samples"]:
            attributes["part_start_s"] = self.first_sample / self.sample_rate_hz
        if self.remarks:
            attributes["reading_remarks"] = "; ".join(self.remarks.values())
        return attributes

    def read(self, channels: Sequence[str], first: int, last: int) -> Array:
        """Samples of some channels; see `RecordingBlocks`.

        Raises
        ------
        ParameterError
            There is no such channel or sample, or a sample is not finite.
        StorageError
            The file is damaged, or the block larger than the cap.
        """
        _check_block(self, channels, first, last)
        start = self.first_sample
        rows = [self.channels.index(name) for name in channels]
        if self.stored is not None:
            return _in_si(self.stored[:, first:last], rows, self.calibration_factors)
        stored = [self.header["names"][row] for row in rows]
        part = {"samples": [start + first, start + last], "channels": stored, "hashed": False}
        part["line"] = self.header["line"]
        with naming_file(self.file_request.path):
            header, samples = read_in_child(self.file_request.request() | part)
            units = [self.channel_units[row] for row in rows]
            scale_in_place(samples, channels, [self.calibration_factors[row] for row in rows])
        self._remark(overload_lines(header, units))
        self._extend(channels, header_extents(header), first)
        return samples

    @property
    def deviations(self) -> dict[str, float]:
        """Standard deviation of the samples that were read, by channel, in SI units."""
        factors = zip(self.channels, self.calibration_factors, strict=True)
        return {
            name: abs(factor) * self.extents[name].deviation
            for name, factor in factors
            if name in self.extents
        }

    def _extend(self, channels: Sequence[str], behind: Sequence[Extent], first: int) -> None:
        """Join the extents of a block, and look for suspects behind the last one."""
        for name, extent in zip(channels, behind, strict=True):
            before = self.extents.pop(name, None)
            if first == 0:
                self.extents[name] = extent
            elif before is not None and before.samples == first:
                self.extents[name] = before.joined(extent)
        read = [self.extents[name].samples for name in channels if name in self.extents]
        if read == [self.samples] * len(channels):
            self._suspect(channels)

    def _suspect(self, channels: Sequence[str]) -> None:
        """Warn of channels that are dead or impossible, of each once."""
        rows = [self.channels.index(name) for name in channels]
        units = self.file_request.chosen_units(self.header)
        doubtful = suspect_channels(
            [self.header["names"][row] for row in rows],
            [units[row] for row in rows],
            [self.calibration_factors[row] for row in rows],
            [self.extents[name] for name in channels],
        )
        new = [each for each in doubtful if each not in self.suspects]
        remark(self.file_request.path, [each.line for each in new], SuspectWarning)
        self.suspects.extend(new)
        self.remarks.update({each.line: each.line for each in new})

    def _remark(self, lines: Sequence[str]) -> None:
        """Warn of a channel's overload once, not in every block."""
        new = {line.partition(": ")[0]: line for line in lines}
        new = {about: line for about, line in new.items() if about not in self.remarks}
        remark(self.file_request.path, new.values())
        self.remarks.update(new)


@dataclass(frozen=True)
class LabelledBlocks:
    """A recording in the labelled form, which is in memory already."""

    recording: "xr.Dataset"

    @property
    def sample_rate_hz(self) -> float:
        """Actual sample rate."""
        return float(self.recording.attrs["sample_rate_hz"])

    @property
    def samples(self) -> int:
        """Samples of a channel."""
        return int(self.recording.sizes["time"])

    @property
    def channels(self) -> Sequence[str]:
        """Names, each once."""
        return tuple(str(name) for name in self.recording["channel"].values)

    @property
    def channel_units(self) -> Sequence[str]:
        """SI unit of each channel's samples."""
        return tuple(str(unit) for unit in self.recording["channel_unit"].values)

    @property
    def calibration_factors(self) -> Sequence[float]:
        """SI unit per unit stored, already applied, of each channel."""
        return tuple(self.recording["calibration_factor"].values.tolist())

    @property
    def read_bytes(self) -> int:
        """Samples that are best read at a time, in bytes of float64: nothing is copied."""
        return READ_BYTES

    @property
    def attributes(self) -> Mapping[str, Any]:
        """Attributes of the recording."""
        return dict(self.recording.attrs)

    def read(self, channels: Sequence[str], first: int, last: int) -> Array:
        """Samples of some channels; see `RecordingBlocks`."""
        _check_block(self, channels, first, last)
        rows = [self.channels.index(name) for name in channels]
        samples = self.recording["signal"].values[:, first:last]
        if rows == list(range(rows[0], rows[0] + len(rows))):  # side by side: nothing is copied
            return np.asarray(samples[rows[0] : rows[0] + len(rows)])
        return np.asarray(samples[rows])


def open_recording(
    path: str | Path,
    *,
    units: Mapping[str, str] | None = None,
    calibration: Mapping[str, float] | None = None,
    channels: Sequence[str] | None = None,
    sample_rate_hz: float | None = None,
    from_s: float | None = None,
    to_s: float | None = None,
    names: Mapping[str, str] | None = None,
) -> FileBlocks:
    """Open a recording of any length, to be read in blocks.

    Formats that know where a sample lies read only the block: HDF5, netCDF, WAV, FLAC, TDMS, UFF.

    Parameters
    ----------
    path, units, calibration, channels, sample_rate_hz, from_s, to_s, names : see
        `read_recording`

    Raises
    ------
    ParameterError, StorageError
        See `read_recording`; samples are checked when they are read.

    Warns
    -----
    RecordingWarning
        See `read_recording`; overloads are reported when they are read, once a channel.

    Examples
    --------
    >>> recording = va.label_recording([np.arange(8.0)], 1000.0, ["front"], ["Pa"])
    >>> file = va.export_recording(recording, "front.nc")
    >>> blocks = va.open_recording(file)
    >>> blocks.samples, blocks.read(["front"], 2, 4)
    (8, array([[2., 3.]]))
    """
    file_request = Asked(
        Path(path), units or {}, calibration or {}, channels, sample_rate_hz, names or {}
    )
    with naming_file(file_request.path):
        check_part(from_s, to_s)
        file_request.check(may_be_large=True)
        opening = {"samples": [0, 0], "opening": [from_s, to_s], "hashed": False}
        header, _ = file_request.read(opening)
        new_names, rate_hz = file_request.new_names(header), float(header["sample_rate_hz"])
        si_units, factors = si_scale(
            new_names, file_request.chosen_units(header), file_request.new_calibration(header)
        )
        request = Request(file_request.path, from_s=from_s, to_s=to_s)
        first, last = request.part(header["total_samples"], rate_hz)
    remark(file_request.path, header["remarks"])
    remarks = {line: line for line in header["remarks"]}
    return FileBlocks(file_request, header, first, last - first, si_units, factors, remarks)


def recording_blocks(path: str | Path, **reading: Any) -> FileBlocks:
    """Hold a recording in memory as the file stores it; what is too large stays in its file.

    Parameters
    ----------
    path, reading : see `read_recording`
    """
    try:
        return hold_recording(path, **reading)
    except TooLargeError:
        return open_recording(path, **reading)


def hold_recording(
    path: str | Path, *, from_s: float | None = None, to_s: float | None = None, **reading: Any
) -> FileBlocks:
    """Read a recording as the file stores it and convert each block when it is asked for.

    Single precision and 16 bits take half and a quarter of the memory of `read_recording`; every
    value that is read is the same.

    Parameters
    ----------
    path, from_s, to_s, reading : see `read_recording`

    Warns
    -----
    RecordingWarning
        See `read_recording`.
    """
    wanted = Asked(Path(path), **reading)
    with naming_file(wanted.path):
        check_part(from_s, to_s)
        is_part = from_s is not None or to_s is not None
        is_large = wanted.check(may_be_large=is_part or wanted.channels is not None)
        part = {"from_s": from_s, "to_s": to_s, "hashed": not is_large, "as_stored": True}
        header, stored = wanted.read(part)
        check_rate(header["sample_rate_hz"])
        new_names = wanted.new_names(header)
        si_units, factors = si_scale(
            new_names, wanted.chosen_units(header), wanted.new_calibration(header)
        )
        for name, factor, samples in zip(new_names, factors, stored, strict=True):
            _check_stored(name, factor, samples)
    further = {"source_sha256": header["sha256"]}
    if is_large:
        further = {"part_sha256": samples_digest(stored)}
    if is_part:
        further["part_start_s"] = header["first_sample"] / header["sample_rate_hz"]
    lines = [*header["remarks"], *overload_lines(header, si_units)]
    remark(wanted.path, lines)
    held = FileBlocks(
        wanted, header, header["first_sample"], header["samples"], si_units, factors,
        {line: line for line in lines}, stored, further,
    )  # fmt: skip
    held._extend(new_names, header_extents(header), 0)
    return held


def samples_digest(stored: Samples) -> str:
    """Hash of samples, shape (channel, time), as float64."""
    digest = hashlib.sha256()
    for samples in stored:
        digest.update(np.ascontiguousarray(samples, dtype=float).data.cast("B"))
    return digest.hexdigest()


def _in_si(stored: Samples, rows: Sequence[int], factors: Sequence[float]) -> Array:
    """Rows of stored samples in SI units, shape (row, time)."""
    samples = np.empty((len(rows), stored.shape[1]))
    for row, converted in zip(rows, samples, strict=True):
        np.multiply(stored[row], factors[row], out=converted, dtype=float)
    return samples


def _check_stored(name: str, factor: float, samples: Samples) -> None:
    """Refuse samples of a channel that are not finite in SI units."""
    extremes = np.array([samples.min(), samples.max()], dtype=float)  # not finite if a sample is
    with np.errstate(over="ignore", invalid="ignore"):
        if not np.all(np.isfinite(extremes * factor)):
            check_finite(name, samples.astype(float) * factor)


def _check_block(blocks: RecordingBlocks, channels: Sequence[str], first: int, last: int) -> None:
    unknown = [name for name in channels if name not in blocks.channels]
    if unknown:
        raise ParameterError(f"no channel {unknown[0]!r} among {listed(blocks.channels)}")
    if not 0 <= first < last <= blocks.samples:
        raise ParameterError(
            f"samples {first} to {last}: must lie within 0 to {blocks.samples} and be one at least"
        )
    if 8 * len(channels) * (last - first) > MAXIMUM_RECORDING_BYTES:
        raise ParameterError(f"samples {first} to {last}: more than the cap allows at once")
