"""Settings of a hammer test from its time records."""

from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

from pydantic import Field

from ..base.errors import ParameterError
from ..base.parameters import Contradictions, Parameters
from ..study.settings_file import settings_of
from ..study.toml_files import read_toml
from .campaign_settings import (
    CalibratorSettings,
    Campaign,
    ChannelSettings,
    PartSettings,
    resolve_settings_files,
)
from .settings import Point


class HammerSettings(Parameters):
    """Channel of the force, blocks and windows."""

    force_channel: str = Field(min_length=1)
    block_s: float | None = Field(default=None, gt=0.0, le=1000.0)
    highest_frequency_hz: float | None = Field(default=None, gt=0.0, le=1e6)
    recorder_window_s: float | None = Field(default=None, gt=0.0, le=1000.0)
    """Time constant of an exponential window that the recorder put on the responses."""


class PointHits(Point):
    """Node and direction of the push, and nodes of the responses where these move."""

    responses: dict[str, Point] = Field(default_factory=dict)


class HammerTest(Parameters):
    """Settings of a hammer test."""

    title: str = Field(min_length=1, max_length=200)
    hammer: HammerSettings
    channels: dict[str, ChannelSettings] = Field(default_factory=dict)
    calibrator: CalibratorSettings = CalibratorSettings()
    recording: PartSettings = PartSettings()
    responses: dict[str, Point] = Field(default_factory=dict)
    hits: dict[str, PointHits] = Field(min_length=1)

    def contradictions(self) -> Contradictions:
        force = self.hammer.force_channel
        for name, each in self.hits.items():
            if not each.direction:
                yield f"hits.{name}.direction: is missing; give that of the push, such as -z"
            if not (self.responses or each.responses):
                yield f"hits.{name}: has no response; add a table [responses]"
            if force in {**self.responses, **each.responses}:
                yield f"responses.{force}: is the channel of the force"


class Record(NamedTuple):
    """File with hits at one point.

    Attributes
    ----------
    path : its path
    hits : its point
    responses : points of its channels
    reading : arguments of `read_recording`
    """

    path: Path
    hits: PointHits
    responses: dict[str, Point]
    reading: dict[str, Any]


def load_hammer_test(path: Path) -> HammerTest:
    """Read the settings of a hammer test.

    Raises
    ------
    ParameterError
        Anything is unknown, of the wrong type or outside its allowed range.
    """
    content = read_toml(path)
    resolve_settings_files(path, content)
    return settings_of(HammerTest, path, content)


def records_of(test: HammerTest, folder: Path) -> Iterator[Record]:
    """Give the files of a test.

    Raises
    ------
    ParameterError
        A file is missing.
    """
    campaign = partial(Campaign, calibrator=test.calibrator, recording=test.recording)
    for pattern, hits in test.hits.items():
        paths = sorted(folder.glob(pattern)) if set(pattern) & set("*?") else [folder / pattern]
        if not paths:
            raise ParameterError(f"hits.{pattern}: is the name of no file in {folder}")
        responses = {**test.responses, **hits.responses}
        for path in paths:
            reading = campaign(channels=test.channels).reading_of(path)
            reading["channels"] = [test.hammer.force_channel, *responses]
            for key in ("units", "calibration", "names"):
                kept = {"*", *reading["channels"]}
                reading[key] = {name: each for name, each in reading[key].items() if name in kept}
            yield Record(path, hits, responses, reading)
