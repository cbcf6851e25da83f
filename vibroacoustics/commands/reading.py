"""A recording as the options of a command ask for it."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import xarray as xr

from ..base.recording_blocks import RecordingBlocks
from ..recordings import LabelledBlocks, open_recording, read_recording
from ..recordings.recorded import TooLargeError
from . import arguments
from .options import load_plugins


@dataclass(frozen=True)
class Reading:
    """What is read, in the words of the options.

    Attributes
    ----------
    file : of the recording
    unit, calibration : assignments CHANNEL=UNIT and CHANNEL=FACTOR
    channels : names, with commas
    sample_rate_hz : instead of the file's
    from_s, to_s : part of the recording
    plugins : files with readers
    """

    file: Path
    unit: list[str] | None
    calibration: list[str] | None
    channels: str | None
    sample_rate_hz: float | None
    from_s: float | None
    to_s: float | None
    plugins: list[Path] | None

    def at_once(self) -> xr.Dataset:
        """All that is asked for.

        Raises
        ------
        ParameterError, StorageError
            It cannot be read, or is larger than the cap.
        """
        load_plugins(self.plugins)
        return read_recording(self.file, **self._asked())

    def in_blocks(self) -> RecordingBlocks:
        """The same in memory; what is too large for that stays in its file.

        Raises
        ------
        ParameterError, StorageError
            It cannot be read.
        """
        try:
            return LabelledBlocks(self.at_once())
        except TooLargeError:
            return open_recording(self.file, **self._asked())

    def _asked(self) -> dict[str, Any]:
        return {
            "units": arguments.assignments("--unit", self.unit),
            "calibration": arguments.numbers("--calibration", self.calibration),
            "channels": None if self.channels is None else self.channels.split(","),
            "sample_rate_hz": self.sample_rate_hz,
            "from_s": self.from_s,
            "to_s": self.to_s,
        }
