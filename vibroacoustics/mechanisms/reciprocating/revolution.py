"""The reciprocating compressor as the chain takes it: force and moment by source."""

import numpy as np

from ...mechanics.crankshaft import every, planar
from ...mechanics.moving_parts import Revolution, Wrench
from .cycle import SAMPLES, Cycle, steady_cycle
from .parameters import ReciprocatingTables
from .slider_crank import housing_wrenches


def reciprocating_revolution(
    machine: ReciprocatingTables, speed_rpm: float, samples: int
) -> Revolution:
    """Steady revolution of piston, connecting rod and crankshaft under gas and friction.

    Parameters
    ----------
    machine : masses in kg, lengths in m, pressures in Pa
    speed_rpm : mean over time
    samples : crank angles of the revolution
    """
    stride = -(-SAMPLES // samples)
    bore = machine.piston_and_rod.bore_m
    cycle = steady_cycle(machine, bore, speed_rpm, samples * stride)
    return every(
        stride,
        speed_rpm,
        cycle.rotation,
        housing_wrenches_of(machine, cycle),
        {
            "speed_fluctuation_percent": 100.0 * cycle.rotation.fluctuation_ratio,
            "mechanical_efficiency_percent": 100.0 * cycle.mechanical_efficiency,
            "shaft_power_w": cycle.supplied_work_j / cycle.rotation.duration_s,
        },
    )


def housing_wrenches_of(machine: ReciprocatingTables, cycle: Cycle) -> dict[str, Wrench]:
    """Pistons, rods and crankshaft on the housing, about its centre of mass, by source.

    The crankshaft is balanced but for its counterweights.
    """
    shaft = machine.crank_frame
    totals: dict[str, Wrench] = {}
    for charge in cycle.charges:
        frame = charge.cylinder.frame(shaft)
        for name, wrench in housing_wrenches(
            cycle.crank, charge.kinematics, cycle.rotation
        ).items():
            totals[name] = _sum(totals.get(name), wrench.placed(frame))
    spin = -machine.crankshaft.inertia_kg_m2 * cycle.rotation.acceleration_rad_per_s2
    turning = planar(np.zeros((2, spin.size)), spin)
    weights = machine.banks.counterweight_wrench(cycle.rotation)
    return {**totals, "crankshaft": _sum(turning, weights).placed(shaft)}


def _sum(first: Wrench | None, second: Wrench) -> Wrench:
    if first is None:
        return second
    return Wrench(first.force_n + second.force_n, first.moment_n_m + second.moment_n_m)
