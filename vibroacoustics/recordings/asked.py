"""Request for a recording's file, and whether the file can be read at all."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final, TypeVar

from ..base.arrays import Array
from ..base.errors import ParameterError, StorageError, VibroacousticsError
from .child_process import read_in_child
from .reader import readers_by_suffix
from .recorded import MAXIMUM_READING_BYTES, MissingError, TooLargeError, check_rate, listed

_ARTEMIS: Final = "ArtemiS of HEAD acoustics: export UFF, MAT or WAV"
_PULSE: Final = "PULSE or BK Connect of HBK: export UFF, MAT or HDF5"
_LOSSY: Final = "lossy compression changes the signal: record WAV or FLAC"
_TESTLAB: Final = "Simcenter Testlab: export MAT, UFF or WAV"
_DEWESOFT: Final = "Dewesoft: export MF4, UFF, MAT or CSV"
_PICKLE: Final = "Python objects are never loaded: write NetCDF, HDF5, MAT or CSV"

ADVICE: Final = {
    ".hdf": f"{_ARTEMIS}; rename a file of HDF5 to .h5",
    ".pti": _PULSE,
    ".bkc": _PULSE,
    ".rec": _PULSE,
    ".dat": "rename a file of MDF to .mdf; else export MF4, TDMS, UFF, MAT or CSV",
    ".tdm": "save it as .tdms",
    ".tdx": "save it as .tdms",
    **dict.fromkeys((".mp3", ".m4a", ".aac", ".ogg", ".opus", ".wma"), _LOSSY),
    **dict.fromkeys((".aif", ".aiff", ".au", ".caf", ".snd"), "save it as WAV or FLAC"),
    **dict.fromkeys((".lms", ".ldsf", ".lmsproj", ".sdf", ".tl"), _TESTLAB),
    **dict.fromkeys((".dxd", ".dxz", ".d7d", ".d7z"), _DEWESOFT),
    **dict.fromkeys((".pkl", ".pickle", ".npy", ".npz"), _PICKLE),
    **dict.fromkeys((".xls", ".xlsb", ".ods"), "save it as .xlsx or .csv"),
    ".raw": "imc FAMOS: export MF4, TDMS, MAT or CSV",
    ".atfx": "ASAM ODS: export MF4 or UFF",
    ".rpc": "nCode: export UFF, MAT or CSV",
    ".rsp": "nCode: export UFF, MAT or CSV",
    ".sie": "SoMat of HBK: export MF4, MAT or CSV",
    ".cmg": "dBTrait of 01dB: export WAV, UFF or CSV",
    ".oxd": "Oros: export UFF, MAT or WAV",
    ".orsd": "Oros: export UFF, MAT or WAV",
    ".wfm": "oscilloscope: export CSV or MAT",
}
"""Advice on a file, by the suffix of its name."""


def advice(suffix: str) -> str:
    """Return what to do with a file of a format that cannot be read; empty where unknown."""
    words = ADVICE.get(suffix.lower())
    return f" ({words})" if words else ""


Given = TypeVar("Given", str, float)
ALL_CHANNELS: Final = "*"
"""Key in place of a channel's name; a channel that is named goes before it."""


@dataclass(frozen=True)
class Asked:
    """Request for a file: how its channels are to be read, in the user's words.

    Attributes
    ----------
    path : path of the file
    units, calibration, channels, sample_rate_hz, names : see `read_recording`
    """

    path: Path
    units: Mapping[str, str] = field(default_factory=dict)
    calibration: Mapping[str, float] = field(default_factory=dict)
    channels: Sequence[str] | None = None
    sample_rate_hz: float | None = None
    names: Mapping[str, str] = field(default_factory=dict)

    def check(self, may_be_large: bool) -> bool:
        """Refuse a file that cannot be read; see `check_file`. Whether it is above the cap."""
        check_file(self.path, list(readers_by_suffix()), may_be_large)
        if self.sample_rate_hz is not None:
            check_rate(self.sample_rate_hz)
        return self.path.stat().st_size > MAXIMUM_READING_BYTES

    def request(self) -> dict[str, Any]:
        """The request to the process that reads."""
        plugin = readers_by_suffix()[self.path.suffix.lower()].plugin
        return {
            "path": str(self.path),
            "channels": None if self.channels is None else list(self.channels),
            "sample_rate_hz": None if self.sample_rate_hz is None else float(self.sample_rate_hz),
            "plugin": None if plugin is None else str(plugin),
            "units": list(self.units),
        }

    def read(self, part: dict[str, Any]) -> tuple[dict[str, Any], Array]:
        """Header and samples of a part; see `read_in_child`.

        Raises
        ------
        MissingError
            The file lacks its sample rate; the message asks for all else that is missing.
        """
        try:
            return read_in_child(self.request() | part)
        except MissingError as error:
            raise MissingError("; ".join([str(error), *self._further_missing()])) from None

    def _further_missing(self) -> list[str]:
        """Data that a file without a sample rate lacks beside it: units and calibration."""
        provisional = {"sample_rate_hz": 1.0, "samples": [0, 2], "hashed": False}
        try:
            self.chosen_units(read_in_child(self.request() | provisional)[0])
        except MissingError as error:
            return [str(error)]
        except VibroacousticsError:
            pass
        return []

    def new_names(self, header: Mapping[str, Any]) -> list[str]:
        """Name of each channel, from the user or else from the file.

        Raises
        ------
        ParameterError
            A renamed channel is not in the file, or two channels get one name.
        """
        renamed = _of_channels("names", self.names, header["names"])
        names = [renamed.get(name, name) for name in header["names"]]
        twice = sorted({name for name in names if names.count(name) > 1})
        if twice or not all(names):
            raise ParameterError(f"names: {twice[0] if twice else ''!r}: must be unique, not empty")
        return names

    def chosen_units(self, header: Mapping[str, Any]) -> list[str]:
        """Unit of each channel, from the user or else from the file."""
        units = _of_channels("units", self.units, header["names"])
        return _units(header, units, self.chosen_calibration(header))

    def new_calibration(self, header: Mapping[str, Any]) -> dict[str, float]:
        """Factor by the new name of a channel."""
        factors = self.chosen_calibration(header)
        renamed = zip(header["names"], self.new_names(header), strict=True)
        return {new: factors[name] for name, new in renamed if name in factors}

    def chosen_calibration(self, header: Mapping[str, Any]) -> dict[str, float]:
        """Factor by channel, from the user or else from the file, in the file's unit."""
        units = _of_channels("units", self.units, header["names"])
        calibration = _of_channels("calibration", self.calibration, header["names"])
        stated = zip(header["names"], header["units"], header["calibration"], strict=True)
        of_file = {
            name: factor
            for name, unit, factor in stated
            if factor is not None and units.get(name, unit) == unit
        }
        return of_file | calibration


