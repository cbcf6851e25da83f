"""The reciprocating compressor as the chain takes it: force and moment by source."""

from ...mechanics.crankshaft import every
from ...mechanics.moving_parts import Revolution
from .cycle import SAMPLES, steady_cycle
from .machine import ReciprocatingMachine
from .slider_crank import housing_wrenches


def reciprocating_revolution(
    machine: ReciprocatingMachine, speed_rpm: float, samples: int
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
    wrenches = housing_wrenches(
        cycle.crank, cycle.moved, cycle.rotation, machine.crankshaft.inertia_kg_m2
    )
    return every(
        stride,
        speed_rpm,
        cycle.rotation,
        {name: wrench.placed(machine.crank_frame) for name, wrench in wrenches.items()},
        {
            "speed_fluctuation_percent": 100.0 * cycle.rotation.fluctuation_ratio,
            "mechanical_efficiency_percent": 100.0 * cycle.mechanical_efficiency,
            "shaft_power_w": cycle.supplied_work_j / cycle.rotation.duration_s,
        },
    )
