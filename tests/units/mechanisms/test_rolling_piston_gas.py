"""Gas of a rolling piston with reed and leakage against SciPy's stiff integration."""

from math import pi, sqrt

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support import ROOT

import vibroacoustics as va
from vibroacoustics.mechanisms.rolling_piston.gas import GasTurn, gas_of
from vibroacoustics.mechanisms.rolling_piston.geometry import displaced_m3
from vibroacoustics.mechanisms.rolling_piston.machine import RollingPistonMachine

SAMPLES = 720


def load() -> RollingPistonMachine:
    machine = va.load_machine(ROOT / "data" / "machines" / "rolling_piston.toml")
    assert isinstance(machine, RollingPistonMachine)
    return machine


def changed(table: str, **values: object) -> RollingPistonMachine:
    machine = load()
    return machine.model_copy(update={table: getattr(machine, table).model_copy(update=values)})


def area_and_slope(machine: RollingPistonMachine, angle: float) -> tuple[float, float, float]:
    """Volume of the compression chamber, its slope and the vane's extension, from the circles."""
    cylinder = machine.cylinder
    bore, e, height = cylinder.bore_radius_m, cylinder.eccentricity_m, cylinder.height_m
    radius, half = bore - e, 0.5 * cylinder.vane_thickness_m
    tip = e * np.cos(angle) + sqrt(radius**2 - (e * np.sin(angle)) ** 2)
    x = bore - tip
    # sector of the bore less that of the roller about its own centre, and the triangle between
    lean = np.arcsin(e * np.sin(angle) / radius)
    behind = 0.5 * bore**2 * angle - 0.5 * radius**2 * (angle + lean)
    behind -= 0.5 * e * tip * np.sin(angle)
    total = pi * (bore**2 - radius**2)
    slope = tip * e * np.sin(angle) / sqrt(radius**2 - (e * np.sin(angle)) ** 2)
    volume = height * (total - behind - half * x)
    return volume, -height * (0.5 * (bore**2 - tip**2) + half * slope), x


def nozzle(high: float, low: float, density: float, kappa: float) -> float:
    """Saint-Venant and Wantzel's flow per area, choked below the critical ratio."""
    ratio = max(low / high, (2.0 / (kappa + 1.0)) ** (kappa / (kappa - 1.0)))
    factor = 2.0 * kappa / (kappa - 1.0) * high * density
    difference = ratio ** (2.0 / kappa) - ratio ** ((kappa + 1.0) / kappa)
    return sqrt(max(factor * difference, 0.0))


def by_radau(
    machine: RollingPistonMachine, speed_rpm: float, start: tuple[float, float], method: str
):
    """Pressure, mass, lift and its speed from the closing of the suction port to the vane."""
    gas, valve, leakage = machine.gas, machine.valve, machine.leakage
    omega, kappa = 2.0 * pi * speed_rpm / 60.0, gas.exponent_ratio
    stiffness = valve.mass_kg * (2.0 * pi * valve.natural_frequency_hz) ** 2
    damping = 2.0 * valve.damping_ratio * sqrt(stiffness * valve.mass_kg)
    seat = valve.seat_stiffness_n_per_m
    rub = 2.0 * valve.seat_damping_ratio * sqrt(seat * valve.mass_kg)
    p_d, p_s, rho_s = (
        gas.discharge_pressure_pa, gas.suction_pressure_pa, gas.suction_density_kg_per_m3,
    )  # fmt: skip
    rho_d = rho_s * (p_d / p_s) ** (1.0 / kappa)

    def slope(angle: float, state):
        p, m, y, v = state
        volume, change, x = area_and_slope(machine, angle)
        volume += gas.clearance_volume_m3
        rho = m / volume
        gap = leakage.contact_gap_m * machine.cylinder.height_m + 2.0 * leakage.vane_end_gap_m * x
        leak = leakage.flow_ratio * gap * nozzle(p, p_s, rho, kappa) if p > p_s else 0.0
        open_m2 = valve.flow_ratio * pi * valve.port_diameter_m * min(max(y, 0.0), valve.lift_m)
        out = open_m2 * (nozzle(p, p_d, rho, kappa) if p > p_d else -nozzle(p_d, p, rho_d, kappa))
        carried = p / rho if out > 0.0 else p_d / rho_d
        heat = kappa * (-p * change * omega - p / rho * leak - carried * out) / volume
        push = 0.25 * pi * valve.port_diameter_m**2 * (p - p_d) - stiffness * y - damping * v
        if y < 0.0:
            push += max(-seat * y - rub * v, 0.0)
        if y > valve.lift_m:
            push -= max(seat * (y - valve.lift_m) + rub * v, 0.0)
        return np.array([heat, -leak - out, v, push / valve.mass_kg]) / omega

    first = machine.cylinder.suction_end_rad
    volume = area_and_slope(machine, first)[0] + gas.clearance_volume_m3
    state = [p_s, rho_s * volume, *start]
    times = 2.0 * pi * np.arange(np.ceil(first * SAMPLES / 2.0 / pi), SAMPLES) / SAMPLES
    return solve_ivp(slope, (first, times[-1]), state, method, times, rtol=1e-7,
                     atol=[1.0, 1e-12, 1e-10, 1e-7], max_step=0.02)  # fmt: skip


