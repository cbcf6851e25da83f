"""Discharge pulsation and gas in the shell of compressors on springs: closed forms, ports."""

import numpy as np
import pytest
from machine_files import machine_file
from scipy.integrate import dblquad
from scipy.special import j1

import vibroacoustics as va
from vibroacoustics.machine.gas_in_shell import DischargeGas, ShellGas
from vibroacoustics.machine.suspension import BLOCK
from vibroacoustics.mechanics.cylinder_gas import ValvedCylinder
from vibroacoustics.mechanics.ports import HOUSING
from vibroacoustics.sources.discharge_pulsation import DischargePulsation, muffler_pressure_pa
from vibroacoustics.sources.shell_gas import GasInShell, mode_numbers, wall_force_per_flow
from vibroacoustics.study.loading import load_machine
from vibroacoustics.transfer.machine import on_mounts
from vibroacoustics.transfer.tube import tube_end_reactions, tube_stiffness

SLIDER_LINK = load_machine(machine_file("dagilis_slider_link"))
MACHINES = {
    "slider link": SLIDER_LINK,
    "hermetic": load_machine(machine_file("estupinan_hermetic")),
}
STEEL = (6e-3, 4e-3, 2e11, 0.3)
"""Diameters and constants of a tube."""


def case_of(machine, speed_rpm=3000.0, highest_hz=1000.0):
    rotation = va.constant_rotation(speed_rpm, 64)
    return va.Case(machine, va.Added(), va.Revolution(speed_rpm, rotation, {}), None, highest_hz)


def shell_gas(**values):
    given = {"radius_m": 0.08, "height_m": 0.16, "middle_height_m": 0.01,
             "speed_of_sound_m_per_s": 170.0, "density_kg_per_m3": 4.0,
             "loss_factor_ratio": 0.02, "intake_ratio": 0.6, "intake_angle_rad": 0.5}  # fmt: skip
    return ShellGas(**{**given, **values})


# --- flow through the valves ---------------------------------------------------------------------


@pytest.mark.parametrize("machine", MACHINES.values(), ids=MACHINES)
def test_valves_pass_what_the_gas_leaves(machine):
    """V (1 + c)/s - V c discharged, V (1 + c) - V c s drawn in, s = (p_d/p_s)^(1/n)."""
    cylinder = machine.require(ValvedCylinder)
    suction, discharge = cylinder.flows_m3_per_rad(4096)
    clearance, span = machine.gas.clearance_ratio, cylinder.gas.span
    volume = cylinder.displaced_m3
    turn = 2.0 * np.pi
    # The step at the opening is met to half a sample.
    assert turn * suction.mean() == pytest.approx(
        volume * (1.0 + clearance - clearance * span), rel=1e-3
    )
    assert turn * discharge.mean() == pytest.approx(
        volume * ((1.0 + clearance) / span - clearance), rel=1e-2
    )
    assert not np.any((suction > 0.0) & (discharge > 0.0))


# --- discharge -----------------------------------------------------------------------------------


def test_muffler_alone_and_line_alone():
    omega, flow = np.array([0.0, 300.0, 3000.0]), np.array([1e-4, 1e-4, 1e-4j])
    gas = DischargeGas(muffler_volume_m3=1e-8, speed_of_sound_m_per_s=160.0, density_kg_per_m3=50.0)
    line = muffler_pressure_pa(flow, omega, gas, 1e-2)
    np.testing.assert_allclose(line[1:], flow[1:] * 50.0 * 160.0 / 1e-2, rtol=1e-3)
    assert line[0] == 0.0
    large = gas.model_copy(update={"muffler_volume_m3": 1.0})
    stored = muffler_pressure_pa(flow, omega, large, 1e-5)
    np.testing.assert_allclose(
        stored[1:], flow[1:] * 50.0 * 160.0**2 / (1j * omega[1:] * 1.0), rtol=1e-3
    )


def test_load_in_the_middle_of_a_clamped_tube():
    """F/2 and F L/8 at either end; a load at an end is that end's."""
    length = 0.2
    path = np.stack([np.linspace(0.0, length, 5), np.zeros(5), np.zeros(5)], axis=1)
    stiffness = tube_stiffness(path, *STEEL)
    force = np.zeros((5, 3, 3), dtype=complex)
    force[2, 1, 0] = force[0, 1, 1] = force[4, 2, 2] = 8.0
    near, far = tube_end_reactions(path, force, stiffness, *STEEL)
    assert far[1, 0] == pytest.approx(4.0)
    assert far[5, 0] == pytest.approx(-8.0 * length / 8.0)
    assert near[1, 0] == pytest.approx(4.0)
    # About the far end: the near end's force at -L, and its clamp's moment.
    assert near[5, 0] == pytest.approx(-4.0 * length + 8.0 * length / 8.0)
    np.testing.assert_allclose(far[:, 1], 0.0, atol=1e-12)
    np.testing.assert_allclose(near[:, 2], 0.0, atol=1e-9)


