"""The slider-link compressor as the chain takes it: force and moment by source."""

from math import gcd, pi
from typing import Final

import numpy as np

from ...base.arrays import Array
from ...base.units import shaft_frequency_hz
from ...mechanics.crankshaft import every
from ...mechanics.moving_parts import Revolution, Wrench
from ...mechanics.rotation import Rotation
from .motion import steady_motion
from .parameters import SliderLinkTables
from .piston import CrankState

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


def unbalance(machine: SliderLinkTables, state: CrankState) -> dict[str, Wrench]:
    """Unbalanced forces and moments about the origin O (25), (26), (36) to (40), paper's frame.

    By source: -Σ m a and -Σ r x m a of piston, slider and crankshaft. The slider's moment about
    the shaft has R², which (39) and (40) print as R. `Wrench.placed` takes them to the block's
    centre of mass (41).

    Parameters
    ----------
    machine : masses in kg, lengths in m
    state : motion of the crank
    """
    masses, mechanism = machine.masses, machine.mechanism
    radius, height = mechanism.crank_radius_m, machine.heights.piston_axis_m
    turning, zero = np.stack([state.along, state.across]), np.zeros_like(state.angle)
    piston = masses.piston_mass_kg * radius * state.along
    slider = masses.slider_mass_kg * radius * turning
    shaft = -masses.crankshaft_mass_kg * masses.crankshaft_mass_offset_m * turning
    couple = masses.crankshaft_product_kg_m2 * turning
    arm = mechanism.link_offset_m - mechanism.piston_mass_offset_m
    slider_spin = -masses.slider_mass_kg * radius**2 * state.acceleration
    shaft_spin = -masses.crankshaft_inertia_kg_m2 * state.acceleration
    return {
        "piston": _wrench((piston, zero, zero), (zero, -height * piston, arm * piston)),
        "slider": _wrench((*slider, zero), (height * slider[1], -height * slider[0], slider_spin)),
        "crankshaft": _wrench((*shaft, zero), (-couple[1], couple[0], shaft_spin)),
    }


def _wrench(force: tuple[Array, ...], moment: tuple[Array, ...]) -> Wrench:
    return Wrench(np.stack(force), np.stack(moment))
