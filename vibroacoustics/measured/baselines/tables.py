"""Baselines from CSV tables, and from spectra of sound pressure in UFF datasets 58 or CSV."""

import re
from pathlib import Path
from typing import Any, Final

import numpy as np

from ...base.arrays import Array
from ...base.column_file import Columns, read_layouts
from ...base.column_head import HEAD_LINES, Layout
from ...base.constants import REFERENCE_PRESSURE_PA
from ...base.csv_text import read_lines
from ...base.decibel import power_of_level
from ...base.errors import ParameterError, StorageError
from ...base.registry import register
from ...recordings.functions import read_functions
from ...recordings.measured_function import MeasuredFunction
from ...study.baseline_files import BaselineContent, BaselineFile, BaselineReader
from ..narrow_spectra import NarrowSpectrum, of_spectra

_HEAD: Final = re.compile(r'\s*"?(frequency|f)\b(?!.*microphone)', re.IGNORECASE)


def holds_functions(path: Path) -> bool:
    """Whether the columns of a CSV file are functions of its first one, the frequency."""
    return any(_HEAD.match(line) for line in read_lines(path).texts[:HEAD_LINES])


def read_spectra(file: BaselineFile) -> BaselineContent:
    """Spectra (phasors) and auto spectra (mean squares) of the file at the stated speed.

    Raises
    ------
    ParameterError
        The file cannot be read, its speed is not stated, or it holds no spectrum of a microphone.
    """
    nodes = {
        microphone.node: name
        for name, microphone in file.settings.microphones.items()
        if microphone.node is not None
    }
    try:
        functions = read_functions(file.path)
    except StorageError as error:
        raise ParameterError(*error.args) from None
    used = [
        function
        for function in functions
        if function.kind in ("spectrum", "auto spectrum")
        and function.response_unit == "Pa"
        and function.response.number in nodes
    ]
    if not used:
        nodes_in_file = ", ".join(map(str, functions))
        raise ParameterError(
            f"{file.path}: holds no spectrum in Pa of a microphone's node: name it, as in "
            f"measured.baseline.microphones.{file.receivers[0]} = {{ node = 1 }}; the file has "
            f"{nodes_in_file}"
        )
    speed = file.stated_speed()
    factor = 0.5 if file.settings.spectra == "peak" else 1.0
    try:
        spectra = [
            NarrowSpectrum(
                nodes[function.response.number],
                speed,
                function.frequency_hz,
                _square(function, factor),
            )
            for function in used
        ]
        return of_spectra(spectra, file.settings.window)
    except ParameterError as error:
        raise ParameterError(f"{file.path}: {error}") from None


def _square(function: MeasuredFunction, factor: float) -> Array:
    """Mean square of each line, Pa²."""
    if function.kind == "auto spectrum":
        return np.asarray(function.values.real)
    return np.asarray(factor * np.abs(function.values) ** 2)


register(BaselineReader("functions", (".uff", ".unv"), read_spectra))


MAXIMUM_BYTES: Final = 50_000_000
LAYOUTS: Final = (
    Layout(("speed_rpm", "band_hz", "level_db"), texts=("microphone",)),
    Layout(
        ("speed_rpm", "order", "level_db"),
        ("phase_rad",),
        texts=("microphone",),
        blank=("phase_rad",),
    ),
    Layout(("speed_rpm", "frequency_hz", "level_db"), texts=("microphone",)),
)

_Groups = dict[tuple[str, float], dict[float, tuple[float, float | None]]]
"""Level and phase by band, order or frequency, by microphone and speed."""


def read(file: BaselineFile) -> BaselineContent:
    """Content of a table, by its columns; a table that begins with a frequency has functions.

    Raises
    ------
    ParameterError
        The file cannot be read, has other columns, or a value is no number or there twice.
    """
    if holds_functions(file.path):
        return read_spectra(file)
    columns = read_layouts(file.path, LAYOUTS, MAXIMUM_BYTES)
    name = next(each for each in ("band_hz", "order", "frequency_hz") if each in columns.numbers)
    groups = _groups(columns, name)
    if name == "band_hz":
        return BaselineContent(
            third_octaves=[_row(key, group, name) for key, group in groups.items()]
        )
    if name == "order":
        return BaselineContent(orders=[_row(key, group, name) for key, group in groups.items()])
    try:
        spectra = [_spectrum(key, group) for key, group in groups.items()]
        return of_spectra(spectra, file.settings.window)
    except ParameterError as error:
        raise ParameterError(f"{file.path}: {error}") from None


def _groups(columns: Columns, name: str) -> _Groups:
    groups: _Groups = {}
    numbers = columns.numbers
    missing = np.full(numbers[name].size, np.nan)
    values = (numbers["speed_rpm"], numbers[name], numbers["level_db"])
    phases = numbers.get("phase_rad", missing)
    rows = zip(columns.texts["microphone"], *values, phases, strict=True)
    for row, (microphone, speed, number, level, phase) in enumerate(rows):
        group = groups.setdefault((microphone, float(speed)), {})
        if number in group:
            what, _, unit = name.partition("_")
            raise columns.refusal(row, f"{what} {number:g}{' Hz' if unit else ''} is there twice")
        group[float(number)] = (float(level), None if np.isnan(phase) else float(phase))
    return groups


def _row(
    key: tuple[str, float], group: dict[float, tuple[float, float | None]], name: str
) -> dict[str, Any]:
    """Values of `BaselineSpectrum` or `BaselineOrders`."""
    rising = sorted(group)
    row: dict[str, Any] = {
        "microphone": key[0],
        "speed_rpm": key[1],
        name: tuple(rising),
        "level_db": tuple(group[number][0] for number in rising),
    }
    return row | ({"phase_rad": tuple(group[a][1] for a in rising)} if name == "order" else {})


def _spectrum(
    key: tuple[str, float], group: dict[float, tuple[float, float | None]]
) -> NarrowSpectrum:
    frequency = np.array(sorted(group))
    level = np.array([group[hertz][0] for hertz in frequency.tolist()])
    square = REFERENCE_PRESSURE_PA**2 * power_of_level(level)
    return NarrowSpectrum(*key, frequency, square)


register(BaselineReader("table", (".csv", ".txt"), read))
