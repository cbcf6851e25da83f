"""Baselines from CSV tables: third octaves, orders or spectra by microphone and speed."""

import csv
from pathlib import Path
from typing import Any, Final

import numpy as np

from ...base.constants import REFERENCE_PRESSURE_PA
from ...base.decibel import power_of_level
from ...base.errors import ParameterError
from ...base.registry import register
from ...base.regular_file import read_text
from ...study.baseline_files import BaselineContent, BaselineFile, BaselineReader
from ..narrow_spectra import NarrowSpectrum, of_spectra
from .functions import read_spectra

MAXIMUM_BYTES: Final = 50_000_000
_START: Final = ("microphone", "speed_rpm")
HEADS: Final = (
    (*_START, "band_hz", "level_db"),
    (*_START, "order", "level_db"),
    (*_START, "order", "level_db", "phase_deg"),
    (*_START, "frequency_hz", "level_db"),
)

_Groups = dict[tuple[str, float], dict[float, tuple[float, float | None]]]
"""Level and phase by band, order or frequency, by microphone and speed."""


def read(file: BaselineFile) -> BaselineContent:
    """Content of a table, by its head line; lines that begin with `#` are comments.

    Raises
    ------
    ParameterError
        The file cannot be read, has another head, or a value is no number or there twice.
    """
    numbered = _lines(file.path)
    head = tuple(name.strip() for name in numbered[0][1].split(",")) if numbered else ()
    if head and head[0].lower().startswith(("frequency [", "f [")):
        return read_spectra(file)
    if head not in HEADS:
        shown = " or ".join(",".join(known) for known in HEADS)
        raise ParameterError(f"{file.path}: header must be {shown}")
    groups = _groups(file.path, numbered[1:], head)
    if head[2] == "band_hz":
        return BaselineContent(third_octaves=[_row(key, at, head) for key, at in groups.items()])
    if head[2] == "order":
        return BaselineContent(orders=[_row(key, at, head) for key, at in groups.items()])
    try:
        spectra = [_spectrum(key, at) for key, at in groups.items()]
        return of_spectra(spectra, file.settings.window)
    except ParameterError as error:
        raise ParameterError(f"{file.path}: {error}") from None


def _lines(path: Path) -> list[tuple[int, str]]:
    """Lines that are no comments, with their numbers."""
    try:
        lines = read_text(path, MAXIMUM_BYTES).splitlines()
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "is no text in UTF-8"
        raise ParameterError(f"{path}: cannot be read: {reason}") from None
    return [(n, line) for n, line in enumerate(lines, 1) if line.strip() and line[0] != "#"]


def _groups(path: Path, numbered: list[tuple[int, str]], head: tuple[str, ...]) -> _Groups:
    groups: _Groups = {}
    rows = csv.reader(line for _, line in numbered)
    for (number, line), row in zip(numbered, rows, strict=True):
        try:
            if len(row) != len(head):
                raise ValueError
            name, (speed, at, level) = row[0].strip(), map(float, row[1:4])
            phase = float(np.deg2rad(float(row[4]))) if len(row) > 4 and row[4].strip() else None
        except ValueError:
            raise ParameterError(
                f"{path}: line {number}: {line!r}: must be {','.join(head)}"
            ) from None
        group = groups.setdefault((name, speed), {})
        if at in group:
            what = head[2].split("_")[0]
            unit = " Hz" if head[2].endswith("_hz") else ""
            raise ParameterError(f"{path}: line {number}: {what} {at:g}{unit} is there twice")
        group[at] = (level, phase)
    return groups


def _row(
    key: tuple[str, float], group: dict[float, tuple[float, float | None]], head: tuple[str, ...]
) -> dict[str, Any]:
    """Values of `BaselineSpectrum` or `BaselineOrders`."""
    rising = sorted(group)
    row: dict[str, Any] = {
        "microphone": key[0],
        "speed_rpm": key[1],
        head[2]: tuple(rising),
        "level_db": tuple(group[at][0] for at in rising),
    }
    return row | ({"phase_rad": tuple(group[a][1] for a in rising)} if head[2] == "order" else {})


def _spectrum(
    key: tuple[str, float], group: dict[float, tuple[float, float | None]]
) -> NarrowSpectrum:
    frequency = np.array(sorted(group))
    level = np.array([group[at][0] for at in frequency.tolist()])
    square = REFERENCE_PRESSURE_PA**2 * power_of_level(level)
    return NarrowSpectrum(*key, frequency, square)


register(BaselineReader("table", (".csv", ".txt"), read))
