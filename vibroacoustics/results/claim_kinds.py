"""Kinds of claims that headlines of commands state, with the conditions of each."""

from typing import Final

from .conditional import ClaimKind, Condition

_BANDS_TO_10_KHZ: Final = ("bands", "bands to 10 kHz")
_EVERY_POSITION: Final = "background at each microphone"

GRADE: Final = ClaimKind(
    "grade",
    ("sound-power",),
    (
        Condition("background", "background", "no value"),
        Condition("room", "K2", "no value"),
        Condition("microphones", "10 or 20 microphones (hemisphere), 9 (box)", "no value"),
        Condition("background positions", _EVERY_POSITION, "no value"),
        Condition("sound", "sound at every microphone", "no value"),
        Condition(*_BANDS_TO_10_KHZ, "no value"),
        Condition("margin", "6 dB (grade 2), 3 dB (grade 3) over the background", "lower value"),
        Condition("K2A", "at most 4 dB (grade 2), 7 dB (grade 3)", "lower value"),
    ),
    "ISO 3744, ISO 3746",
)
POWER_LEVEL: Final = ClaimKind(
    "sound power level",
    ("sound-power",),
    (
        Condition("background", "background", "at most", "K1 is 0"),
        Condition("room", "K2", "at most", "K2 is 0"),
        Condition("margin", "6 dB over the background", "at most", "{given} over the background"),
        Condition("sound", "sound at every microphone", "at least", "no {needed}"),
        Condition(*_BANDS_TO_10_KHZ, "at least", "bands above {given} are missing"),
    ),
    "ISO 3744",
)

_STEADY: Final = Condition("steady level", "range of 4 dB", "remark", "its level varies by {given}")
_LOUD: Final = Condition(
    "third octaves below 300 Hz", "third octaves of 120 dB at most", "no value"
)
_TO_12_KHZ: Final = Condition(
    "bands", "bands to 12.5 kHz", "at least", "bands above {given} are missing"
)
LOUDNESS: Final = ClaimKind("loudness", ("tones",), (_TO_12_KHZ, _LOUD, _STEADY), "ISO 532-1")
SHARPNESS: Final = ClaimKind(
    "sharpness",
    ("tones",),
    (
        _TO_12_KHZ,
        Condition("sound below the missing bands", "bands to 12.5 kHz", "no value"),
        Condition("audible sound", "0.1 sone", "no value"),
        _LOUD,
        _STEADY,
    ),
    "DIN 45692",
)
ADJUSTMENT: Final = ClaimKind(
    "tonal adjustment",
    ("tones",),
    (
        Condition("range", "tones to 11.22 kHz", "at least", "tones above {given} are not rated"),
        Condition("spectra", "12 spectra of 3 s", "remark", "{given} of {needed}"),
        Condition("steady lines", "lines of constant frequency", "remark", "its lines {given}"),
    ),
    "ISO/PAS 20065, ISO 1996-2",
)
