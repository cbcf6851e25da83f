"""Gas and vane impacts of a rolling piston as sources in an elastic shell."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from support import ROOT

import vibroacoustics as va
from vibroacoustics.base.curves import Curve
from vibroacoustics.commands.starter import STUDIES, WITH_SOURCES
from vibroacoustics.machine.frame import BEARING_HOUSING, STATOR
from vibroacoustics.machine.source import Case, Shared
from vibroacoustics.mechanics.added import Added
from vibroacoustics.mechanisms.rolling_piston.cycle import steady_cycle
from vibroacoustics.mechanisms.rolling_piston.machine import RollingPistonMachine
from vibroacoustics.sources.rolling_piston_gas import RollingPistonGas, VaneImpacts, histories_of

SPEED = 3000.0


@cache
def machine() -> RollingPistonMachine:
    machine = va.load_machine(ROOT / "data" / "machines" / "rolling_piston.toml")
    assert isinstance(machine, RollingPistonMachine)
    return machine


def case_of(of: RollingPistonMachine) -> Case:
    return Case(of, Added(), of.revolution(SPEED, 144), None, 1000.0)


def test_torques_on_block_and_stator_are_the_roll_of_the_machine() -> None:
    """What the shell gets of both is the momentum of what turns: rotor and roller."""
    case = case_of(machine())
    loads = RollingPistonGas().loads(case, {})
    total = loads.lines[BEARING_HOUSING][5] + loads.lines[STATOR][5]
    cycle = steady_cycle(machine(), SPEED)
    wrenches = case.revolution.wrenches.values()
    roll = np.sum([each.moment_n_m[2] for each in wrenches], axis=0)
    speed = case.revolution.rotation.speed_rad_per_s
    expected = va.orders.order_spectrum_at_speed(roll, speed, 20)
    assert total[1:6] == pytest.approx(expected[1:6], abs=2e-3 * abs(expected[1]))
    assert loads.shaft_torque_n_m is not None
    mean = np.mean(cycle.rotation.motor_torque_n_m / cycle.rotation.speed_rad_per_s)
    over_time = mean / np.mean(1.0 / cycle.rotation.speed_rad_per_s)
    assert loads.shaft_torque_n_m[0].real == pytest.approx(over_time, rel=1e-9)
    assert not np.any(loads.shaft_torque_n_m[1:])


def test_flow_into_the_shell_is_what_the_cylinder_delivers() -> None:
    loads = RollingPistonGas().loads(case_of(machine()), {})
    (flow,) = [load for port, load in loads.lines.items() if port.name == "discharge_dome"]
    delivered = steady_cycle(machine(), SPEED).gas.delivered_kg * SPEED / 60.0
    density = machine().gas.discharge_density_kg_per_m3
    assert flow[0, 0].real * density == pytest.approx(delivered, rel=1e-3)
    assert abs(flow[0, 1]) > flow[0, 0].real


def test_shared_histories_hold_the_machine_whose_identity_they_are_kept_by() -> None:
    """Else the next machine at the same address would get those of another."""
    case = case_of(machine().model_copy())
    shared = Shared()
    histories = histories_of(replace(case, shared=shared))
    (kept,) = [value for key, value in shared._known.items() if id(case.machine) in key]
    assert kept[0] is case.machine
    assert histories_of(replace(case, shared=shared)) is histories


def test_vane_impacts_are_silent_until_the_tip_leaves() -> None:
    quiet = VaneImpacts().loads(case_of(machine()), {}).lines[BEARING_HOUSING]
    assert not np.any(quiet)
    vane = machine().vane.model_copy(
        update={"spring_force_n": 12.0, "spring_stiffness_n_per_m": 0.0}
    )
    gas = machine().gas.model_copy(update={"discharge_pressure_pa": 1.12e6})
    valve = machine().valve.model_copy(update={"port_diameter_m": 0.014, "lift_m": 0.0034})
    jumping = machine().model_copy(update={"vane": vane, "gas": gas, "valve": valve})
    revolution = jumping.revolution(3600.0, 144)
    loud = VaneImpacts().loads(Case(jumping, Added(), revolution, None, 1000.0), {})
    force = loud.lines[BEARING_HOUSING]
    impulse = jumping.vane.mass_kg * revolution.figures["largest_landing_speed_m_per_s"]
    # an impulse once a turn has lines of 2 I f, alike at all orders
    assert abs(force[0, 1]) == pytest.approx(2.0 * impulse * 60.0, rel=0.1)
    assert np.ptp(np.abs(force[0, 1:])) < 0.1 * abs(force[0, 1])
    assert force[4] == pytest.approx(jumping.cylinder.middle_height_m * force[0])


def test_curves_and_templates() -> None:
    curves = {curve.name: curve for curve in machine().curves(SPEED)}
    assert all(isinstance(curve, Curve) for curve in curves.values())
    total = curves["chamber_volume"].values.sum(axis=0)
    vane = machine().cylinder.vane_thickness_m * machine().cylinder.height_m
    extension = curves["vane_extension"].values
    assert np.ptp(total + vane * extension) < 1e-12
    assert STUDIES["rolling-piston"] == "rolling_piston.toml"
    assert WITH_SOURCES["rolling-piston"] == "rolling_piston_sources.toml"
