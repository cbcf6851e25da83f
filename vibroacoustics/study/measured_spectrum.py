"""The user's measured third octaves of the machine, which weigh the samples with the level."""

import re
from collections.abc import Collection, Iterator
from pathlib import Path
from typing import Any, ClassVar, Final

import numpy as np
from pydantic import Field, field_validator

from ..base.arrays import Array
from ..base.column_file import read_layouts
from ..base.column_head import Layout
from ..base.csv_text import fused, read_lines
from ..base.decibel import power_of_level
from ..base.errors import ParameterError
from ..base.file_table import FileTable
from ..base.parameters import Contradictions
from ..base.weighting import a_weighting
from ..mechanics.added import third_octave_number
from .baseline import wrong_third_octave

LOWEST_HZ: Final = 25.0
"""Lowest third octave of unmodelled noise."""
_HALF_A_BAND: Final = power_of_level(0.5)
"""Upper edge of a third octave over its middle (IEC 61260-1:2014)."""
_ROUNDING: Final = 1e-3
_UNWEIGHTED: Final = "level_db"
_WEIGHTED: Final = "level_dba"
_BAND: Final = re.compile(r"leq_([\d.]+)_hz_db")
"""Columns of third octaves in `levels.csv`."""
LAYOUTS: Final = [Layout(("frequency_hz", name)) for name in (_WEIGHTED, _UNWEIGHTED)]


class MeasuredSpectrum(FileTable):
    """Third octaves of the machine without an option at one microphone and speed."""

    content: ClassVar[str] = "band_hz"
    microphone: str = Field(min_length=1)
    """Name of a receiver."""
    speed_rpm: float = Field(ge=60.0, le=60000.0)
    operating_point: str | None = None
    """Operating point of the machine's file; the one at which the study runs where left out."""
    deviation_db: float = Field(default=2.0, ge=0.5, le=10.0)
    """Standard deviation of a measured level."""
    omitted_bands_hz: tuple[float, ...] = ()
    """Bands of the file that do not weigh."""
    channel: str = ""
    """Channel of a `levels.csv` that `orders` wrote, whose bands beyond those of the study do not
    weigh; empty for a file of third octaves."""
    band_hz: tuple[float, ...] = ()
    """Nominal midband frequencies."""
    level_dba: tuple[float, ...] = ()
    """A-weighted, re 20 µPa."""

    @field_validator("omitted_bands_hz", mode="before")
    @classmethod
    def _list(cls, bands: Any) -> Any:
        return tuple(bands) if isinstance(bands, list) else bands

    @classmethod
    def read(cls, path: Path, table: dict[str, Any]) -> dict[str, Any]:
        """Read `frequency_hz` and `level_dba`, or the unweighted `level_db`; omit bands.

        With `channel` those of a recording.
        """
        if table.get("channel"):
            numbers = _of_recording(path, str(table["channel"]))
        else:
            numbers = read_layouts(path, LAYOUTS).numbers
        band_hz = numbers["frequency_hz"]
        if _WEIGHTED in numbers:
            level_dba = numbers[_WEIGHTED]
        else:
            weighting = a_weighting(power_of_level(third_octave_number(band_hz)))
            level_dba = numbers[_UNWEIGHTED] + weighting
        omitted = table.get("omitted_bands_hz", ())
        for band in omitted:
            if band not in band_hz:
                raise ParameterError(f"omitted_bands_hz = {band} Hz: {path} has no such band")
        kept = ~np.isin(band_hz, np.asarray(omitted, dtype=float))
        return {
            "band_hz": tuple(band_hz[kept].tolist()),
            _WEIGHTED: tuple(level_dba[kept].tolist()),
        }

    def contradictions(self) -> Contradictions:
        self.check_lengths([self.band_hz, self.level_dba])
        yield from filter(None, map(wrong_third_octave, self.band_hz))
        if len(set(self.band_hz)) < len(self.band_hz):
            twice = max(self.band_hz, key=self.band_hz.count)
            yield f"{self.file}: band {twice:g} Hz is given twice"
        for level in self.level_dba:
            if not -100.0 <= level <= 200.0:
                yield f"{self.file}: level = {level:g} dB: must be -100 to 200 dB"

    def within(self, maximum_hz: float) -> "MeasuredSpectrum":
        """Return the spectrum without bands of a recording that reach above a frequency."""
        if not self.channel:
            return self
        kept = [
            (band, level)
            for band, level in zip(self.band_hz, self.level_dba, strict=True)
            if band <= _highest_hz(maximum_hz)
        ]
        band_hz, level_dba = zip(*kept, strict=True) if kept else ((), ())
        return self.model_copy(update={"band_hz": band_hz, _WEIGHTED: level_dba})

    def problems(
        self,
        receivers: Collection[str],
        speeds: Collection[float],
        points: Collection[str | None],
        maximum_hz: float,
    ) -> Iterator[str]:
        """Yield what does not fit a study.

        Parameters
        ----------
        receivers, speeds : receivers and speeds of the study, rpm
        points : operating points at which it computes, or None for the machine's own values
        maximum_hz : highest frequency of the radiation
        """
        if self.microphone not in receivers:
            yield f"microphone = {self.microphone}: must be a receiver ({', '.join(receivers)})"
        if self.speed_rpm not in speeds:
            allowed = ", ".join(f"{speed:g}" for speed in speeds)
            yield f"speed_rpm = {self.speed_rpm:g} rpm: must be one of the study ({allowed} rpm)"
        if self.operating_point is not None and self.operating_point not in points:
            allowed = ", ".join(filter(None, points)) or "none, as the study names no point"
            yield f"operating_point = {self.operating_point}: must be {allowed}"
        highest_hz = _highest_hz(maximum_hz)
        bands_hz = self.within(maximum_hz).band_hz
        outside = [band for band in bands_hz if not LOWEST_HZ <= band <= highest_hz]
        if outside:
            bands = ", ".join(f"{band:g}" for band in outside)
            yield (
                f"{self.file}: bands {bands} Hz: must be {LOWEST_HZ:g} to {highest_hz:.4g} Hz, "
                "whole bands up to radiation.maximum_frequency_hz; name them in omitted_bands_hz"
            )


def _highest_hz(maximum_hz: float) -> float:
    """Return the highest nominal midband frequency whose band is whole below a frequency."""
    return maximum_hz / _HALF_A_BAND * (1.0 + _ROUNDING)


def _of_recording(path: Path, channel: str) -> dict[str, Array]:
    """Read the A-weighted third octaves of a channel from 25 Hz on from `levels.csv` of `orders`.

    Raises
    ------
    ParameterError
        The file is no such file, or has no such channel.
    """
    head, *rows = read_lines(path).rows(",") or [[]]
    bands = {
        number: float(match[1])
        for number, name in enumerate(head)
        if (match := _BAND.fullmatch(name)) and float(match[1]) >= LOWEST_HZ
    }
    if head[:2] != ["channel", "weighting"] or not bands:
        raise ParameterError(f"channel = {channel!r}: {path}: is no levels.csv of orders")
    weighted = {fused(row[0]): row for row in rows if row[1:2] == ["A"]}
    if channel not in weighted:
        names = ", ".join(map(repr, weighted)) or "none"
        raise ParameterError(f"channel = {channel!r}: {path}: must be one of {names}")
    row = weighted[channel]
    measured = {number: hz for number, hz in bands.items() if number < len(row) and row[number]}
    return {
        "frequency_hz": np.array([*measured.values()]),
        _WEIGHTED: np.array([float(row[number]) for number in measured]),
    }
