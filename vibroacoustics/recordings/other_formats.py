"""Formats that cannot be read, and what their program writes that can."""

from typing import Final

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
