"""The hermetic compressor as the chain takes it: force and moment by source."""

from collections.abc import Mapping

import numpy as np

from ...moving_parts import Array, MachineMotion
from ...parameters.hermetic import HermeticCompressor
from ...rotation import Rotation
from ..crankshaft import every
from .cycle import cycle_at_speed, uniform_samples
from .housing import housing_wrenches
from .results import bearing_cycles, motion_of, support_reaction
from .shaft import ShaftEquations

LEAST_STEPS = 180
"""Against 720 steps the journal's orbit errs by 1.3e-5 of the clearance."""


def hermetic_revolution(
    machine: HermeticCompressor, speed_rpm: float, samples: int
) -> MachineMotion:
    """Steady revolution of piston, rod, crank and rotor under gas and oil films.

    Parameters
    ----------
    machine : masses in kg, lengths in m, pressures in Pa
    speed_rpm : mean over time
    samples : crank angles of the revolution
    """
    stride = -(-LEAST_STEPS // samples)
    equations, solution = cycle_at_speed(machine, speed_rpm, samples * stride)
    angle, states = uniform_samples(solution, samples * stride)
    rotation = Rotation(states[:, -1], equations.accelerations(angle, states)[:, -1])
    wrenches = housing_wrenches(equations, angle, states)
    return every(
        stride,
        rotation,
        {name: own.placed(machine.crank_frame) for name, own in wrenches.items()},
        {
            **_drive_facts(equations, rotation, angle, states),
            **_bearing_facts(equations, angle, states),
        },
    )


def _drive_facts(
    equations: ShaftEquations, rotation: Rotation, angle: Array, states: Array
) -> Mapping[str, float]:
    speed = rotation.speed_rad_per_s
    torque = equations.motor_torque(speed)
    side = motion_of(equations, angle, states).joints.wall_on_piston[..., 1]
    supply = equations.machine.motor.synchronous_speed_rad_per_s
    return {
        "speed_fluctuation_percent": 100.0 * rotation.fluctuation_ratio,
        "shaft_power_w": 2.0 * np.pi * float(np.mean(torque)) / rotation.duration_s,
        "supply_frequency_hz": supply / (2.0 * np.pi),
        "largest_piston_side_force_n": float(np.max(np.abs(side))),
    }


def _bearing_facts(equations: ShaftEquations, angle: Array, states: Array) -> Mapping[str, float]:
    """Largest load of each bearing, its thinnest film and where, its highest pressure."""
    facts: dict[str, float] = {}
    if not equations.shaft.bearing_freedoms:
        held = support_reaction(equations, angle, states)[..., :2]
        return {"upper_bearing_largest_load_n": float(np.max(np.linalg.norm(held, axis=-1)))}
    for name, own in zip(("upper", "lower"), bearing_cycles(equations, states), strict=False):
        thinnest = int(np.argmin(own.thinnest_film_m))
        facts |= {
            f"{name}_bearing_largest_load_n": float(np.max(np.linalg.norm(own.force_n, axis=-1))),
            f"{name}_bearing_thinnest_film_um": 1e6 * float(own.thinnest_film_m[thinnest]),
            f"{name}_bearing_thinnest_film_at_deg": float(np.rad2deg(angle[thinnest])),
            f"{name}_bearing_highest_pressure_mpa": 1e-6 * float(own.highest_pressure_pa.max()),
        }
    return facts
