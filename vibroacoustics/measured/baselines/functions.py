"""Baselines from spectra of sound pressure: UFF datasets 58 and 58b, and CSV with units."""

import re
from pathlib import Path
from typing import Final

import numpy as np

from ...base.arrays import Array
from ...base.column_head import HEAD_LINES
from ...base.csv_text import read_lines
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
