"""Sound power from recorded microphones (ISO 3744), in third octaves from 100 Hz to 10 kHz."""

from ..registry import register
from ..vocabulary import Variable

_BAND = ("band",)

for _thing in (
    Variable(
        "position_level", ("channel", "band"), "dB", "equivalent level at a position; no weighting"
    ),
    Variable("mean_position_level", _BAND, "dB", "energy mean of the levels at all positions"),
    Variable(
        "background_margin",
        _BAND,
        "dB",
        "mean level above that of the background; empty where none was recorded",
    ),
    Variable("background_correction", _BAND, "dB", "K1; 0 where no background was recorded"),
    Variable("environment_correction", _BAND, "dB", "K2; 0 without reflections from a room"),
    Variable("measured_power_level", _BAND, "dB", "sound power level re 1 pW; no weighting"),
    Variable("measured_power_level_a", (), "dB", "A-weighted sound power level re 1 pW"),
    Variable("background_margin_a", (), "dB", "background_margin of the A-weighted sums"),
    Variable("background_correction_a", (), "dB", "K1A, K1 of the A-weighted sums"),
    Variable("environment_correction_a", (), "dB", "K2A, K2 of the A-weighted sums"),
):
    register(_thing)
