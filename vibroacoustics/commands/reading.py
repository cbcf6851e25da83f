"""A recording and its speed as the options of a command ask for them.

Heavy imports wait until it is read.
"""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from .options import load_plugins

if TYPE_CHECKING:
    import xarray as xr

    from ..base.recording_blocks import RecordingBlocks
    from ..study.order_analysis import SpeedSource

SampleRate = Annotated[float | None, "Actual sample rate, Hz, instead of the file's."]

Calibrator = Annotated[
    list[str] | None,
    "CHANNEL=FILE: recording of a sound calibrator on a channel, which gives its factor in Pa; "
    "FILE alone for the channel of its name; may be repeated.",
]
CalibratorLevel = Annotated[float, "Level of the calibrator, dB re 20 µPa."]
CalibratorFrequency = Annotated[float, "Frequency of the calibrator, Hz."]


@dataclass(frozen=True)
class Reading:
    """Options of what is read of a recording.

    Attributes
    ----------
    unit, calibration : assignments CHANNEL=UNIT and CHANNEL=FACTOR
    channels : names, with commas
    sample_rate : instead of the file's
    from_s, to_s : part of the recording
    name : assignments CHANNEL=NAME
    calibrator : assignments CHANNEL=FILE, or files alone
    calibrator_level, calibrator_frequency : of the calibrator, dB re 20 µPa and Hz
    """

    unit: Annotated[
        list[str] | None, "CHANNEL=UNIT, where the file states none; may be repeated."
    ] = None
    calibration: Annotated[
        list[str] | None, "CHANNEL=FACTOR: unit per unit stored in the file; may be repeated."
    ] = None
    channels: Annotated[str | None, "Channels to read, with commas."] = None
    sample_rate: SampleRate = None
    from_s: Annotated[
        float | None,
        typer.Option("--from", help="Begin of the part to read, s from the first sample."),
    ] = None
    to_s: Annotated[float | None, typer.Option("--to", help="End of the part to read, s.")] = None
    name: Annotated[list[str] | None, "CHANNEL=NAME: new name of a channel; may be repeated."] = (
        None
    )
    calibrator: Calibrator = None
    calibrator_level: CalibratorLevel = 94.0
    calibrator_frequency: CalibratorFrequency = 1000.0

    def source(
        self, speed: "SpeedOptions", file: Path, plugins: list[Path] | None
    ) -> "SpeedSource":
        """Make the source of the speed; where none is given, ask for all else that is missing.

        Raises
        ------
        ParameterError
            See `SpeedOptions.source`; what the file lacks is in the same message.
        """
        from ..base.errors import VibroacousticsError
        from ..recordings import open_recording
        from ..recordings.recorded import MissingError

        try:
            return speed.source()
        except MissingError as missing:
            try:
                load_plugins(plugins)
                open_recording(file, **self._asked())
            except MissingError as error:
                raise MissingError(str(error), str(missing)) from None
            except VibroacousticsError:
                pass
            raise

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

        units = arguments.assignments("--unit", self.unit)
        calibration = arguments.numbers("--calibration", self.calibration)
        if self.calibrator:
            from .calibrating import with_calibrators

            level, frequency = self.calibrator_level, self.calibrator_frequency
            units, calibration = with_calibrators(
                self.calibrator, level, frequency, units, calibration
            )
        return {
            "units": units,
            "calibration": calibration,
            "channels": None if self.channels is None else self.channels.split(","),
            "sample_rate_hz": self.sample_rate,
            "from_s": self.from_s,
            "to_s": self.to_s,
            "names": arguments.assignments("--name", self.name),
        }


@dataclass(frozen=True)
class SpeedOptions:
    """Options of the speed, as the command line has them."""

    speed_channel: Annotated[
        str | None, "Channel of the tacho, or of the speed in rpm; with --tacholess, of the signal."
    ] = None
    pulses: Annotated[int, "Pulses of the tacho per revolution."] = 1
    index: Annotated[str | None, "Channel with one pulse a revolution: crank angle zero."] = None
    threshold: Annotated[
        float | None, "Level of the tacho that marks the angle, in its unit; default: follows it."
    ] = None
    edge: Annotated[str | None, "Edge of the tacho's pulses: rising or falling; default: auto."] = (
        None
    )
    rpm: Annotated[float | None, "Nominal shaft speed, rpm, instead of a channel."] = None
    tacholess: Annotated[
        tuple[float, float] | None, "Find the speed in the signal: lowest and highest speed, rpm."
    ] = None
    comb: Annotated[
        str | None, "With --tacholess: orders that the machine has, with commas; default: 1 to 10."
    ] = None
    mains: Annotated[
        float | None, "With --tacholess: frequency of the mains, Hz; its multiples are neglected."
    ] = None
    tacholess_machine: Annotated[
        Path | None,
        "Machine file, .toml: find the speed in the signal within the slip of its induction motor.",
    ] = None

    def source(self) -> "SpeedSource":
        """Make the source of the speed that the options give.

        Raises
        ------
        ParameterError
            None or two are given, or an option belongs to another source.
        """
        from ..base.errors import ParameterError
        from ..recordings.recorded import MissingError
        from ..study.order_analysis import (
            DEFAULT_COMB,
            EDGES,
            NominalSpeed,
            SpeedChannel,
            TacholessSpeed,
        )
        from .arguments import chosen, order_numbers

        without_tacho = [self.tacholess is not None, self.tacholess_machine is not None]
        by_channel = self.speed_channel is not None and not any(without_tacho)
        sources = sum([self.rpm is not None, by_channel, *without_tacho])
        if sources != 1:
            kind = ParameterError if sources else MissingError
            raise kind(
                "speed: give one of --speed-channel CHANNEL, --rpm NUMBER, "
                "--tacholess LOWEST HIGHEST and --tacholess-machine FILE"
            )
        tacho = any(option is not None for option in (self.index, self.threshold, self.edge))
        if (tacho or self.pulses != 1) and not by_channel:
            raise ParameterError(
                "--index, --pulses, --threshold, --edge: belong to a tacho, --speed-channel CHANNEL"
            )
        if self.tacholess_machine is not None:
            return self._of_machine(self.tacholess_machine)
        if (self.comb is not None or self.mains is not None) and self.tacholess is None:
            raise ParameterError("--comb, --mains: belong to --tacholess LOWEST HIGHEST")
        if self.tacholess is not None:
            orders = DEFAULT_COMB if self.comb is None else order_numbers(self.comb, "--comb")
            return TacholessSpeed(self.speed_channel, *self.tacholess, orders, self.mains)
        if self.rpm is not None:
            return NominalSpeed(self.rpm)
        edge = None if self.edge is None else chosen("--edge", self.edge, EDGES)
        return SpeedChannel(str(self.speed_channel), self.pulses, self.index, self.threshold, edge)

    def _of_machine(self, file: Path) -> "SpeedSource":
        """Make the source of the speed that the motor of a machine file gives."""
        from dataclasses import replace

        from ..measured.machine_speed import speed_of_machine
        from ..study.loading import load_machine
        from .arguments import order_numbers

        speed = speed_of_machine(load_machine(file), self.speed_channel, self.mains)
        return (
            speed if self.comb is None else replace(speed, comb=order_numbers(self.comb, "--comb"))
        )
