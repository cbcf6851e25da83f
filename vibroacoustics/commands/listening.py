"""Sounds of a run, and impulse responses of a room, all at one gain."""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace
from itertools import product
from pathlib import Path
from typing import Final, NamedTuple

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.errors import ParameterError
from ..report.analysis import Analysis
from ..report.file_names import file_name
from ..report.radiation_tables import analysis_of_impulse_responses
from ..results import files
from ..sound.files import (
    FORMATS,
    at_gain,
    calibration_tone,
    full_scale_of,
    next_full_scale,
    wav_bytes,
)
from ..sound.ingredients import ingredients
from ..sound.rendering import SAMPLE_RATE_HZ, rendered, whole_revolutions

_LARGEST_PA = 1e5
UNITS: Final = {"t": "Pa/(m/s²)", "r": "Pa/(rad/s²)"}
"""Units of responses to translations and to rotations."""


class _Sound(NamedTuple):
    """Sound of a file."""

    name: str
    pressure_pa: Array


def listen(
    results: xr.Dataset,
    folder: str | Path,
    options: Sequence[str] | None = None,
    microphones: Sequence[str] | None = None,
    speeds: Sequence[float] | None = None,
    *,
    duration_s: float = 10.0,
    full_scale_pa: float | None = None,
    calibration_db: float | None = None,
    file_format: str = "wav",
) -> list[Path]:
    """Write the sound of options at microphones and listeners, at one gain, which the names state.

    Parameters
    ----------
    results : results of a run
    folder : folder of the files; it is made where it is missing
    options, microphones, speeds : all options, the first microphone and the first speed where
        nothing is given; rpm. Listeners in a room are asked for as microphones
    duration_s : 1 to 600 s; rounded to whole revolutions
    full_scale_pa : pressure at full scale; none for one that all sounds of the results fit in
    calibration_db : level of a tone of 1 kHz, a file of its own; none for none
    file_format : `wav`, of 32-bit floats, or `flac`, of 24 bits

    Returns
    -------
    paths of the files, the calibration tone first

    Raises
    ------
    ParameterError
        A name is unknown, a value out of its range, or a sound exceeds full scale.
    StorageError
        The folder cannot be written.

    Examples
    --------
    >>> results = va.open_results("results.nc")
    >>> [path.name for path in va.listen(results, "sound", ["none"], duration_s=1.0)]
    ['none_front_1m_2900rpm_1Pa.wav']
    """
    if file_format not in FORMATS:
        raise ParameterError(f"format = {file_format}: must be one of {', '.join(FORMATS)}")
    cases = _cases(results, options, microphones, speeds)
    ingredients(results, *cases[0])  # what is wrong with the results is seen first
    full_scale = full_scale_of(results, calibration_db) if full_scale_pa is None else full_scale_pa
    if not 0.0 < full_scale <= _LARGEST_PA:
        raise ParameterError(f"full scale = {full_scale:g} Pa: must be above 0, up to 100 kPa")
    written = []
    with files.only_writer(Path(folder)) as staged:
        for sound in _sounds(results, cases, duration_s, calibration_db):
            name = f"{sound.name}_{full_scale:g}Pa.{file_format}"
            samples = at_gain(sound.pressure_pa, full_scale)
            files.write(staged, name, FORMATS[file_format](samples, SAMPLE_RATE_HZ, full_scale))
            written.append(Path(folder) / name)
        if len(set(written)) < len(written):
            raise ParameterError("options: two of them have the same name of a file; write one")
        files.replace_all(staged)
    return written


def _cases(
    results: xr.Dataset,
    options: Sequence[str] | None,
    microphones: Sequence[str] | None,
    speeds: Sequence[float] | None,
) -> list[tuple[str, str, float]]:
    chosen = (
        [str(name) for name in results["option"].values] if options is None else options,
        [str(results["receiver"].values[0])] if microphones is None else microphones,
        [float(results["speed"].values[0])] if speeds is None else speeds,
    )
    return list(product(*chosen))


def _sounds(
    results: xr.Dataset,
    cases: Sequence[tuple[str, str, float]],
    duration_s: float,
    calibration_db: float | None,
) -> Iterator[_Sound]:
    if calibration_db is not None:
        samples = whole_revolutions(duration_s, 0.0, SAMPLE_RATE_HZ)
        tone = calibration_tone(calibration_db, samples, SAMPLE_RATE_HZ)
        yield _Sound(f"calibration_1kHz_{calibration_db:g}dB", tone)
    for option, microphone, speed in cases:
        parts = ingredients(results, option, microphone, speed)
        samples = whole_revolutions(duration_s, speed, SAMPLE_RATE_HZ)
        name = f"{file_name(option)}_{file_name(microphone)}_{speed:g}rpm"
        yield _Sound(name, rendered(parts, samples))


def impulse_analysis(
    responses: xr.DataArray, listeners: Sequence[str] | None = None, full_scale: float | None = None
) -> Analysis:
    """Return an analysis with a WAV file for each listener and motion, named by the gain of all.

    Parameters
    ----------
    responses : responses of `impulse_responses`
    listeners : names; all where nothing is given
    full_scale : value at full scale; none for the next of 1, 2, 5, 10, … of all listeners
    """
    room_names = [str(name) for name in responses["listener"].values]
    check_asked(room_names, listeners, full_scale)
    highest = float(np.abs(responses).max())
    scale = next_full_scale(highest) if full_scale is None else full_scale
    names, contents = {}, {}
    for listener, dof in product(listeners or room_names, map(str, responses["dof"].values)):
        sound = at_gain(responses.sel(listener=listener, dof=dof).values, scale)
        name = f"{file_name(listener)}_{dof}_{scale:g}Pa.wav"
        names[listener, dof] = name
        contents[name] = wav_bytes(sound, SAMPLE_RATE_HZ, scale, UNITS[dof[0]])
    return replace(analysis_of_impulse_responses(responses, scale, names), further=contents)


def check_asked(
    names: Collection[str], listeners: Sequence[str] | None, full_scale: float | None
) -> None:
    """Refuse what is known to be wrong before anything is computed.

    Raises
    ------
    ParameterError
        A name is unknown, or the full scale is not above 0.
    """
    for name in listeners or ():
        if name not in names:
            raise ParameterError(
                f"microphone = {name}: unknown in this room; available: {', '.join(names)}"
            )
    if full_scale is not None and not full_scale > 0.0:
        raise ParameterError(f"full scale = {full_scale:g} Pa: must be above 0")
