"""Speed and gas moment at which the keys leave their faces, in closed form.

The scroll's keys share the moment, M_z/(2R) each, and push the ring, m r ω² |cos θ|/2 each. One
of them leaves its face once the second exceeds the first. With the tangential gas force at half
the orbit radius, M_z = F_t r/2, the stroke cancels: m ω² = F_t/(2R).
"""

import numpy as np

from ...base.arrays import Array
from ...mechanics.rotation import uniform_crank_angle
from .parameters import OldhamKeys


def contact_loss_speed_rpm(
    keys: OldhamKeys, ring_mass_kg: float, stroke_m: float, moment_n_m: Array
) -> float:
    """Speed above which a key leaves its face: ω² = min (1 - µ) M_z/(m r R |cos θ|), rpm.

    Friction of the housing's keys, µ M_z/R, adds to the push on the ring just after its reversal.
    Left out: the orbit's change of lever arms, r²/(4 R²) of the speed, and the overshoot when
    friction changes its sign: with µ = 0.1 to 0.15 keys part at a speed lower by 3 %.

    Parameters
    ----------
    keys : their radius and friction
    ring_mass_kg : what moves with the ring along its stroke; a pendulum or a sprung mass may
        multiply it
    stroke_m : r, amplitude
    moment_n_m : M_z over uniform crank angles from zero, shape (samples,), or one value in (1,)

    Returns
    -------
    0 if the moment turns its sign
    """
    if np.min(moment_n_m) <= 0.0:
        return 0.0
    if moment_n_m.size == 1:
        share = 1.0 / moment_n_m
    else:
        share = np.abs(np.cos(uniform_crank_angle(moment_n_m.size))) / moment_n_m
    least_ratio = (1.0 - keys.friction_ratio) / float(np.max(share))
    speed = np.sqrt(least_ratio / (ring_mass_kg * stroke_m * keys.radius_m))
    return float(speed) * 30.0 / np.pi
