"""A recording and its speed as the options of a command ask for them.

Heavy imports wait until it is read.
"""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from .options import load_plugins

if TYPE_CHECKING:
    import xarray as xr

    from ..base.recording_blocks import RecordingBlocks
    from ..measured.campaign_settings import Campaign, CampaignRun
    from ..recordings.second_file import SpeedFile
    from ..study.order_analysis import OrderAnalysis, SpeedSource

SampleRate = Annotated[float | None, "Actual sample rate, Hz, instead of the file's."]

Calibrator = Annotated[
    list[str] | None,
    "CHANNEL=FILE: recording of a sound calibrator on a channel, which gives its factor in Pa; "
    "FILE alone for the channel of its name; may be repeated.",
]
CalibratorLevel = Annotated[float, "Level of the calibrator, dB re 20 µPa."]
CalibratorFrequency = Annotated[float, "Frequency of the calibrator, Hz."]
Settings = Annotated[
    Path | None,
    "TOML file: channels, units, calibration, speed, analysis and labels of many recordings; "
    "options override it.",
]


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
    calibrator_level, calibrator_frequency : level and frequency of the calibrator, dB re 20 µPa and
        Hz
    settings : file of a campaign
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
    settings: Settings = None

    @cached_property
    def campaign(self) -> "Campaign":
        """Settings that all recordings share; without a file they state nothing."""
        from ..measured.campaign_settings import Campaign, load_campaign

        return Campaign() if self.settings is None else load_campaign(self.settings)

    def stated_analysis(self) -> dict[str, Any]:
        """Return what the settings state of the analysis; without a file nothing."""
        return {} if self.settings is None else self.campaign.analysis.stated()

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

        if speed == SpeedOptions() and self.settings is not None:
            of_settings = self.campaign.speed_of(file)
            if of_settings is not None:
                return of_settings
        try:
            return speed.source()
        except MissingError as missing:
            try:
                load_plugins(plugins)
                open_recording(file, **self.arguments(file))
            except MissingError as error:
                raise MissingError(str(error), str(missing)) from None
            except VibroacousticsError:
                pass
            raise

    def at_once(
        self, file: Path, plugins: list[Path] | None, speed: "SpeedOptions | None" = None
    ) -> "xr.Dataset":
        """Read all that is asked for of a file, by built-in readers and those of plug-ins.

        Channels of the speed may be of a second file.
        """
        from ..recordings import read_recording

        load_plugins(plugins)
        recording = read_recording(file, **self.arguments(file))
        second = None if speed is None else self.speed_file(speed, file)
        if second is None:
            return recording
        from ..recordings.second_file import with_second_file

        return with_second_file(recording, second)

    def in_blocks(
        self, file: Path, plugins: list[Path] | None, speed: "SpeedOptions"
    ) -> "RecordingBlocks":
        """Hold the same in memory as the file stores it; what is too large stays in the file."""
        from ..recordings.blocks import recording_blocks
        from ..recordings.second_file import blocks_with_speed

        load_plugins(plugins)
        recording = recording_blocks(file, **self.arguments(file))
        return blocks_with_speed(recording, self.speed_file(speed, file))

    def speed_file(self, speed: "SpeedOptions", file: Path) -> "SpeedFile | None":
        """Return the second file with the speed of a recording: of the options, or the settings."""
        if speed == SpeedOptions() and self.settings is not None:
            return self.campaign.speed_file_of(file)
        return speed.second_file()

    def run(
        self, speed: "SpeedOptions", orders: "OrderOptions", plugins: list[Path] | None, file: Path
    ) -> "CampaignRun":
        """Return labels, reading and analysis of one of many recordings.

        Raises
        ------
        ParameterError, StorageError
            See `source` and `arguments`; or the settings give the file no label.
        """
        from ..measured.campaign_settings import CampaignRun

        analysis = orders.analysis(self.source(speed, file, plugins), self.stated_analysis())
        labels, second = self.campaign.labels_of(file), self.speed_file(speed, file)
        return CampaignRun(file, *labels, self.arguments(file), analysis, second)

    def arguments(self, file: Path) -> dict[str, Any]:
        """Return the arguments of `read_recording`: those of options override the settings."""
        from . import arguments as words

        units = words.assignments("--unit", self.unit)
        calibration = words.numbers("--calibration", self.calibration)
        if self.calibrator:
            from .calibrating import with_calibrators

            level, frequency = self.calibrator_level, self.calibrator_frequency
            units, calibration = with_calibrators(
                self.calibrator, level, frequency, units, calibration
            )
        common = {} if self.settings is None else self.campaign.reading_of(file)
        by_channel: dict[str, dict[str, Any]] = {
            "units": units,
            "calibration": calibration,
            "names": words.assignments("--name", self.name),
        }
        chosen: dict[str, Any] = {
            "channels": None if self.channels is None else self.channels.split(","),
            "sample_rate_hz": self.sample_rate,
            "from_s": self.from_s,
            "to_s": self.to_s,
        }
        read = chosen["channels"]
        for name, values in by_channel.items():
            of_settings = common.get(name, {}).items()
            common[name] = {
                key: each for key, each in of_settings if not read or key in (*read, "*")
            }
            common[name] |= values
        return common | {name: each for name, each in chosen.items() if each is not None}


