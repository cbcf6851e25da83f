"""Settings that many recordings share: channels, speed, analysis, labels of machine and run."""

import re
from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any, Final, Literal, NamedTuple

from pydantic import Field

from ..base.errors import ParameterError
from ..base.parameters import Contradictions, Parameters
from ..recordings import read_calibrator
from ..recordings.asked import ALL_CHANNELS
from ..recordings.calibrator import LEVELS_DB
from ..recordings.second_file import SpeedFile
from ..study.loading import load_machine
from ..study.order_analysis import (
    DEFAULT_COMB,
    BandMethod,
    Edge,
    NominalSpeed,
    OrderAnalysis,
    SpeedChannel,
    SpeedSource,
    TacholessSpeed,
)
from ..study.settings_file import settings_of
from ..study.toml_files import beside, read_toml
from .machine_speed import speed_of_machine

ONLY_MACHINE: Final = "1"
"""Machine of all runs where the settings name none."""
_LABEL: Final = re.compile(r"\{(machine|run)\}|\*|\?")


class ChannelSettings(Parameters):
    """Name, unit and calibration of a channel; what is missing is that of the file."""

    name: str | None = Field(default=None, min_length=1, max_length=100)
    unit: str | None = Field(default=None, min_length=1, max_length=20)
    calibration: float | None = None
    calibrator_file: str | None = None

    def contradictions(self) -> Contradictions:
        if self.calibrator_file is not None and self.calibration is not None:
            yield "give one of calibration and calibrator_file"
        if self.calibrator_file is not None and self.unit not in (None, "Pa"):
            yield f"unit = {self.unit}: must be Pa with calibrator_file"


class CalibratorSettings(Parameters):
    """Tone of the sound calibrator."""

    level_db: float = Field(default=94.0, ge=LEVELS_DB[0], le=LEVELS_DB[1])
    frequency_hz: float = Field(default=1000.0, gt=0.0, le=20e3)


class PartSettings(Parameters):
    """Sample rate and part of a recording that is read."""

    sample_rate_hz: float | None = Field(default=None, gt=0.0, le=1e9)
    from_s: float | None = Field(default=None, ge=0.0, le=1e9)
    to_s: float | None = Field(default=None, gt=0.0, le=1e9)


class SpeedSettings(Parameters):
    """Source of the speed: a channel, a nominal speed, or the orders in a channel."""

    channel: str | None = None
    channel_file: str | None = None
    pulses_per_revolution: float = Field(default=1, ge=0.001, le=100_000)
    index_channel: str | None = None
    threshold: float | None = None
    edge: Edge | None = None
    nominal_rpm: float | None = Field(default=None, gt=0.0, le=1e6)
    minimum_rpm: float | None = Field(default=None, gt=0.0, le=1e6)
    maximum_rpm: float | None = Field(default=None, gt=0.0, le=1e6)
    machine_file: str | None = None
    comb: tuple[float, ...] | None = None
    mains_hz: float | None = Field(default=None, gt=0.0, le=1e3)

    def contradictions(self) -> Contradictions:
        if (self.minimum_rpm is None) != (self.maximum_rpm is None):
            yield "minimum_rpm and maximum_rpm belong together"
        without_tacho = [self.minimum_rpm is not None, self.machine_file is not None]
        by_channel = self.channel is not None and not any(without_tacho)
        if sum([self.nominal_rpm is not None, by_channel, *without_tacho]) != 1:
            yield "give one of channel, nominal_rpm, minimum_rpm with maximum_rpm, machine_file"
        of_tacho = {"channel_file", "pulses_per_revolution", "index_channel", "threshold", "edge"}
        if not by_channel and of_tacho & self.model_fields_set:
            yield f"{', '.join(sorted(of_tacho & self.model_fields_set))}: belong to a tacho"
        if not any(without_tacho) and {"comb", "mains_hz"} & self.model_fields_set:
            yield "comb, mains_hz: belong to minimum_rpm with maximum_rpm, or machine_file"
        try:
            self.source()
        except ParameterError as error:
            yield str(error)

    def file_of(self, path: Path) -> SpeedFile | None:
        """Return the second file with the channels of the speed of a recording, None without.

        In the name of the file `{recording}` is that of the recording without its suffix.
        """
        if self.channel_file is None:
            return None
        named = self.channel_file.replace("{recording}", path.stem)
        channels = (self.channel, self.index_channel)
        return SpeedFile(Path(named), tuple(name for name in channels if name is not None))

    def source(self, path: Path = Path()) -> SpeedSource:
        """Make the source of the speed of a recording."""
        if self.nominal_rpm is not None:
            return NominalSpeed(self.nominal_rpm)
        if self.machine_file is not None:
            machine = load_machine(Path(self.machine_file))
            speed = speed_of_machine(machine, self.channel, self.mains_hz)
            return speed if self.comb is None else replace(speed, comb=self.comb)
        if self.minimum_rpm is not None and self.maximum_rpm is not None:
            comb = DEFAULT_COMB if self.comb is None else self.comb
            limits = (self.minimum_rpm, self.maximum_rpm)
            return TacholessSpeed(self.channel, *limits, comb, self.mains_hz)
        names: list[str | None] = [self.channel, self.index_channel]
        file = self.file_of(path)
        if file is not None:
            names = [name and file.name_of(name) for name in names]
        tacho = (self.pulses_per_revolution, names[1], self.threshold, self.edge)
        return SpeedChannel(str(names[0]), *tacho)


