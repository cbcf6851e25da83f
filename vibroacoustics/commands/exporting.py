"""Recordings and functions of frequency written for other tools."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Final

import xarray as xr

from ..base.errors import ParameterError
from ..base.vocabulary import REFERENCE_OPTION
from ..mechanisms.tabulated.csv_layout import forces_csv
from ..recordings import MeasuredFunction, csv_bytes, functions_csv, functions_uff, wav_bytes
from ..results import files, storage

FORMATS: Final[dict[str, Callable[[xr.Dataset], bytes]]] = {".csv": csv_bytes, ".wav": wav_bytes}


def export_recording(recording: xr.Dataset, path: str | Path) -> Path:
    """Write a recording as CSV, WAV or netCDF, whole or not at all; `read_recording` reads it back.

    Parameters
    ----------
    recording : from `read_recording` or `label_recording`
    path : its ending chooses. `.csv`: header `time [s],name [unit],…`, read back bit by bit;
        `.wav`: 64-bit floats that are the SI values, without units or names; `.nc`: the labelled
        form itself

    Returns
    -------
    path of the file

    Raises
    ------
    ParameterError
        The ending is another one, or a WAV file cannot hold the recording.
    StorageError
        The file cannot be written.

    Examples
    --------
    >>> recording = va.label_recording([[0.0, 1.0, 0.0]], 8000.0, ["front"], ["Pa"])
    >>> va.export_recording(recording, "front.wav").name
    'front.wav'
    >>> again = va.read_recording(
    ...     "front.wav", units={"channel 1": "Pa"}, calibration={"channel 1": 1.0})
    >>> again["signal"].values
    array([[0., 1., 0.]])
    """
    suffix = Path(path).suffix.lower()
    if suffix == ".nc":
        return storage.write_results(recording, path)
    if suffix not in FORMATS:
        raise ParameterError(f"{path}: ending {suffix!r}: must be .csv, .nc or .wav")
    try:
        content = FORMATS[suffix](recording)
    except ParameterError as error:
        raise ParameterError(f"{path}: {error}") from None
    return _written(Path(path), content)


def export_functions(
    functions: Sequence[MeasuredFunction],
    path: str | Path,
    *,
    single: bool = False,
    text: bool = False,
) -> Path:
    """Write frequency responses, spectra and coherences; `read_functions` reads them back.

    Parameters
    ----------
    functions : in SI units
    path : its ending chooses. `.uff`, `.unv`: datasets 58b, double precision; `.csv`: a table
        of real and imaginary parts, read back bit by bit
    single : whether a universal file has single precision
    text : whether a universal file is text: datasets 58, readable, of thirteen digits or, single,
        of six

    Returns
    -------
    path of the file

    Raises
    ------
    ParameterError
        The ending is another one, there is nothing to write, or functions of a table differ in
        their frequencies.
    StorageError
        The file cannot be written.

    Examples
    --------
    >>> function = va.MeasuredFunction(
    ...     "frequency response", np.array([50.0, 100.0]), np.array([0.1, 0.2j]),
    ...     va.Node(12, "+z"), va.Node(3, "+z"), "m/s²", "N")
    >>> va.export_functions([function], "hammer.uff").name
    'hammer.uff'
    """
    suffix = Path(path).suffix.lower()
    if suffix not in (".uff", ".unv", ".csv"):
        raise ParameterError(f"{path}: ending {suffix!r}: must be .csv, .uff or .unv")
    if not functions:
        raise ParameterError(f"{path}: no function to write")
    if suffix == ".csv":
        return _written(Path(path), functions_csv(functions))
    return _written(Path(path), functions_uff(functions, single=single, text=text))


def export_forces(results: xr.Dataset, path: str | Path, option: str = REFERENCE_OPTION) -> Path:
    """Write the forces of a run by order as CSV, as a machine of `kind = "table"` reads them.

    Remarks at the top of the file hold the lines `[shaft_axes]` that the machine file needs.

    Parameters
    ----------
    results : results of `run`
    path : ends in `.csv`
    option : whose forces, by name

    Returns
    -------
    path of the file

    Raises
    ------
    ParameterError
        The ending is another one, or the results have no such option.
    StorageError
        The file cannot be written.

    Examples
    --------
    >>> va.export_forces(va.open_results("results.nc"), "forces.csv").name
    'forces.csv'
    """
    if Path(path).suffix.lower() != ".csv":
        raise ParameterError(f"{path}: must end in .csv")
    if option not in results["option"].values:
        listed = ", ".join(map(str, results["option"].values))
        raise ParameterError(f"option = {option}: unknown; the results have {listed}")
    return _written(Path(path), forces_csv(results, option))


def _written(file: Path, content: bytes) -> Path:
    """Write a file, whole or not at all."""
    files.write_together(file.parent, {file.name: content})
    return file
