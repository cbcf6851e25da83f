"""The scroll with mini-crank as the chain takes it: force and moment by source."""

import numpy as np

from ...mechanics.crankshaft import every
from ...mechanics.moving_parts import Revolution
from .cycle import SAMPLES, MiniCrankCycle, steady_minicrank_cycle
from .housing import housing_wrenches
from .parameters import MiniCrankTables
from .pin_forces import crank_pin_force, minicrank_pin_force


def minicrank_revolution(machine: MiniCrankTables, speed_rpm: float, samples: int) -> Revolution:
    """Steady revolution of crankshaft, scroll and mini-cranks under gas and link errors.

    Parameters
    ----------
    machine : masses in kg, lengths in m
    speed_rpm : mean over time
    samples : crank angles of the revolution
    """
    stride = -(-SAMPLES // samples)
    cycle = steady_minicrank_cycle(machine, speed_rpm, samples * stride)
    facts = _facts(cycle)
    if machine.four_bar.minicranks == 1 and not cycle.links.is_parallelogram:
        facts |= _facts_of_rocking(cycle)
    return every(stride, speed_rpm, cycle.rotation, housing_wrenches(machine, cycle), facts)


def _facts(cycle: MiniCrankCycle) -> dict[str, float]:
    rotation = cycle.rotation
    torque = np.sum(list(cycle.input_torque_n_m.values()), axis=0)
    work = 2.0 * np.pi * float(np.mean(rotation.motor_torque_n_m))
    return {
        "speed_fluctuation_percent": 100.0 * rotation.fluctuation_ratio,
        "shaft_power_w": work / rotation.duration_s,
        "largest_input_torque_nm": float(np.max(np.abs(torque))),
        "scroll_swing_deg": float(np.rad2deg(np.ptp(cycle.moved.scroll_angle[0]))),
    }


def _facts_of_rocking(cycle: MiniCrankCycle) -> dict[str, float]:
    """Swing of a mini-crank that does not turn, and the forces that rigid pins would take."""
    given = (cycle.links, cycle.moved, cycle.masses, cycle.load, cycle.rotation)
    forces = {
        "minicrank_pin_force_n": minicrank_pin_force(*given),
        "crank_pin_force_n": crank_pin_force(*given),
    }
    return {
        "minicrank_swing_deg": float(np.rad2deg(np.ptp(cycle.moved.minicrank_angle[0]))),
        **{name: float(np.max(np.hypot(*force))) for name, force in forces.items()},
    }
