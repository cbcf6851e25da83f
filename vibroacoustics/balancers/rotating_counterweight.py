"""A share of the Oldham ring's mass moment on the shaft's counterweights."""

import numpy as np

from ..moving_parts import Array, Balancing, MovingPart, path
from ..parameters.machine import Machine
from ..parameters.options import RotatingCounterweight


def rotating_counterweight(
    option: RotatingCounterweight, machine: Machine, speed_rpm: float, crank_angle: Array
) -> Balancing:
    """Rotating mass moment opposite the crank pin, made by changes of both counterweights.

    A linear oscillation F cos ωt is two counter-rotating forces F/2. One half on the shaft
    cancels the forward one: the peak force halves in every direction (-6 dB). The two planes act
    as one at the height of the ring, so that the moment halves with the force. The option that
    the thesis missed.
    """
    planes = machine.counterweights
    ring = machine.oldham
    moment = option.share_ratio * ring.mass_kg * machine.kinematics.orbit_radius_m
    span = planes.upper_height_m - planes.lower_height_m
    upper_share = (ring.height_m - planes.lower_height_m) / span
    shares = {planes.upper_height_m: upper_share, planes.lower_height_m: 1.0 - upper_share}
    parts = tuple(
        MovingPart(
            "balancer",
            abs(share) * moment / planes.radius_m,
            path(
                -np.copysign(planes.radius_m, share) * np.cos(crank_angle),
                -np.copysign(planes.radius_m, share) * np.sin(crank_angle),
                height,
            ),
        )
        for height, share in shares.items()
    )
    return Balancing(parts, {"added_mass_kg": sum(part.mass_kg for part in parts)})