@pytest.mark.parametrize(("speed_rpm", "method"), [(3000.0, "Radau"), (5400.0, "LSODA")])
def test_valve_and_leakage_against_a_stiff_integration(speed_rpm: float, method: str) -> None:
    machine = load()
    turn = gas_of(machine, speed_rpm, SAMPLES)
    first = int(np.ceil(machine.cylinder.suction_end_rad * SAMPLES / (2.0 * pi)))
    # the reed is at rest on its seat, which it dents, where the suction port closes
    assert -0.02 * machine.valve.lift_m < turn.lift_m[first] < 0.0
    solved = by_radau(machine, speed_rpm, (float(turn.lift_m[first]), 0.0), method)
    assert solved.success
    pressure, mass, lift, _ = solved.y
    assert np.max(np.abs(turn.compression_pa[first:] / pressure - 1.0)) < 1e-3
    assert np.max(np.abs(turn.mass_kg[first:] - mass)) < 1e-3 * mass[0]
    assert np.max(np.abs(turn.lift_m[first:] - lift)) < 1e-3 * machine.valve.lift_m
    moment = pressure * np.array([area_and_slope(machine, angle)[1] for angle in solved.t])
    ours = turn.compression_pa[first:] * moment / pressure
    assert np.mean(ours) == pytest.approx(np.mean(moment), rel=1e-3)


def test_closed_chamber_is_isentropic() -> None:
    machine = changed("leakage", contact_gap_m=0.0, vane_end_gap_m=0.0)
    turn, gas = gas_of(machine, 3000.0, SAMPLES), machine.gas
    angle = 2.0 * pi * np.arange(SAMPLES) / SAMPLES
    closed = (angle > machine.cylinder.suction_end_rad) & (turn.compression_pa < 2.4e6)
    closed &= angle < pi
    volume = [area_and_slope(machine, to)[0] + gas.clearance_volume_m3 for to in angle[closed]]
    density = turn.mass_kg[closed] / np.array(volume)
    expected = gas.suction_pressure_pa * (density / gas.suction_density_kg_per_m3) ** (
        gas.exponent_ratio
    )
    assert turn.compression_pa[closed] == pytest.approx(expected, rel=1e-9)
    assert np.ptp(turn.mass_kg[closed]) < 1e-12 * turn.mass_kg[0]


def volumetric(turn: GasTurn, machine: RollingPistonMachine) -> float:
    charge = machine.gas.suction_density_kg_per_m3 * displaced_m3(machine.cylinder)
    return turn.delivered_kg / charge


def test_mass_is_kept_and_leakage_lowers_the_delivery() -> None:
    machine, tight = load(), changed("leakage", contact_gap_m=0.0, vane_end_gap_m=0.0)
    ours, without = (gas_of(each, 3000.0, SAMPLES) for each in (machine, tight))
    assert abs(without.leaked_kg) < 1e-3 * without.delivered_kg
    assert ours.leaked_kg > 0.02 * ours.delivered_kg
    assert volumetric(ours, machine) < volumetric(without, machine) < 1.0
    slow = gas_of(machine, 1500.0, SAMPLES)
    assert slow.leaked_kg == pytest.approx(2.0 * ours.leaked_kg, rel=0.1)  # twice the time


def test_finer_steps_change_nothing() -> None:
    machine = load()
    coarse, fine = (gas_of(machine, 3000.0, count) for count in (SAMPLES, 4 * SAMPLES))
    change = coarse.compression_pa / fine.compression_pa[::4] - 1.0
    assert np.max(np.abs(change)) < 2e-4
