"""Sounds of a run written to files, all at one gain."""

from collections.abc import Iterator, Sequence
from itertools import product
from pathlib import Path
from typing import NamedTuple

import xarray as xr

from ..base.arrays import Array
from ..base.errors import ParameterError
from ..report.file_names import file_name
from ..results import files
from ..sound.files import FORMATS, at_gain, calibration_tone
from ..sound.gain import full_scale_of
from ..sound.ingredients import ingredients
from ..sound.rendering import SAMPLE_RATE_HZ, rendered, whole_revolutions

_LARGEST_PA = 1e5


class _Sound(NamedTuple):
    """What a file holds."""

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
    results : of a run
    folder : of the files; it is made where it is missing
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
