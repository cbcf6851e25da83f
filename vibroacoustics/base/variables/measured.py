"""What measurements alone tell: changes of mounts, masses or absorbers, and blocked forces."""

from ..registry import register
from ..vocabulary import Coordinate, Variable

_LINES = ("option", "receiver", "frequency")
_TOTALS = ("option", "receiver", "weighting")
_FORCES = ("force_point", "frequency")
_VALIDATION = ("validation_point", "frequency")
_BANDS = ("validation_point", "band")

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
    Coordinate("force_point", ("force_point",), "", "point at which a source hands its force on"),
    Coordinate("validation_point", ("validation_point",), "", "response that no force is from"),
    Coordinate("validation_quantity", ("validation_point",), "", "what is measured there"),
    Variable("blocked_force", _FORCES, "N", "blocked force of a source", complex_peak=True),
    Variable("blocked_force_low", _FORCES, "N", "lower limit of its amplitude's 90 % band"),
    Variable("blocked_force_high", _FORCES, "N", "upper limit of its amplitude's 90 % band"),
    Variable(
        "blocked_force_sum",
        ("axis", "frequency"),
        "N",
        "sum of the blocked forces",
        complex_peak=True,
    ),
    Variable(
        "blocked_moment_sum",
        ("axis", "frequency"),
        "N m",
        "moment of the blocked forces about the centre of mass",
        complex_peak=True,
    ),
    Variable("condition_number", ("frequency",), "1", "largest over smallest singular value"),
    Variable("inversion_truncation", (), "1", "share of the largest below which values go"),
    Variable(
        "left_out_error",
        ("tried_truncation",),
        "dB",
        "mean error of a response that the forces from all others make",
    ),
    Variable("validation_measured", _VALIDATION, "dB", "level of a line as measured"),
    Variable("validation_predicted", _VALIDATION, "dB", "level of a line by the blocked forces"),
    Variable("validation_predicted_low", _VALIDATION, "dB", "lower limit of its 90 % band"),
    Variable("validation_predicted_high", _VALIDATION, "dB", "upper limit of its 90 % band"),
    Variable("validation_difference", _VALIDATION, "dB", "predicted less measured level of a line"),
    Variable("validation_band_measured", _BANDS, "dB", "level of a third octave as measured"),
    Variable("validation_band_predicted", _BANDS, "dB", "level of it by the blocked forces"),
    Variable("validation_band_difference", _BANDS, "dB", "predicted less measured level of it"),
    Variable("validation_band_difference_low", _BANDS, "dB", "lower limit of its 90 % band"),
    Variable("validation_band_difference_high", _BANDS, "dB", "upper limit of its 90 % band"),
):
    register(_thing)