@dataclass(frozen=True)
class OrderOptions:
    """Options of the orders that are analysed; the others are in the settings."""

    orders: Annotated[
        str | None,
        "Shaft orders, with commas; default: 1, 2 and the loudest, at most six; of several "
        "recordings and with --fit: 1,2,3,4.",
    ] = None
    maximum_order: Annotated[
        float | None, "Highest order of spectra and map; default: 20, or what the rate holds."
    ] = None
    resolution: Annotated[
        float | None, "Coarsest resolution, orders; default: 0.25, or what the length allows."
    ] = None
    speed_step: Annotated[
        float | None, "Step between operating points of a run-up, rpm; default: 100."
    ] = None
    with_map: Annotated[
        bool | None,
        typer.Option("--map/--no-map", help="Keep and plot the order map; default: of a run-up."),
    ] = None
    fit: Annotated[
        bool,
        "Fit all multiples of the orders' spacing to the whole recording at once: for a few "
        "revolutions and half orders.",
    ] = False
    bands: Annotated[
        str | None, "Third octaves: sums of lines (default), or filters of IEC 61260-1."
    ] = None

    def analysis(self, source: "SpeedSource", settings: dict[str, Any]) -> "OrderAnalysis":
        """Return the settings of the analysis; options override what a file states."""
        from ..study.order_analysis import BAND_METHODS, OrderAnalysis
        from . import arguments

        bands = (
            None if self.bands is None else arguments.chosen("--bands", self.bands, BAND_METHODS)
        )
        values = {
            "orders": None if self.orders is None else arguments.order_numbers(self.orders),
            "maximum_order": self.maximum_order,
            "resolution_order": self.resolution,
            "speed_step_rpm": self.speed_step,
            "bands": bands,
            "is_fit": self.fit or None,
        }
        stated = {name: each for name, each in values.items() if each is not None}
        if self.fit and not settings.get("orders", (1.0,)):  # a fit needs the orders' spacing
            settings = {name: each for name, each in settings.items() if name != "orders"}
        return OrderAnalysis(source, **settings | stated, with_map=self.with_map)


@dataclass(frozen=True)
class SpeedOptions:
    """Options of the speed, as the command line has them."""

    speed_channel: Annotated[
        str | None, "Channel of the tacho, or of the speed in rpm; with --tacholess, of the signal."
    ] = None
    speed_file: Annotated[
        Path | None, "Second file, which holds the channels of --speed-channel and --index."
    ] = None
    pulses: Annotated[float, "Pulses of the tacho per revolution, whole or not."] = 1
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
    tacholess_line: Annotated[
        str | None,
        "Find the speed in the signal within 10 % of a line, TIME:RPM,TIME:RPM,... in s and rpm, "
        "as the page of a run-up prints it.",
    ] = None
    comb: Annotated[
        str | None, "With --tacholess: orders that the machine has, with commas; default: 1 to 10."
    ] = None
    mains: Annotated[
        float | None, "With --tacholess: frequency of the mains, Hz; its multiples are neglected."
    ] = None
    tacholess_machine: Annotated[
        Path | None,
        "Machine file, .toml: find the speed in the signal by its motor: the slip of an induction "
        "motor, or the limits of --tacholess; its poles and teeth are the comb.",
    ] = None

    def second_file(self) -> "SpeedFile | None":
        """Return the second file with the channels of the speed, None without one."""
        if self.speed_file is None:
            return None
        from ..recordings.second_file import SpeedFile

        names = (self.speed_channel, self.index)
        return SpeedFile(self.speed_file, tuple(name for name in names if name is not None))

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
            SpeedLine,
            TacholessSpeed,
        )
        from .arguments import chosen, line_points, order_numbers

        tacholess = self.tacholess is not None or self.tacholess_machine is not None
        without_tacho = [tacholess, self.tacholess_line is not None]
        by_channel = self.speed_channel is not None and not any(without_tacho)
        sources = sum([self.rpm is not None, by_channel, *without_tacho])
        if sources != 1:
            kind = ParameterError if sources else MissingError
            raise kind(
                "speed: give one of --speed-channel CHANNEL, --rpm NUMBER, "
                "--tacholess LOWEST HIGHEST, --tacholess-line TIME:RPM,TIME:RPM and "
                "--tacholess-machine FILE"
            )
        tacho = any(option is not None for option in (self.index, self.threshold, self.edge))
        if (tacho or self.pulses != 1) and not by_channel:
            raise ParameterError(
                "--index, --pulses, --threshold, --edge: belong to a tacho, --speed-channel CHANNEL"
            )
        if self.speed_file is not None and not by_channel:
            raise ParameterError("--speed-file: belongs to --speed-channel CHANNEL")
        if self.tacholess_machine is not None:
            return self._of_machine(self.tacholess_machine)
        if (self.comb is not None or self.mains is not None) and not any(without_tacho):
            raise ParameterError("--comb, --mains: belong to --tacholess LOWEST HIGHEST")
        orders = DEFAULT_COMB if self.comb is None else order_numbers(self.comb, "--comb")
        if self.tacholess_line is not None:
            points = line_points(self.tacholess_line)
            return SpeedLine(self.speed_channel, points, orders, self.mains)
        if self.tacholess is not None:
            return TacholessSpeed(self.speed_channel, *self.tacholess, orders, self.mains)
        if self.rpm is not None:
            return NominalSpeed(self.rpm)
        edge = None if self.edge is None else chosen("--edge", self.edge, EDGES)
        names, second = [self.speed_channel, self.index], self.second_file()
        if second is not None:
            names = [name and second.name_of(name) for name in names]
        return SpeedChannel(str(names[0]), self.pulses, names[1], self.threshold, edge)

    def _of_machine(self, file: Path) -> "SpeedSource":
        """Make the source of the speed that the motor of a machine file gives."""
        from dataclasses import replace

        from ..measured.machine_speed import speed_of_machine
        from ..study.loading import load_machine
        from .arguments import order_numbers

        machine = load_machine(file)
        speed = speed_of_machine(machine, self.speed_channel, self.mains, self.tacholess)
        return (
            speed if self.comb is None else replace(speed, comb=order_numbers(self.comb, "--comb"))
        )
