"""A share of the oscillating mass moment on the shaft, opposite the crank pin."""

from ..errors import ParameterError
from ..moving_parts import Array, Balancing, circling
from ..parameters.machine import CommonMachine
from ..parameters.options import RotatingCounterweight
from ..parameters.oscillation import Oscillation


def rotating_counterweight(
    option: RotatingCounterweight, machine: CommonMachine, speed_rpm: float, crank_angle: Array
) -> Balancing:
    """Rotating mass moment opposite the crank pin, made by weights in two planes of the shaft.

    A linear oscillation F cos ωt is two counter-rotating forces F/2. One half on the shaft
    cancels the forward one: the peak force halves in every direction (-6 dB). The two planes act
    as one at the height of the oscillating mass, so that the moment halves with the force. The
    option that the thesis missed; for a piston the classical counterweight.
    """
    slider = oscillation(machine)
    planes = slider.planes
    moment = option.share_ratio * slider.mass_kg * slider.amplitude_m
    span = planes.upper_height_m - planes.lower_height_m
    upper_share = (slider.height_m - planes.lower_height_m) / span
    shares = {planes.upper_height_m: upper_share, planes.lower_height_m: 1.0 - upper_share}
    parts = tuple(
        circling(
            "balancer",
            abs(share) * moment / planes.radius_m,
            -planes.radius_m if share > 0.0 else planes.radius_m,
            height,
            crank_angle,
            slider.frame,
        )
        for height, share in shares.items()
    )
    return Balancing(parts, {"added_mass_kg": sum(part.mass_kg for part in parts)})


def oscillation(machine: CommonMachine) -> Oscillation:
    """The mass that slides to and fro in a machine.

    Raises
    ------
    ParameterError
        Nothing does.
    """
    if machine.oscillation is None:
        raise ParameterError(f"machine {machine.name}: has no mass that slides to and fro")
    return machine.oscillation
