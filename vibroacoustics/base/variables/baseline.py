"""What was measured of the machine's sound, and what options make of it."""

from typing import Final

from ..registry import register
from ..vocabulary import Coordinate, Variable

_OPTIONS: Final = ("speed", "option", "receiver")

for _thing in (
    Coordinate(
        "baseline_band",
        ("baseline_band",),
        "Hz",
        "nominal midband frequency of a third of an octave of the measured baseline",
    ),
    Coordinate("baseline_order", ("baseline_order",), "1", "shaft order of the measured baseline"),
    Variable(
        "baseline_share",
        ("speed", "receiver", "baseline_band"),
        "1",
        "modelled over measured mean square without an option and without the orders that were "
        "measured; empty where none is measured",
    ),
    Variable(
        "baseline_band_level",
        (*_OPTIONS, "baseline_band"),
        "dB",
        "unweighted level measured, less what is modelled without and plus what is with the option",
    ),
    Variable(
        "baseline_order_level",
        (*_OPTIONS, "baseline_order"),
        "dB",
        "unweighted level of an order measured, less the modelled one without and plus that with "
        "the option",
    ),
    Variable(
        "baseline_order_share",
        ("speed", "receiver", "baseline_order"),
        "1",
        "modelled over measured mean square of an order without an option",
    ),
    Variable(
        "baseline_order_pressure",
        ("speed", "receiver", "baseline_order"),
        "Pa",
        "pressure of an order measured, with phase 0 where its phase is not known; 0 where none is "
        "measured",
        complex_peak=True,
    ),
    Variable(
        "baseline_order_phase",
        ("speed", "receiver", "baseline_order"),
        "1",
        "1 where an order is changed as a complex peak, 0 where its phase is not known",
    ),
):
    register(_thing)
