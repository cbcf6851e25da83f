"""Sound pressure at the microphones per velocity of the housing."""

from typing import Final

from ..registry import register
from ..vocabulary import Coordinate, Variable

_CHANGES: Final = ("speed", "option", "receiver")

for _thing in (
    Coordinate("receiver", ("receiver",), "", "microphone"),
    Coordinate(
        "distance", ("receiver",), "m", "distance of the microphone from the centre of mass"
    ),
    Coordinate(
        "radiation_method",
        ("receiver",),
        "",
        "method of the sound pressure at the microphone: machine side, room side",
    ),
    Coordinate(
        "radiation_method_reason",
        ("receiver",),
        "",
        "why k-Wave does not compute the microphone or some frequencies; empty where it does",
    ),
    Coordinate("frequency", ("frequency",), "Hz", "frequency"),
    Coordinate("pattern", ("pattern",), "", "surface velocity given by a file"),
    Variable(
        "transfer_vector",
        ("receiver", "dof", "frequency"),
        "Pa s m-1",
        "pressure per velocity of the housing",
        complex_peak=True,
    ),
    Variable(
        "transfer_vector_closed_form",
        ("receiver", "dof", "frequency"),
        "Pa s m-1",
        "pressure per velocity, with the closed-form Green's function",
        complex_peak=True,
    ),
    Variable(
        "transfer_vector_error",
        ("receiver", "dof", "frequency"),
        "Pa s m-1",
        "estimated standard error of the transfer vector from the grids",
    ),
    Variable(
        "pattern_transfer_vector",
        ("receiver", "pattern", "frequency"),
        "Pa s m-1",
        "pressure per unit of a surface velocity given by a file",
        complex_peak=True,
    ),
    Variable(
        "pattern_transfer_vector_error",
        ("receiver", "pattern", "frequency"),
        "Pa s m-1",
        "estimated standard error of the pattern's transfer vector from the grids",
    ),
    Variable(
        "green_difference",
        ("receiver", "frequency"),
        "dB",
        "k-Wave's Green's function against the closed form",
    ),
    Variable(
        "line_difference",
        _CHANGES,
        "dB",
        "1x level with k-Wave's Green's function against the closed form",
    ),
):
    register(_thing)
