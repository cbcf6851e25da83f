"""What the sizes of a slider-link compressor leave of one another's ranges."""

from math import inf
from typing import Any, Final

from ...machine.limits import Limit

THINNEST_RING: Final = 0.999
"""Inner over outer radius of the thrust bearing."""


def _piston_length_m(machine: Any) -> tuple[float, float]:
    """Longer than the cylinder by half the slider, or the link would hit it."""
    sizes = machine.mechanism
    return sizes.cylinder_length_m + 0.5 * sizes.slider_diameter_m, inf


def _inner_radius_m(machine: Any) -> tuple[float, float]:
    return 0.0, THINNEST_RING * machine.bearings.thrust.outer_radius_m


SIZES: Final = (
    Limit("mechanism.piston_length_m", _piston_length_m),
    Limit("bearings.thrust.inner_radius_m", _inner_radius_m),
)
