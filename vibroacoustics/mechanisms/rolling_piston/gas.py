"""Gas of a cylinder over a turn: suction at constant pressure, compression, valve, leakage."""

from functools import lru_cache
from math import pi, sqrt
from typing import Final, NamedTuple

import numpy as np

from ...base.arrays import Array
from ...base.errors import SolverError
from ...base.units import shaft_frequency_hz
from .gas_equations import LIFT, MASS, PRESSURE, SPEED, Chamber, chamber_turn, discharge_flow
from .geometry import compression_volume, vane_extension
from .parameters import Cylinder, Leakage, ReedValve, RollingPistonTables, RotaryGas

TURNS: Final = 20
"""Turns after which a reed must repeat."""
REPEATS: Final = 1e-7
"""Change of the lift between turns, over the lift to the stop."""
KEPT_TURNS: Final = 64
"""Options and samples of a speed share a gas."""


class GasTurn(NamedTuple):
    """One turn of a cylinder's gas over uniform angles of its contact from the vane.

    Attributes
    ----------
    compression_pa : p_c, shape (samples,)
    flow_kg_per_s : through the discharge valve, shape (samples,)
    lift_m : of the reed, shape (samples,)
    mass_kg : in the compression chamber with its clearance, shape (samples,)
    delivered_kg : through the valve in a turn, less what flows back until the reed is seated
    leaked_kg : to the suction chamber in a turn, through the gaps
    """

    compression_pa: Array
    flow_kg_per_s: Array
    lift_m: Array
    mass_kg: Array
    delivered_kg: float
    leaked_kg: float


def gas_of(machine: RollingPistonTables, speed_rpm: float, samples: int) -> GasTurn:
    """One turn of the gas in each of the machine's cylinders; see `gas_turn`."""
    tables = machine.cylinder, machine.gas, machine.valve, machine.leakage
    return gas_turn(*tables, speed_rpm, samples)


@lru_cache(KEPT_TURNS)
def gas_turn(
    cylinder: Cylinder,
    gas: RotaryGas,
    valve: ReedValve,
    leakage: Leakage,
    speed_rpm: float,
    samples: int,
) -> GasTurn:
    """Steady turn at constant speed: the compression chamber as one volume of ideal gas.

    The suction chamber is at suction pressure. So is the compression chamber until the contact has
    passed the suction port. At the vane the clearance's gas expands into the suction side.

    Parameters
    ----------
    cylinder, gas, valve, leakage : of the machine
    speed_rpm : mean over time
    samples : uniform angles of the turn

    Raises
    ------
    SolverError
        The reed does not repeat from turn to turn.
    """
    chamber = chamber_of(cylinder, gas, valve, leakage, speed_rpm, samples)
    lift = speed = 0.0
    for _ in range(TURNS):
        states = chamber_turn(lift, speed, chamber)
        change = abs(states[LIFT, -1] - lift)
        lift, speed = float(states[LIFT, -1]), float(states[SPEED, -1])
        if change <= REPEATS * valve.lift_m:
            return _turn(states, chamber)
    raise SolverError(f"discharge reed at {speed_rpm:g} rpm: does not repeat from turn to turn")


def _turn(states: Array, chamber: Chamber) -> GasTurn:
    flow = discharge_flow(states, chamber)
    angle = np.linspace(0.0, 2.0 * pi, chamber.steps + 1)
    since_closing = np.where(angle >= chamber.closes_at, flow, 0.0)
    delivered, compressed = np.trapezoid([flow, since_closing], angle) / chamber.angular_speed
    at_closing = float(np.interp(chamber.closes_at, angle, chamber.volume_m3))
    kept = float(states[MASS, -1])
    return GasTurn(
        states[PRESSURE, :-1],
        flow[:-1],
        states[LIFT, :-1],
        states[MASS, :-1],
        float(delivered),
        float(chamber.suction_density * at_closing - kept - compressed),
    )


def chamber_of(
    cylinder: Cylinder,
    gas: RotaryGas,
    valve: ReedValve,
    leakage: Leakage,
    speed_rpm: float,
    steps: int,
) -> Chamber:
    """Constants and courses of the compression chamber's equations; parameters as of `gas_turn`."""
    angle = np.linspace(0.0, 2.0 * pi, steps + 1, dtype=np.float64)
    volume, slope = compression_volume(cylinder, angle)
    gap = leakage.contact_gap_m * cylinder.height_m
    gap = gap + 2.0 * leakage.vane_end_gap_m * vane_extension(cylinder, angle)[0]
    stiffness = valve.mass_kg * (2.0 * pi * valve.natural_frequency_hz) ** 2
    return Chamber(
        steps,
        2.0 * pi * shaft_frequency_hz(speed_rpm),
        cylinder.suction_end_rad,
        volume + gas.clearance_volume_m3,
        slope,
        leakage.flow_ratio * gap,
        gas.suction_pressure_pa,
        gas.suction_density_kg_per_m3,
        gas.discharge_pressure_pa,
        gas.discharge_density_kg_per_m3,
        gas.exponent_ratio,
        0.25 * pi * valve.port_diameter_m**2,
        valve.flow_ratio * pi * valve.port_diameter_m,
        valve.mass_kg,
        stiffness,
        2.0 * valve.damping_ratio * sqrt(stiffness * valve.mass_kg),
        valve.lift_m,
        valve.seat_stiffness_n_per_m,
        2.0 * valve.seat_damping_ratio * sqrt(valve.seat_stiffness_n_per_m * valve.mass_kg),
    )
