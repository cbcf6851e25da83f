"""The hermetic compressor as the chain takes it: force and moment by source."""

from collections.abc import Mapping
from typing import Final

import numpy as np

from ...mechanics.crankshaft import every
from ...mechanics.moving_parts import Revolution
from ...mechanics.rotation import Rotation
from .cycle import cycle_at_speed, mean_speed_rad_per_s, uniform_samples
from .housing import housing_wrenches
from .parameters import HermeticTables
from .periodic_collocation import PeriodicSolution
from .results import bearing_cycles, motion_of, support_reaction, works_per_cycle_j
from .shaft import ShaftEquations

LEAST_STEPS: Final = 144
"""Against 720 steps the first 20 orders of case III err by 0.02 N and 1 mN m."""


def hermetic_revolution(machine: HermeticTables, speed_rpm: float, samples: int) -> Revolution:
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
    facts = {
        "speed_fluctuation_percent": 100.0 * rotation.fluctuation_ratio,
        **_drive_facts(equations, solution),
        **_bearing_facts(equations, solution),
    }
    return every(
        stride,
        speed_rpm,
        rotation,
        {name: wrench.placed(machine.crank_frame) for name, wrench in wrenches.items()},
        facts,
    )


def _drive_facts(equations: ShaftEquations, solution: PeriodicSolution) -> Mapping[str, float]:
    works = works_per_cycle_j(equations, solution)
    forces = motion_of(equations, solution.mesh, solution.states).joints
    supply = equations.machine.motor.synchronous_speed_rad_per_s
    return {
        "shaft_power_w": works["motor"] * mean_speed_rad_per_s(solution) / (2.0 * np.pi),
        "supply_frequency_hz": supply / (2.0 * np.pi),
        "largest_piston_side_force_n": float(np.max(np.abs(forces.wall_on_piston[..., 1]))),
    }


def _bearing_facts(equations: ShaftEquations, solution: PeriodicSolution) -> Mapping[str, float]:
    """Largest load of each bearing, its thinnest film and where, its highest pressure."""
    if equations.machine.case == "I":  # the crank is held, without a film
        held = support_reaction(equations, solution.mesh, solution.states)[..., :2]
        return {"upper_bearing_largest_load_n": float(np.max(np.linalg.norm(held, axis=-1)))}
    facts: dict[str, float] = {}
    cycles = bearing_cycles(equations, solution.states)
    for name, bearing in zip(("upper", "lower"), cycles, strict=False):  # one bearing in case II
        thinnest = int(np.argmin(bearing.thinnest_film_m))
        where = np.rad2deg(solution.mesh[thinnest])
        facts |= {
            f"{name}_bearing_largest_load_n": float(
                np.max(np.linalg.norm(bearing.force_n, axis=-1))
            ),
            f"{name}_bearing_thinnest_film_um": 1e6 * float(bearing.thinnest_film_m[thinnest]),
            f"{name}_bearing_thinnest_film_at_deg": float(where),
            f"{name}_bearing_highest_pressure_mpa": 1e-6 * float(bearing.highest_pressure_pa.max()),
        }
    return facts
