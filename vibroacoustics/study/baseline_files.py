"""Readers of measured baselines: one a format, by the suffix of the file's name."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any, Final

from ..base.errors import ParameterError
from ..base.registry import Registry
from .baseline import BaselineSettings

Rows = list[dict[str, Any]]
"""Values of parameters by name."""


@dataclass(frozen=True)
class BaselineFile:
    """A file of the baseline, and what it does not say itself.

    Attributes
    ----------
    path : path of the file
    settings : settings of the baseline
    receivers : names of the study's microphones
    stated_speed : gives the speed of a file that states none, rpm
    """

    path: Path
    settings: BaselineSettings
    receivers: Sequence[str]
    stated_speed: Callable[[], float]


@dataclass(frozen=True)
class BaselineContent:
    """Content of a file.

    Attributes
    ----------
    third_octaves : values of `BaselineSpectrum`
    orders : values of `BaselineOrders`
    """

    third_octaves: Rows = field(default_factory=list)
    orders: Rows = field(default_factory=list)


@dataclass(frozen=True)
class BaselineReader:
    """One format of measured baselines.

    Attributes
    ----------
    name : name of the format, short
    suffixes : suffixes of the files' names, small letters with the dot
    read : function that reads the content of a file
    """

    name: str
    suffixes: tuple[str, ...]
    read: Callable[[BaselineFile], BaselineContent]


BASELINE_READERS: Final[Registry[BaselineReader]] = Registry(
    "baseline reader", BaselineReader, "name", "measured.baselines", "vibroacoustics.baselines"
)


def read_baseline(
    settings: BaselineSettings, paths: Sequence[Path], receivers: Sequence[str]
) -> BaselineContent:
    """Read what all files of a baseline hold together.

    Third octaves that a file states take the place of those that come from a narrow band at the
    same microphone.

    Raises
    ------
    ParameterError
        A file is of no known format, cannot be read, or there are more speeds than files.
    """
    by_suffix = {end: reader for reader in BASELINE_READERS.values() for end in reader.suffixes}
    speeds = list(settings.recorded_speed_rpm)
    third_octaves: Rows = []
    orders: Rows = []
    for path in paths:
        reader = by_suffix.get(path.suffix.lower())
        if reader is None:
            raise ParameterError(f"{path}: must be one of {', '.join(sorted(by_suffix))}")
        file = BaselineFile(path, settings, receivers, partial(_next, speeds, path))
        content = reader.read(file)
        third_octaves += content.third_octaves
        orders += content.orders
    if speeds:
        raise ParameterError(
            f"recorded_speed_rpm: {len(settings.recorded_speed_rpm)} values, "
            f"{len(settings.recorded_speed_rpm) - len(speeds)} files state no speed"
        )
    stated = {
        spectrum["microphone"] for spectrum in third_octaves if not spectrum.get("without_orders")
    }
    kept = [
        spectrum
        for spectrum in third_octaves
        if spectrum["microphone"] not in stated or not spectrum.get("without_orders")
    ]
    return BaselineContent(kept, orders)


def _next(speeds: list[float], path: Path) -> float:
    if not speeds:
        raise ParameterError(f"{path}: states no speed: recorded_speed_rpm is missing")
    return speeds.pop(0)