class AnalysisSettings(Parameters):
    """Orders and bands that are analysed, as in `OrderAnalysis`."""

    orders: tuple[float, ...] | None = None
    maximum_order: float | None = Field(default=None, gt=0.0, le=1e5)
    resolution_order: float | None = Field(default=None, gt=0.0, le=100.0)
    speed_step_rpm: float = Field(default=100.0, gt=0.0, le=1e5)
    bands: BandMethod = "sums"
    is_fit: bool = False

    def contradictions(self) -> Contradictions:
        try:
            OrderAnalysis(NominalSpeed(1.0), **self.stated())
        except ParameterError as error:
            yield str(error)

    def stated(self) -> dict[str, Any]:
        """Return the values that the file states."""
        return self.model_dump(exclude_unset=True)


class FileSettings(Parameters):
    """Labels of the files of a pattern, and settings in place of the common ones."""

    machine: str | None = Field(default=None, min_length=1, max_length=60)
    run: str | None = Field(default=None, min_length=1, max_length=60)
    channels: dict[str, ChannelSettings] = Field(default_factory=dict)
    speed: SpeedSettings | None = None
    recording: PartSettings | None = None


class CampaignRun(NamedTuple):
    """A recording of a campaign: its labels, how it is read and analysed.

    Attributes
    ----------
    file : file of the recording
    machine, run : labels
    reading : arguments of `read_recording`
    analysis : speed and orders
    speed_file : second file with the channels of the speed

    Examples
    --------
    >>> from pathlib import Path
    >>> settings = va.OrderAnalysis(va.NominalSpeed(2900.0))
    >>> va.CampaignRun(Path("a_1.wav"), "a", "1", {"units": {"*": "Pa"}}, settings).label
    'a: 1'
    """

    file: Path
    machine: str
    run: str
    reading: Mapping[str, Any]
    analysis: OrderAnalysis
    speed_file: SpeedFile | None = None

    @property
    def label(self) -> str:
        """Machine and run in words."""
        return self.run if self.machine == ONLY_MACHINE else f"{self.machine}: {self.run}"