@contextmanager
def naming_file(path: Path) -> Iterator[None]:
    """Put the file before what goes wrong with it."""
    try:
        yield
    except VibroacousticsError as error:
        raise type(error)(f"{path}: {error}") from None


def check_file(path: Path, suffixes: Sequence[str], may_be_large: bool = False) -> None:
    """Refuse a file that is missing, empty, too large, or of another kind.

    Raises
    ------
    ParameterError
        Its name ends otherwise.
    StorageError
        There is no such file, or it is empty or too large.
    """
    if path.suffix.lower() not in suffixes:
        raise ParameterError(
            f"format {path.suffix!r} is unknown{advice(path.suffix)}; known are "
            f"{', '.join(suffixes)}"
        )
    try:
        size = path.stat().st_size
    except FileNotFoundError:
        raise StorageError("no such file") from None
    except (OSError, ValueError) as error:  # ValueError: a name with a null byte
        raise StorageError(f"cannot be read: {error}") from None
    if not path.is_file():
        raise StorageError("is not a file")
    if size == 0:
        raise StorageError("is empty")
    if size > MAXIMUM_READING_BYTES and not may_be_large:
        raise TooLargeError(
            f"has {size / 2**30:.3g} GiB; at most {MAXIMUM_READING_BYTES / 2**30:g} GiB are read "
            "at once: give from_s and to_s, or channels"
        )


def _of_channels(
    option: str, stated: Mapping[str, Given], names: Sequence[str]
) -> dict[str, Given]:
    """Values by channel, that for all of them spread out.

    Raises
    ------
    ParameterError
        A channel is not among the names.
    """
    named = {name: value for name, value in stated.items() if name != ALL_CHANNELS}
    for name in named:
        if name not in names:
            raise ParameterError(f"{option}: no channel {name!r} among {listed(names)}")
    of_all = dict.fromkeys(names, stated[ALL_CHANNELS]) if ALL_CHANNELS in stated else {}
    return of_all | named


def _units(
    header: Mapping[str, Any],
    units: Mapping[str, str],
    calibration: Mapping[str, float],
) -> list[str]:
    """Unit of each channel, from the user or else from the file."""
    names = header["names"]
    missing = _uncalibrated(names, calibration) if header["full_scale"] else []
    missing += [
        f"channel {name!r}: {words}: give it, as in calibration={{{name!r}: 5e-5}}, or 1 where "
        "they are values"
        for name, words in zip(names, header["counts"], strict=True)
        if words and name not in calibration
    ]
    chosen = [units.get(name, stated) for name, stated in zip(names, header["units"], strict=True)]
    unlabelled = [name for name, unit in zip(names, chosen, strict=True) if not unit]
    if unlabelled:
        missing.append(
            f"the file states no unit for {listed(unlabelled)}: give it, as in "
            f"units={{{unlabelled[0]!r}: 'Pa'}}"
        )
    if missing:
        raise MissingError("; ".join(missing))
    return chosen


def _uncalibrated(names: Sequence[str], calibration: Mapping[str, float]) -> list[str]:
    """A line that asks for the calibration of fractions of full scale, where it is missing."""
    missing = [name for name in names if name not in calibration]
    if not missing:
        return []
    return [
        f"samples of {listed(missing)} are fractions of full scale: give the calibration "
        f"factor, unit at full scale, as in calibration={{{missing[0]!r}: 20.0}}"
    ]
