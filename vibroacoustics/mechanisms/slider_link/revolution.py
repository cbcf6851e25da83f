"""The slider-link compressor as the chain takes it: force and moment by source."""

from math import gcd, pi
from typing import Final

from ...base.units import shaft_frequency_hz
from ...mechanics.crankshaft import every
from ...mechanics.moving_parts import Revolution
from ...mechanics.rotation import Rotation
from .motion import steady_motion
from .parameters import SliderLinkTables
from .unbalance import unbalance

SAMPLES: Final = 360
"""Least number of crank angles at which the cycle is solved; a quarter of them is whole."""

FRICTION: Final = {
    "piston_friction_w": ("piston_film", "cylinder"),
    "link_friction_w": ("link",),
    "journal_friction_w": ("crank_pin", "upper", "lower"),
    "thrust_friction_w": ("thrust",),
}
"""Losses to report, and the works that they are made of."""


def slider_link_revolution(machine: SliderLinkTables, speed_rpm: float, samples: int) -> Revolution:
    """Steady revolution of piston, slider and crankshaft under gas, friction and motor.

    Parameters
    ----------
    machine : masses in kg, lengths in m, pressures in Pa
    speed_rpm : mean over time
    samples : crank angles of the revolution
    """
    multiple = 4 // gcd(samples, 4)  # the contacts change at the quarters of a revolution
    stride = multiple * -(-SAMPLES // (multiple * samples))
    frequency = shaft_frequency_hz(speed_rpm)
    cycle = steady_motion(machine, 2.0 * pi * frequency, samples * stride)
    rotation = Rotation(cycle.state.velocity, cycle.state.acceleration)
    wrenches = {
        name: wrench.placed(machine.crank_frame)
        for name, wrench in unbalance(machine, cycle.state).items()
    }
    power = {name: work * frequency for name, work in cycle.work_j.items()}
    facts = {
        "speed_fluctuation_percent": 100.0 * rotation.fluctuation_ratio,
        "shaft_power_w": power["motor"],
        "mechanical_efficiency_percent": 100.0 * power["gas"] / power["motor"],
        **{name: sum(power[part] for part in parts) for name, parts in FRICTION.items()},
    }
    return every(stride, speed_rpm, rotation, wrenches, facts)
