"""The rolling-piston compressor as the chain takes it: force and moment by source."""

from typing import Final

import numpy as np

from ...base.units import shaft_frequency_hz
from ...mechanics.crankshaft import every
from ...mechanics.moving_parts import Revolution, Wrench, path, wrenches_of_parts
from ...mechanics.rolling_piston import RollingHistories
from .cycle import (
    SAMPLES,
    RollingPistonCycle,
    bearing_forces_n,
    steady_cycle,
    torque_orders_n_m,
    turning_parts,
)
from .geometry import displaced_m3
from .parameters import RollingPistonTables
from .roller import (
    eccentric_drag_n_m_s,
    face_drag_n_m_s,
    journal_drag_n_m_s,
    roller_inertia_kg_m2,
)

CONTROLLED_ORDERS: Final = 3
"""Shaft orders whose residual torque is reported."""


def cycle_for(machine: RollingPistonTables, speed_rpm: float, samples: int) -> RollingPistonCycle:
    """Steady cycle at a multiple of the crank angles wanted; parameters as of `steady_cycle`."""
    stride = -(-SAMPLES // samples)
    return steady_cycle(machine, speed_rpm, samples * (stride + stride * samples % 2))


def cycle_with(machine: RollingPistonTables, speed_rpm: float, samples: int) -> RollingPistonCycle:
    """Steady cycle at no fewer crank angles than wanted, if it can the kept one of `SAMPLES`."""
    return steady_cycle(machine, speed_rpm, max(SAMPLES, samples + samples % 2))


def rolling_piston_revolution(
    machine: RollingPistonTables, speed_rpm: float, samples: int
) -> Revolution:
    """Steady revolution of shaft, rollers and vanes under gas, friction and motor.

    Parameters
    ----------
    machine : masses in kg, lengths in m, pressures in Pa
    speed_rpm : mean over time
    samples : crank angles of the revolution
    """
    cycle = cycle_for(machine, speed_rpm, samples)
    stride = cycle.load_n_m.size // samples
    wrenches = housing_wrenches(machine, cycle)
    return every(stride, speed_rpm, cycle.rotation, wrenches, facts(machine, cycle, speed_rpm))


def housing_wrenches(machine: RollingPistonTables, cycle: RollingPistonCycle) -> dict[str, Wrench]:
    """Change of momentum of all moving parts with the sign of its reaction, by source.

    Parameters
    ----------
    machine : masses in kg, lengths in m
    cycle : cycle of the machine
    """
    rotation = cycle.rotation
    wrenches = wrenches_of_parts(turning_parts(machine, rotation.crank_angle), rotation)
    still = np.zeros_like(cycle.load_n_m)
    spin, vane = still, Wrench(path(still, still, still), path(still, still, still))
    for number, (contact, (_, height)) in enumerate(
        zip(cycle.contacts, machine.cylinder.stations, strict=True)
    ):
        spin = spin + cycle.over_shaft(contact.spin_acceleration, number)
        push = machine.vane.mass_kg * cycle.over_shaft(contact.vane_acceleration, number)
        vane = Wrench(vane.force_n + path(push, still, still),
                      vane.moment_n_m + path(still, height * push, still))  # fmt: skip
    roller = wrenches["roller"]
    turned = path(still, still, -roller_inertia_kg_m2(machine) * spin)
    wrenches["roller"] = Wrench(roller.force_n, roller.moment_n_m + turned)
    roll = -machine.rotary_shaft.inertia_kg_m2 * rotation.acceleration_rad_per_s2
    rotor = Wrench(path(still, still, still), path(still, still, roll))
    return {"rotor": rotor, **wrenches, "vane": vane}


def facts(
    machine: RollingPistonTables, cycle: RollingPistonCycle, speed_rpm: float
) -> dict[str, float]:
    """Figures to report of a steady cycle.

    Parameters
    ----------
    machine : machine of the cycle
    cycle : steady
    speed_rpm : mean over time
    """
    rotation, contact, gas = cycle.rotation, cycle.contacts[0], cycle.gas
    motor, drive = rotation.motor_torque_n_m, machine.drive
    residual = torque_orders_n_m(motor - cycle.load_n_m, CONTROLLED_ORDERS)
    largest = np.max(np.linalg.norm(bearing_forces_n(machine, cycle), axis=1), axis=-1)
    landing = float(np.max(contact.impacts.impulse_n_s, initial=0.0))
    filled = machine.gas.suction_density_kg_per_m3 * displaced_m3(machine.cylinder)
    return {
        "speed_fluctuation_percent": 100.0 * rotation.fluctuation_ratio,
        "shaft_power_w": 2.0 * np.pi * float(np.mean(motor)) * shaft_frequency_hz(speed_rpm),
        "volumetric_efficiency_percent": 100.0 * gas.delivered_kg / filled,
        "leakage_percent": 100.0 * gas.leaked_kg / filled,
        **{f"residual_torque_{n}x_n_m": float(each) for n, each in enumerate(residual, 1)},
        "motor_peak_current_a": float(np.max(motor)) / drive.torque_per_current_nm_per_a,
        "roller_spin_rpm": float(np.mean(contact.spin_rad_per_s)) * 30.0 / np.pi,
        "least_tip_force_n": float(np.min(contact.tip_n)),
        "vane_jump_speed_rpm": contact.jump_speed_rad_per_s * 30.0 / np.pi,
        "largest_landing_speed_m_per_s": landing / machine.vane.mass_kg,
        "main_bearing_largest_load_n": float(largest[0]),
        "sub_bearing_largest_load_n": float(largest[1]),
        "friction_w": friction_w(machine, cycle),
    }


def friction_w(machine: RollingPistonTables, cycle: RollingPistonCycle) -> float:
    """Mean power of all friction: films, tip and slot of the vane, W.

    Parameters
    ----------
    machine : machine of the cycle
    cycle : steady
    """
    speed = cycle.rotation.speed_rad_per_s
    power = journal_drag_n_m_s(machine) * speed**2
    for number, contact in enumerate(cycle.contacts):
        spin = cycle.over_shaft(contact.spin_rad_per_s, number)
        power = power + eccentric_drag_n_m_s(machine) * (speed - spin) ** 2
        power = power + face_drag_n_m_s(machine) * spin**2
        power = power + cycle.over_shaft(contact.rubbing_w, number)
    return float(np.mean(power / speed) / np.mean(1.0 / speed))


def rolling_histories(
    machine: RollingPistonTables, speed_rpm: float, samples: int
) -> RollingHistories:
    """Return the time histories of the rolling pistons over a turn; see `RollingHistories`.

    Parameters
    ----------
    machine : masses in kg, lengths in m, pressures in Pa
    speed_rpm : mean over time
    samples : least number of crank angles
    """
    cycle = cycle_with(machine, speed_rpm, samples)
    rotation, samples = cycle.rotation, cycle.load_n_m.size
    step_s = 2.0 * np.pi / samples / rotation.speed_rad_per_s
    torque = journal_drag_n_m_s(machine) * rotation.speed_rad_per_s
    flow, landing = np.zeros(samples), np.zeros(samples)
    for number, contact in enumerate(cycle.contacts):
        flow += cycle.over_shaft(cycle.gas.flow_kg_per_s, number)
        drag = contact.load_n_m - roller_inertia_kg_m2(machine) * contact.spin_acceleration
        torque = torque + cycle.over_shaft(drag, number)
        force = np.zeros(samples)
        at_sample = np.rint(contact.impacts.angle_rad * samples / (2.0 * np.pi)).astype(int)
        force[at_sample] = contact.impacts.impulse_n_s
        landing += cycle.over_shaft(force, number) / step_s
    # The gas turns at constant speed: its mass per crank angle is kept where the speed varies.
    flow *= rotation.speed_rad_per_s / (2.0 * np.pi * shaft_frequency_hz(speed_rpm))
    return RollingHistories(
        rotation.speed_rad_per_s,
        flow / machine.gas.discharge_density_kg_per_m3,
        torque,
        rotation.motor_torque_n_m,
        -landing,
    )
