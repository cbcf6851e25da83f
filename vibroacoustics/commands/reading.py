"""A recording as the options of a command ask for it. Heavy imports wait until it is read."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from .options import load_plugins

if TYPE_CHECKING:
    import xarray as xr

    from ..base.recording_blocks import RecordingBlocks

SampleRate = Annotated[float | None, "Actual sample rate, Hz, instead of the file's."]


@dataclass(frozen=True)
class Reading:
    """Options of what is read of a recording.

    Attributes
    ----------
    unit, calibration : assignments CHANNEL=UNIT and CHANNEL=FACTOR
    channels : names, with commas
    sample_rate : instead of the file's
    from_s, to_s : part of the recording
    """

    unit: Annotated[
        list[str] | None,
        "CHANNEL=UNIT, where the file states none; may be repeated.",
    ] = None
    calibration: Annotated[
        list[str] | None,
        "CHANNEL=FACTOR: unit per unit stored in the file; may be repeated.",
    ] = None
    channels: Annotated[str | None, "Channels to read, with commas."] = None
    sample_rate: SampleRate = None
    from_s: Annotated[
        float | None,
        typer.Option("--from", help="Begin of the part to read, s from the first sample."),
    ] = None
    to_s: Annotated[float | None, typer.Option("--to", help="End of the part to read, s.")] = None

    def at_once(self, file: Path, plugins: list[Path] | None) -> "xr.Dataset":
        """Read all that is asked for of a file, by built-in readers and those of plug-ins.

        Raises
        ------
        ParameterError, StorageError
            It cannot be read, or is larger than the cap.
        """
        from ..recordings import read_recording

        load_plugins(plugins)
        return read_recording(file, **self._asked())

    def in_blocks(self, file: Path, plugins: list[Path] | None) -> "RecordingBlocks":
        """Read the same into memory; what is too large for that stays in its file.

        Raises
        ------
        ParameterError, StorageError
            It cannot be read.
        """
        from ..recordings import LabelledBlocks, open_recording
        from ..recordings.recorded import TooLargeError

        try:
            return LabelledBlocks(self.at_once(file, plugins))
        except TooLargeError:
            return open_recording(file, **self._asked())

    def _asked(self) -> dict[str, Any]:
        from . import arguments

        return {
            "units": arguments.assignments("--unit", self.unit),
            "calibration": arguments.numbers("--calibration", self.calibration),
            "channels": None if self.channels is None else self.channels.split(","),
            "sample_rate_hz": self.sample_rate,
            "from_s": self.from_s,
            "to_s": self.to_s,
        }