@pytest.mark.parametrize("machine", MACHINES.values(), ids=MACHINES)
def test_thrusts_add_up_to_that_of_the_line_outside(machine):
    """Below the waves in the tube, p A along its end, whatever its bends; sizes of some newton."""
    slow = case_of(machine, 60.0, 20.0)
    loads = DischargePulsation().loads(slow, {})
    together = loads.lines[BLOCK][:3] + loads.lines[HOUSING][:3]
    tube = machine.suspension.discharge_tube
    path = np.array([tube.x_m, tube.y_m, tube.z_m]).T
    end = (path[-1] - path[-2]) / np.linalg.norm(path[-1] - path[-2])
    thrust = loads.figures["discharge_pulsation_pa"] * np.pi / 4.0 * tube.inner_diameter_m**2
    np.testing.assert_allclose(np.abs(together[:, 1]), thrust * np.abs(end), atol=0.02 * thrust)
    assert np.abs(loads.lines[HOUSING][:3, 1]).max() > 0.1 * thrust
    assert np.all(loads.lines[BLOCK][:, 0] == 0.0)


def test_a_straight_tube_pushes_the_block_alone():
    tube = SLIDER_LINK.suspension.discharge_tube.model_copy(
        update={"x_m": (0.02, 0.05, 0.08), "y_m": (0.0, 0.0, 0.0), "z_m": (0.03, 0.03, 0.03)}
    )
    suspension = SLIDER_LINK.suspension.model_copy(update={"discharge_tube": tube})
    machine = SLIDER_LINK.model_copy(update={"suspension": suspension})
    loads = DischargePulsation().loads(case_of(machine), {})
    on_block = loads.lines[BLOCK]
    size = np.abs(on_block[0]).max()
    assert size > 0.0
    assert np.abs(loads.lines[HOUSING]).max() < 1e-12 * size
    np.testing.assert_allclose(on_block[4], 0.03 * on_block[0], atol=1e-12 * size)


# --- gas in the shell ----------------------------------------------------------------------------


def test_first_root():
    assert mode_numbers(2) == pytest.approx([1.841184, 5.331443], abs=1e-6)


@pytest.mark.parametrize("ratio", [0.2, 0.6, 1.0])
def test_gas_that_gives_way_has_momentum(ratio):
    """Below all modes j ω ρ r: what a source off the middle pushes across the shell."""
    gas = shell_gas(intake_ratio=ratio, loss_factor_ratio=1e-9)
    omega = np.array([1.0])
    expected = 1j * 4.0 * ratio * 0.08
    many = wall_force_per_flow(gas, omega, modes=4000)
    assert many[0] == pytest.approx(expected, rel=2e-3)
    assert wall_force_per_flow(gas, omega)[0] == pytest.approx(expected, rel=0.05)


def test_force_at_resonance_is_that_of_one_mode():
    """p of mode 1 at its own frequency, integrated over the wall numerically."""
    gas = shell_gas()
    kappa = mode_numbers(1)[0]
    omega = kappa * 170.0 / 0.08
    norm, _ = dblquad(
        lambda angle, r: (j1(kappa * r / 0.08) * np.cos(angle)) ** 2 * r,
        0.0,
        0.08,
        0.0,
        2.0 * np.pi,
    )
    amplitude = omega * 4.0 * 170.0**2 * j1(0.6 * kappa) / (0.16 * norm * 0.02 * omega**2)
    expected = amplitude * j1(kappa) * np.pi * 0.08 * 0.16
    force = wall_force_per_flow(gas, np.array([omega]))
    assert abs(force[0]) == pytest.approx(expected, rel=0.01)
    assert wall_force_per_flow(gas, np.array([omega]), modes=1)[0] == pytest.approx(
        expected, rel=1e-6
    )


def test_force_points_to_the_intake_at_the_middle_of_the_gas():
    gas = shell_gas()
    machine = SLIDER_LINK.model_copy(update={"shell_gas": gas})
    loads = GasInShell().loads(case_of(machine), {})
    fx, fy, fz, mx, my, mz = loads.lines[HOUSING][:, 1]
    assert fy / fx == pytest.approx(np.tan(0.5))
    assert (mx, my) == (pytest.approx(-0.01 * fy), pytest.approx(0.01 * fx))
    assert (fz, mz) == (0.0, 0.0)
    assert set(loads.lines) == {HOUSING}
    assert loads.figures["first_gas_mode_hz"] == pytest.approx(622.7, abs=0.1)


# --- ports ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("machine", MACHINES.values(), ids=MACHINES)
def test_loads_on_the_shell_are_reciprocal_to_loads_on_the_block(machine):
    """Velocity of the block per load on the shell, and of the shell per load on the block."""
    body, unit = on_mounts(machine), np.eye(6, dtype=complex)
    on_block = body.response(unit, 137.0).velocity
    on_shell = body.response(unit, 137.0, HOUSING).block_velocity
    np.testing.assert_allclose(on_block, on_shell.T, rtol=1e-9, atol=1e-12)


def test_the_port_is_that_of_the_machine_without_a_suspension(thesis_study):
    body, load = on_mounts(thesis_study.machine), np.arange(6.0) + 0j
    one, other = body.response(load, 50.0), body.response(load, 50.0, HOUSING)
    np.testing.assert_array_equal(one.velocity, other.velocity)


@pytest.mark.parametrize(
    ("kind", "word"), [(DischargePulsation, "discharge_tube"), (GasInShell, "suspension")]
)
def test_machines_on_their_own_mounts_are_refused(thesis_study, kind, word):
    assert word in kind.why_not(thesis_study.machine)
    for machine in MACHINES.values():
        assert kind.why_not(machine) is None
        bare = machine.model_copy(update={"discharge_gas": None, "shell_gas": None})
        assert "needs the machine's table" in kind.why_not(bare)
