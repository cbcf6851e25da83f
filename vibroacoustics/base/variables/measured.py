"""What measurements alone predict of a change of mounts, masses or absorbers."""

from ..registry import register
from ..vocabulary import Coordinate, Variable

_LINES = ("option", "receiver", "frequency")
_TOTALS = ("option", "receiver", "weighting")

for _thing in (
    Coordinate(
        "tried_truncation", ("tried_truncation",), "1", "share below which singular values go"
    ),
    Variable(
        "predicted_pressure",
        _LINES,
        "Pa",
        "sound pressure after a change, of measurements alone",
        complex_peak=True,
    ),
    Variable("predicted_level", _LINES, "dB", "level of a line after a change"),
    Variable("predicted_level_low", _LINES, "dB", "lower limit of its 90 % band"),
    Variable("predicted_level_high", _LINES, "dB", "upper limit of its 90 % band"),
    Variable("predicted_total_level", _TOTALS, "dB", "level of all lines after a change"),
    Variable("predicted_total_level_low", _TOTALS, "dB", "lower limit of its 90 % band"),
    Variable("predicted_total_level_high", _TOTALS, "dB", "upper limit of its 90 % band"),
    Variable("predicted_total_change", _TOTALS, "dB", "level of all lines less that as measured"),
    Variable("predicted_total_change_low", _TOTALS, "dB", "lower limit of its 90 % band"),
    Variable("predicted_total_change_high", _TOTALS, "dB", "upper limit of its 90 % band"),
    Variable("truncation", ("option",), "1", "share of the largest below which values go"),
    Variable(
        "truncation_error",
        ("option", "tried_truncation"),
        "dB",
        "mean error of a line's level that measurements drawn again have with a truncation",
    ),
):
    register(_thing)