class Campaign(Parameters):
    """Settings of many recordings, read by `load_campaign`.

    Examples
    --------
    >>> from pathlib import Path
    >>> campaign = va.Campaign(speed={"nominal_rpm": 2900.0}, files={"{machine}_*.wav": {}})
    >>> campaign.run_of(Path("a_1.wav")).machine
    'a'
    """

    channels: dict[str, ChannelSettings] = Field(default_factory=dict)
    calibrator: CalibratorSettings = CalibratorSettings()
    recording: PartSettings = PartSettings()
    speed: SpeedSettings | None = None
    analysis: AnalysisSettings = AnalysisSettings()
    files: dict[str, FileSettings] = Field(default_factory=dict)

    def contradictions(self) -> Contradictions:
        for pattern, settings in self.files.items():
            for label in ("machine", "run"):
                stated, in_pattern = getattr(settings, label), pattern.count(f"{{{label}}}")
                if in_pattern + (stated is not None) > 1:
                    yield f"files.{pattern}: gives the label {label} twice"

    def labels_of(self, path: Path) -> tuple[str, str]:
        """Return machine and run of a file.

        Raises
        ------
        ParameterError
            See `settings_of`.
        """
        settings, in_name = self.settings_of(path)
        machine = settings.machine or in_name.get("machine", ONLY_MACHINE)
        return machine, settings.run or in_name.get("run", path.stem)

    def settings_of(self, path: Path) -> tuple[FileSettings, dict[str, str]]:
        """Return the settings of the pattern that a file has, and labels from its name.

        Raises
        ------
        ParameterError
            The file has no pattern, or several.
        """
        if not self.files:
            return FileSettings(), {}
        matches = {pattern: _match(pattern, path) for pattern in self.files}
        having = [pattern for pattern, match in matches.items() if match is not None]
        if len(having) != 1:
            which = f"the patterns {', '.join(having)}" if having else "none of the patterns"
            raise ParameterError(
                f"{path}: has {which} of [files] ({', '.join(self.files)}): must have one"
            )
        match = matches[having[0]]
        return self.files[having[0]], {} if match is None else match.groupdict()

    def reading_of(self, path: Path) -> dict[str, Any]:
        """Return the arguments of `read_recording` for a file.

        Raises
        ------
        ParameterError, StorageError
            See `settings_of`; or the recording of a calibrator cannot be used.
        """
        settings, _ = self.settings_of(path)
        channels = dict(self.channels)
        for name, changes in settings.channels.items():
            channels[name] = _changed(channels.get(name, ChannelSettings()), changes)
        part = settings.recording or self.recording
        factors = {name: self._factor(name, each) for name, each in channels.items()}
        units = {
            name: "Pa" if each.calibrator_file is not None else each.unit
            for name, each in channels.items()
        }
        return {
            "units": _stated(units),
            "calibration": _stated(factors),
            "names": _stated({name: each.name for name, each in channels.items()}),
            "channels": list(channels) if channels and ALL_CHANNELS not in channels else None,
            **part.model_dump(),
        }

    def speed_of(self, path: Path) -> SpeedSource | None:
        """Return the source of the speed of a file, None where the settings give none."""
        speed = self._speed_settings(path)
        return None if speed is None else speed.source(path)

    def speed_file_of(self, path: Path) -> SpeedFile | None:
        """Return the second file with the speed of a recording, None where there is none."""
        speed = self._speed_settings(path)
        return None if speed is None else speed.file_of(path)

    def _speed_settings(self, path: Path) -> SpeedSettings | None:
        return self.settings_of(path)[0].speed or self.speed

    def run_of(self, path: Path) -> CampaignRun:
        """Return the run of a file, with the labels and settings that are its own.

        Raises
        ------
        ParameterError, StorageError
            See `reading_of`; or the settings give no speed.
        """
        speed = self.speed_of(path)
        if speed is None:
            raise ParameterError(f"{path}: speed is missing in the settings: add a table [speed]")
        analysis = OrderAnalysis(speed, **self.analysis.stated())
        labels, second = self.labels_of(path), self.speed_file_of(path)
        return CampaignRun(path, *labels, self.reading_of(path), analysis, second)

    def _factor(self, channel: str, settings: ChannelSettings) -> float | None:
        if settings.calibrator_file is None:
            return settings.calibration
        tone = (self.calibrator.level_db, self.calibrator.frequency_hz)
        return _calibrated(settings.calibrator_file, channel, *tone)


def load_campaign(path: str | Path) -> Campaign:
    """Read the settings of a campaign; docs/campaigns.md has their tables.

    Parameters
    ----------
    path : TOML file

    Raises
    ------
    ParameterError
        Anything is unknown, of the wrong type or outside its allowed range.

    Examples
    --------
    >>> from pathlib import Path
    >>> _ = Path("campaign.toml").write_text("speed.nominal_rpm = 2900")
    >>> va.load_campaign("campaign.toml").speed_of(Path("a_1.wav"))
    NominalSpeed(speed_rpm=2900.0)
    """
    path = Path(path)
    content = read_toml(path)
    resolve_settings_files(path, content)
    return settings_of(Campaign, path, content)


def resolve_settings_files(path: Path, content: dict[str, Any]) -> None:
    """Make names of files relative to the file that gives them, at any depth."""
    for key, value in content.items():
        if isinstance(value, dict):
            resolve_settings_files(path, value)
        elif key in ("calibrator_file", "channel_file", "machine_file") and isinstance(value, str):
            content[key] = str(beside(path, value))


def _changed(common: ChannelSettings, changes: ChannelSettings) -> ChannelSettings:
    """Channel with the values of another; either kind of calibration replaces the other."""
    values = common.model_dump(exclude_unset=True)
    if {"calibration", "calibrator_file"} & changes.model_fields_set:
        values = {k: v for k, v in values.items() if k not in ("calibration", "calibrator_file")}
    return ChannelSettings(**values | changes.model_dump(exclude_unset=True))


def _stated(values: Mapping[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in values.items() if value is not None}


def _match(pattern: str, path: Path) -> re.Match[str] | None:
    """Match of the end of a path, whole names of folders, with the labels in it."""
    wild: dict[Literal["*", "?"] | str, str] = {"*": "[^/]*", "?": "[^/]"}
    parts, end = [], 0
    for label in _LABEL.finditer(pattern):
        name = label[1]
        parts += [re.escape(pattern[end : label.start()])]
        parts += [f"(?P<{name}>[^/]+?)" if name else wild[label[0]]]
        end = label.end()
    return re.fullmatch(f"(?:.*/)?{''.join(parts)}{re.escape(pattern[end:])}", path.as_posix())


@cache
def _calibrated(file: str, channel: str, level_db: float, frequency_hz: float) -> float:
    """Factor of a calibrator's recording; files of many runs share it."""
    tone = read_calibrator(file, channel=channel, level_db=level_db, frequency_hz=frequency_hz)
    return tone.pascal_per_unit
