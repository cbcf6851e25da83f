"""A measured baseline: third octaves at microphones over speed, from a CSV file."""

import csv
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Final

import numpy as np
from pydantic import Field, model_validator

from ..base.decibel import power_of_level
from ..base.errors import ParameterError
from ..base.parameters import Parameters
from ..base.regular_file import read_text
from ..mechanics.added import third_octave_number
from .measured_floor import MeasuredFloor
from .measured_shell import MeasuredShell
from .measured_sound_path import MeasuredSoundPath

COLUMNS: Final = ("microphone", "speed_rpm", "band_hz", "level_db")
MAXIMUM_BYTES: Final = 10_000_000
LOWEST_HZ: Final = 10.0
HIGHEST_HZ: Final = 20000.0
ROUNDED: Final = 0.02
"""Nominal midband frequencies are less than this share off the exact ones."""


class BaselineSpectrum(Parameters):
    """Unweighted levels of the third octaves at a microphone and a speed."""

    microphone: str
    speed_rpm: float = Field(ge=60.0, le=60000.0)
    band_hz: tuple[float, ...] = Field(min_length=1)
    """Nominal midband frequencies, rising."""
    level_db: tuple[float, ...]
    """re 20 µPa, a level for each band."""

    @model_validator(mode="after")
    def _third_octaves(self) -> "BaselineSpectrum":
        for band in self.band_hz:
            exact = power_of_level(float(third_octave_number(np.asarray(band))))
            if not (LOWEST_HZ <= band <= HIGHEST_HZ and abs(band / exact - 1.0) < ROUNDED):
                raise ValueError(
                    f"band_hz = {band:g} Hz: must be the middle of a third octave from "
                    f"{LOWEST_HZ:g} to {HIGHEST_HZ:g} Hz"
                )
        return self


class Baseline(Parameters):
    """Measured sound of the machine without a balancer: what a study's changes are put on."""

    file: str
    spectra: tuple[BaselineSpectrum, ...] = Field(min_length=1)

    @model_validator(mode="after")
    def _alike(self) -> "Baseline":
        for name in {one.microphone for one in self.spectra}:
            if len({one.band_hz for one in self.at(name)}) > 1:
                raise ValueError(f"microphone {name}: has other bands at another speed")
        return self

    def at(self, microphone: str) -> list[BaselineSpectrum]:
        """Spectra at a microphone, by rising speed."""
        here = (one for one in self.spectra if one.microphone == microphone)
        return sorted(here, key=lambda one: one.speed_rpm)


class MeasuredSound(Parameters):
    """What was measured of the machine, in place of what is assumed."""

    baseline: Baseline | None = None
    floor: MeasuredFloor | None = None
    """Mobility under the feet."""
    sound: MeasuredSoundPath | None = None
    """Pressure per force, in place of radiation and room."""
    shell: MeasuredShell | None = None
    """Hammer tests, which weigh the draws."""

    def problems(self, receivers: Sequence[str], speeds: Sequence[float]) -> Iterator[str]:
        """Why it does not fit a study: microphones that it has not, speeds that are not covered."""
        yield from () if self.sound is None else self.sound.problems(receivers)
        spectra = () if self.baseline is None else self.baseline.spectra
        for name in dict.fromkeys(one.microphone for one in spectra):
            covered = [one.speed_rpm for one in spectra if one.microphone == name]
            if name not in receivers:
                yield (
                    f"measured.baseline: microphone {name}: not among the receivers "
                    f"({', '.join(receivers)})"
                )
            for speed in speeds:
                if not min(covered) <= speed <= max(covered):
                    yield (
                        f"measured.baseline: microphone {name}: speed_rpm = {speed:g} rpm "
                        f"lies outside its {min(covered):g} to {max(covered):g} rpm"
                    )


def read_baseline(path: Path) -> tuple[dict[str, object], ...]:
    """Spectra of a table `microphone,speed_rpm,band_hz,level_db`; lines with `#` are comments.

    Raises
    ------
    ParameterError
        The file cannot be read, a column is missing, or a value is no number or there twice.
    """
    try:
        lines = read_text(path, MAXIMUM_BYTES).splitlines()
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "is no text in UTF-8"
        raise ParameterError(f"{path}: cannot be read: {reason}") from None
    numbered = [(n, line) for n, line in enumerate(lines, 1) if line.strip() and line[0] != "#"]
    rows = zip((n for n, _ in numbered), csv.reader(line for _, line in numbered), strict=True)
    _, head = next(rows, (0, []))
    if tuple(name.strip() for name in head) != COLUMNS:
        raise ParameterError(f"{path}: header must be {','.join(COLUMNS)}")
    levels: dict[tuple[str, float], dict[float, float]] = {}
    for number, row in rows:
        try:
            name, speed, band, level = row[0].strip(), *map(float, row[1:])
        except (ValueError, IndexError):
            raise ParameterError(
                f"{path}: line {number}: {','.join(row)!r}: must be {','.join(COLUMNS)}"
            ) from None
        spectrum = levels.setdefault((name, speed), {})
        if band in spectrum:
            raise ParameterError(f"{path}: line {number}: band {band:g} Hz is there twice")
        spectrum[band] = level
    return tuple(
        {
            "microphone": name,
            "speed_rpm": speed,
            "band_hz": tuple(sorted(spectrum)),
            "level_db": tuple(spectrum[band] for band in sorted(spectrum)),
        }
        for (name, speed), spectrum in levels.items()
    )
