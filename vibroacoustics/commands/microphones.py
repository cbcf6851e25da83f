"""Recordings of several files that are one measurement, and the room that it was made in."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..base.allowed import check_range
from ..base.column_file import read_columns
from ..base.errors import ParameterError, gathered
from .reading import Reading

if TYPE_CHECKING:
    import xarray as xr

    from ..measured.sound_power import MeasurementSurface

Absorption = float | dict[float, float] | None


def read_files(
    files: Sequence[Path], reading: Reading, plugins: list[Path] | None
) -> "list[xr.Dataset]":
    """Recordings, each with the assignments that are its own.

    `CHANNEL=…` holds in every file, `FILE:CHANNEL=…` in that file alone, named without its ending.
    """
    stems = [file.stem for file in files]

    def read(file: Path) -> "xr.Dataset":
        return replace(
            reading,
            unit=_of_file(reading.unit, file.stem, stems),
            calibration=_of_file(reading.calibration, file.stem, stems),
            calibrator=_of_file(reading.calibrator, file.stem, stems),
        ).at_once(file, plugins)

    return gathered(read, files)


def _of_file(texts: list[str] | None, stem: str, stems: Sequence[str]) -> list[str] | None:
    chosen = []
    for text in texts or ():
        file, colon, receiver = text.partition(":")
        if not (colon and file in stems):
            chosen.append(text)
        elif file == stem:
            chosen.append(receiver)
    return chosen or None


def surface_of(
    hemisphere: float | None, box: tuple[float, float, float, float] | None
) -> "MeasurementSurface":
    """The surface that one of two options gives.

    Raises
    ------
    ParameterError
        None or both are given, or a size is out of range.
    """
    from ..measured.sound_power import MeasurementSurface

    if (hemisphere is None) == (box is None):
        raise ParameterError(
            "surface: give one of --hemisphere RADIUS and --box LENGTH WIDTH HEIGHT DISTANCE, m"
        )
    if box is not None:
        return MeasurementSurface.box(*box)
    return MeasurementSurface.hemisphere(float(hemisphere or 0.0))


def absorption_of(
    area: str | None, reverberation: str | None, volume_m3: float | None
) -> Absorption:
    """Absorption area of the room, m², one number or by band; none for a free field.

    Parameters
    ----------
    area : number, m², or CSV file with `band_hz` and `absorption_area_m2`
    reverberation : number, s, or CSV file with `band_hz` and `reverberation_time_s`
    volume_m3 : volume of the room, with the reverberation time

    Raises
    ------
    ParameterError
        Too much or too little is given, or a value is out of range.
    """
    if area is not None and reverberation is not None:
        raise ParameterError("room: give one of --absorption-area and --reverberation-time")
    if (reverberation is None) != (volume_m3 is None):
        raise ParameterError("room: --reverberation-time and --volume belong together")
    if area is not None:
        return _number_or_file(area, "--absorption-area", "absorption_area_m2", float)
    if reverberation is None or volume_m3 is None:
        return None
    check_range("--volume", volume_m3, 1.0, 1e6, "m³")
    from ..levels.measured_power import reverberant_absorption_area_m2

    def area_m2(seconds: float) -> float:
        check_range("--reverberation-time", seconds, 0.01, 100.0, "s")
        return float(reverberant_absorption_area_m2(volume_m3, np.asarray(seconds)))

    return _number_or_file(reverberation, "--reverberation-time", "reverberation_time_s", area_m2)


def _number_or_file(
    text: str, option: str, column: str, area_m2: Callable[[float], float]
) -> float | dict[float, float]:
    try:
        return area_m2(float(text))
    except ValueError:
        pass
    if Path(text).suffix.lower() != ".csv":
        raise ParameterError(f"{option} {text!r}: must be a number or a CSV file")
    numbers = read_columns(Path(text), ("band_hz", column)).numbers
    by_band = zip(numbers["band_hz"].tolist(), numbers[column].tolist(), strict=True)
    return {band: area_m2(value) for band, value in by_band}
