"""Readings as text, `4.2@35`: amplitude at an angle in degrees."""

import re
from typing import Final, Literal, NamedTuple

import numpy as np

from ...base.errors import ParameterError
from ...base.unit_spelling import plain_unit

Amplitudes = Literal["peak", "peak to peak", "rms"]
PEAK_FACTORS: Final[dict[Amplitudes, float]] = {
    "peak": 1.0,
    "peak to peak": 0.5,
    "rms": float(np.sqrt(2.0)),
}
"""Peak of a reading of one, by the kind of amplitudes."""
_LARGEST: Final = 1e12
_SPELLINGS: Final[dict[str, Amplitudes]] = {
    "peak": "peak", "pk": "peak", "0-p": "peak", "peak to peak": "peak to peak",
    "pp": "peak to peak", "p-p": "peak to peak", "rms": "rms",
}  # fmt: skip
_NUMBER: Final = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?"
_READING: Final = re.compile(rf"\s*({_NUMBER})\s*(.*?)\s*@\s*({_NUMBER})\s*°?\s*", re.IGNORECASE)
_KIND: Final = re.compile(rf"(.*?)\s*\b({'|'.join(_SPELLINGS)})", re.IGNORECASE)


class Reading(NamedTuple):
    """Reading with the words that are written in it.

    Attributes
    ----------
    value : complex amplitude, its angle as written
    unit : unit in it, empty for none
    amplitudes : kind of amplitudes in it; none where it is not written
    """

    value: complex
    unit: str = ""
    amplitudes: Amplitudes | None = None


def parsed(text: str) -> Reading:
    """Read `4.2@35`, or with its unit and kind `4.2 mm/s rms @ 35`.

    Raises
    ------
    ParameterError
        It is no amplitude at an angle, or the amplitude is below zero.
    """
    parts = _READING.fullmatch(text)
    is_cut = parts is not None and parts[2][:1] in (",", ".")  # a decimal comma
    if (
        parts is None
        or is_cut
        or not 0.0 <= float(parts[1]) <= _LARGEST
        or abs(float(parts[3])) > _LARGEST
    ):
        raise ParameterError(
            "must be an amplitude from 0 to 1e12 at an angle in degrees, such as 4.2@35"
        )
    value = complex(float(parts[1]) * np.exp(1j * np.deg2rad(float(parts[3]))))
    kind = _KIND.fullmatch(parts[2])
    if kind is None:
        return Reading(value, parts[2])
    return Reading(value, kind[1], _SPELLINGS[kind[2].lower()])


def check_words(reading: Reading, unit: str, amplitudes: Amplitudes) -> None:
    """Refuse a reading in another unit or of another kind than stated.

    Raises
    ------
    ParameterError
        It is; the message gives the wanted ones.
    """
    if reading.unit and plain_unit(reading.unit) != plain_unit(unit):
        raise ParameterError(f"is in {reading.unit}, the sensor in {unit}: must be in {unit}")
    if reading.amplitudes not in (None, amplitudes):
        raise ParameterError(
            f"is {reading.amplitudes}, the amplitudes of the file are {amplitudes}: must be "
            f"{amplitudes}"
        )
