"""Curves of a rotor: its whirl frequencies over the speed, and critical speeds."""

from collections.abc import Callable, Iterator
from typing import Final

import numpy as np

from ..base.arrays import Array
from ..base.curves import Curve, CurveAxis
from .beam_rotor import RotorMatrices, whirl_frequencies_hz
from .critical_speed import forward_critical_speeds, rule_of_thumb_rpm, sag_under_weight_m

RPM: Final = 30.0 / np.pi
"""Revolutions per minute of 1 rad/s."""
SPEEDS: Final = 41
CRITICAL_SPEEDS: Final = 2
MODES: Final = 4
"""Two bending modes, each backward and forward."""


def campbell_curve(
    frequencies_hz: Callable[[float], Array],
    highest_rpm: float,
    modes: int,
    source: str,
    lowest_rpm: float = 0.0,
) -> Curve:
    """Natural frequencies over the speed, with the first shaft order.

    Parameters
    ----------
    frequencies_hz : ascending, of a spin in rad/s; as many at each speed, or more
    highest_rpm : end of the range of speeds
    modes : number of the lowest frequencies that are shown
    source : source of the curve
    lowest_rpm : start of the range of speeds
    """
    speeds = np.linspace(lowest_rpm, highest_rpm, SPEEDS)
    rows = [frequencies_hz(float(speed) / RPM) for speed in speeds]
    kept = min(modes, *(row.size for row in rows))
    return Curve(
        "whirl_frequency",
        "Whirl frequencies of the shaft (Campbell map)",
        np.transpose([row[:kept] for row in rows]),
        (
            CurveAxis("whirl_mode", [f"mode {number + 1}" for number in range(kept)]),
            CurveAxis("shaft_speed", speeds, "rpm", "Shaft speed"),
        ),
        "hz",
        source,
        orders=(1.0,),
    )


def critical_speed_curves(rotor: RotorMatrices, source: str) -> Iterator[Curve]:
    """Campbell map of an undamped rotor on its bearings, and its critical speeds.

    Parameters
    ----------
    rotor : on its bearings
    source : source of the rule of thumb
    """
    critical = RPM * forward_critical_speeds(rotor)[:CRITICAL_SPEEDS]
    yield campbell_curve(
        lambda spin: whirl_frequencies_hz(rotor, spin),
        1.2 * float(critical[-1]),
        MODES,
        "Nelson & McVaugh 1976",
    )
    sag_cm = 100.0 * float(np.max(np.abs(sag_under_weight_m(rotor))))
    names = [f"forward whirl {number + 1}" for number in range(critical.size)]
    yield Curve(
        "critical_speed",
        "Critical speeds of the shaft",
        np.append(critical, rule_of_thumb_rpm(sag_cm)),
        (CurveAxis("estimate", [*names, "300/√y, y the sag under its weight"]),),
        "rpm",
        source,
    )
