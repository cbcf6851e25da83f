"""Recordings out, for other tools: CSV and WAV as bytes."""

import io

import numpy as np
import xarray as xr
from scipy.io import wavfile

from ..base import csv_text
from ..base.errors import ParameterError
from .riff import scale_comment, with_comment


def csv_bytes(recording: xr.Dataset) -> bytes:
    """A table with the header `time [s],name [unit],…`; `read_recording` reads it back exactly.

    Names that a spreadsheet would take for formulas begin with an apostrophe there.

    Parameters
    ----------
    recording : result of `read_recording` or `label_recording`
    """
    channels = recording["signal"]
    units = channels["channel_unit"].values
    header = [
        f"{' '.join(str(name).split())} [{unit}]"
        for name, unit in zip(channels["channel"].values, units, strict=True)
    ]
    table = np.vstack([channels["time"].values, channels.values]).T
    return csv_text.csv_bytes(["time [s]", *header], (row.tolist() for row in table))


def wav_bytes(recording: xr.Dataset) -> bytes:
    """A WAV file of 64-bit floats that are the SI values themselves, their units in its comment.

    A WAV file states no channel names: they are `channel 1`, `channel 2` … when it is read.

    Parameters
    ----------
    recording : result of `read_recording` or `label_recording`

    Raises
    ------
    ParameterError
        The sample rate is no whole number of Hz, which a WAV file cannot state, or the recording
        is too long for one.
    """
    rate = float(recording.attrs["sample_rate_hz"])
    if not rate.is_integer():
        raise ParameterError(
            f"sample_rate_hz = {rate!r} Hz: a WAV file states whole Hz only; write CSV or netCDF"
        )
    content = io.BytesIO()
    try:
        wavfile.write(content, int(rate), recording["signal"].values.T)
    except ValueError as error:
        raise ParameterError(f"recording cannot be written as WAV: {error}") from None
    units = map(str, recording["channel_unit"].values)
    return with_comment(content.getvalue(), scale_comment((1.0, unit) for unit in units))
