"""Orders of another result beside those of this one."""

from ..registry import register
from ..vocabulary import Coordinate, Variable

for _thing in (
    Coordinate("compared_channel", ("channel",), "", "channel of the other result"),
    Coordinate("compared_speed", ("speed",), "rpm", "speed in the other result"),
    Variable(
        "compared_order",
        ("channel", "speed", "order"),
        "",
        "shaft order in the other result",
        complex_peak=True,
    ),
    Variable(
        "order_difference",
        ("channel", "speed", "order"),
        "dB",
        "level of the order in the other result minus this",
    ),
    Variable(
        "order_phase_difference",
        ("channel", "speed", "order"),
        "rad",
        "phase of the order in the other result minus this",
    ),
):
    register(_thing)

for _short, _dims in (
    ("order", ("channel", "speed", "order")),
    ("equivalent", ("channel", "weighting")),
    ("band", ("channel", "weighting", "band")),
):
    for _name, _words in (
        ("run_deviation", "standard deviation of the level between runs of one specimen"),
        ("specimen_deviation", "standard deviation of the level between specimens"),
        ("mean_uncertainty", "standard uncertainty of the level's mean over runs and specimens"),
    ):
        register(Variable(f"{_short}_{_name}", _dims, "dB", _words))
