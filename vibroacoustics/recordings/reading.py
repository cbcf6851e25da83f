"""A recording from a file of any format, in the labelled form."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from .asked import Asked, naming_file
from .blocks import samples_digest
from .recorded import check_part
from .remarks import SuspectWarning, overload_lines, remark
from .suspects import header_extents, suspect_channels

if TYPE_CHECKING:
    import xarray as xr


def read_recording(
    path: str | Path,
    *,
    units: Mapping[str, str] | None = None,
    calibration: Mapping[str, float] | None = None,
    channels: Sequence[str] | None = None,
    sample_rate_hz: float | None = None,
    from_s: float | None = None,
    to_s: float | None = None,
    names: Mapping[str, str] | None = None,
) -> "xr.Dataset":
    """Read a recording; docs/recordings.md says what its file must hold.

    The file is read in a process of its own, of limited memory.

    Parameters
    ----------
    path : WAV, MAT, CSV, HDF5, netCDF, UFF or TDMS file, or one that a plug-in reads
    units : unit by channel, or for all as `{"*": "Pa"}`; it overrides the file's, and is needed
        where the file states none
    calibration : factor by channel, or `*`, the channel's unit per unit stored in the file
    channels : names of the channels to read; default: all
    sample_rate_hz : actual sample rate, where the file states none or a rounded one
    from_s, to_s : part to read, in seconds from the first sample; default: all
    names : new name by the file's name of a channel; `units`, `calibration` and `channels` keep to
        the file's

    Returns
    -------
    `signal` (channel, time) in SI units, with the coordinates `channel_unit` and
    `calibration_factor` and the attributes `sample_rate_hz`, `source_file`, `source_sha256` and,
    where known, `start_time`; of a part `part_start_s`, and `part_sha256` of its samples instead
    of the file's hash where the file is larger than the cap; `reading_remarks` where there are
    warnings

    Raises
    ------
    ParameterError
        A unit, a calibration factor or the sample rate is missing or unusable, a channel is not
        in the file, samples are not finite or times not even.
    StorageError
        The file is missing, damaged, or larger than the caps.

    Warns
    -----
    RecordingWarning
        Samples are at full scale, the file's end is missing, or a channel is dead or beyond what
        a sensor can give.

    Examples
    --------
    >>> recording = va.label_recording([[0.0, 0.5]], 1000.0, ["front"], ["Pa"])
    >>> file = va.export_recording(recording, "front.csv")
    >>> va.read_recording(file)["signal"].sel(channel="front").values
    array([0. , 0.5])
    """
    request = Asked(
        Path(path), units or {}, calibration or {}, channels, sample_rate_hz, names or {}
    )
    with naming_file(request.path):
        check_part(from_s, to_s)
        is_part = from_s is not None or to_s is not None
        is_large = request.check(may_be_large=is_part or channels is not None)
        part = {"from_s": from_s, "to_s": to_s, "hashed": not is_large}
        header, stored = request.read(part)
        from .recording import label_in_place  # heavy: a refusal does not wait for it

        digest = {"source_sha256": header["sha256"]}
        if is_large:
            digest = {"part_sha256": samples_digest(stored)}
        stated = request.chosen_units(header)
        recording = label_in_place(
            stored,
            header["sample_rate_hz"],
            request.new_names(header),
            stated,
            request.new_calibration(header),
        )
    lines = [*header["remarks"], *overload_lines(header, recording["channel_unit"].values)]
    remark(request.path, lines)
    factors = recording["calibration_factor"].values.tolist()
    doubtful = suspect_channels(header["names"], stated, factors, header_extents(header))
    doubts = [each.line for each in doubtful]
    remark(request.path, doubts, SuspectWarning)
    lines += doubts
    if lines:
        recording.attrs["reading_remarks"] = "; ".join(lines)
    recording.attrs |= {"source_file": request.path.name, **digest}
    if is_part:
        recording.attrs["part_start_s"] = header["first_sample"] / header["sample_rate_hz"]
    if header["start_time"]:
        recording.attrs["start_time"] = header["start_time"]
    return recording
