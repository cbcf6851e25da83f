"""The frame as load path: exact limits on a wall at rest."""

import numpy as np
import pytest
from frames import frame_with
from shaft_by_transfer import forces_on_rigid_wall
from support import ROOT

from vibroacoustics.machine.frame import PARTS
from vibroacoustics.mechanics.critical_speed import free_scroll_shaft
from vibroacoustics.study.loading import load_study
from vibroacoustics.transfer.frame.contacts import contacts_of
from vibroacoustics.transfer.frame.inner import bearings_of, inner_set
from vibroacoustics.transfer.frame.of_machine import SHAFT_ELEMENT_M
from vibroacoustics.transfer.frame.on_shell import FrameOnShell

MACHINE = load_study(ROOT / "tests" / "studies" / "sources_made_up.toml").machine
STRUCTURE = MACHINE.structure.model_copy(
    update={
        name: getattr(MACHINE.structure, name).model_copy(update={"spread_rad": 0.0})
        for name in ("bearing_housing", "fixed_scroll", "stator")
    }
)
FIXED_SCROLL, BEARING_HOUSING, ORBITING_SCROLL, LOWER_BEARING, STATOR = range(len(PARTS))
RADIUS = 0.081
OVERHANG = 35.0 / 185.0
STIFF = 1e14
LOW = np.array([2.0])
HEAVY = 1e9
"""Mass and inertia of a shell at rest, kg and kg m²."""
STIFF_FRAME = {
    "bolts": {"lateral_stiffness_n_per_m": STIFF, "axial_stiffness_n_per_m": STIFF},
    "thrust_face": {"stiffness_n_per_m": STIFF},
    "keys_stiffness_n_per_m": STIFF,
    "pin_stiffness_n_per_m": STIFF,
    "contacts": {"weld_n_per_m": STIFF, "leg_n_per_m": STIFF, "land_n_per_m": STIFF},
    "metal_loss_factor_ratio": 0.0,
    "joint_loss_factor_ratio": 0.0,
}


def shaft_with(**changes):
    return free_scroll_shaft(MACHINE.shaft.model_copy(update=changes), SHAFT_ELEMENT_M)


def on_rigid_shell(frame, frequency_hz, shaft=None):
    """Wrench of each part on a shell at rest about the origin, (frequency, part, 6, load)."""
    on_shell = on_heavy_shell(frame, shaft or shaft_with())
    return wrenches(on_shell.contacts, on_shell.contact_forces(frequency_hz))


def on_heavy_shell(frame, shaft):
    """Without modes, and so heavy that it stays at rest."""
    contacts = contacts_of(frame, STRUCTURE, RADIUS)
    count = len(contacts.part)
    none, residual = np.zeros(0), np.zeros((count, count))
    inner = inner_set(frame, shaft, contacts)
    modes = np.zeros((0, count)), residual, none, none, 0.0
    return FrameOnShell(inner, contacts, *modes, HEAVY * np.eye(6))


def wrenches(contacts, forces):
    held = [contacts.part == part for part in range(len(PARTS))]
    return np.stack([contacts.rigid[rows].T @ forces[:, rows] for rows in held], axis=1)


def pair(force, at):
    """A force on the fixed scroll and its opposite on the orbiting one, at a point."""
    load = np.zeros((len(PARTS), 6))
    load[FIXED_SCROLL] = *force, *np.cross(at, force)
    load[ORBITING_SCROLL] = -load[FIXED_SCROLL]
    return load.ravel()


# --- exact limits --------------------------------------------------------------------------------


@pytest.mark.parametrize("height", [0.11, 0.13, 0.15])
def test_stiff_and_slow_the_lower_bearing_takes_the_overhang(height):
    """0.1892 of the pair, whatever the height of the wraps: a lever on two bearings."""
    got = on_rigid_shell(frame_with(**STIFF_FRAME), LOW)[0] @ pair([1.0, 0.0, 0.0], [0, 0, height])
    assert got[LOWER_BEARING, 0] == pytest.approx(OVERHANG, abs=2e-5)
    assert got[BEARING_HOUSING, 0] == pytest.approx(-OVERHANG, abs=2e-5)
    assert abs(got[:, 2]).max() < 1e-6
    assert abs(got.sum(axis=0)[3:5]).max() < 2e-5


def test_stiff_and_slow_an_axial_pair_stays_inside():
    for axially_compliant in (False, True):
        frame = frame_with(**STIFF_FRAME, axially_compliant=axially_compliant)
        got = on_rigid_shell(frame, LOW)[0] @ pair([0.0, 0.0, 1.0], [1.7e-3, 0.0, 0.13])
        assert abs(got).max() < 1e-5


def test_stiff_and_slow_the_joints_bear_the_torque():
    """F_t r on all joints, half of it over the keys: the rotor is its counterpart."""
    force, radius = 26.0, 3.46e-3
    load = pair([0.0, force, 0.0], [radius / 2.0, 0.0, 0.13]).reshape(len(PARTS), 6)
    load[ORBITING_SCROLL, 5] = force * radius / 2.0
    for keys_on in ("fixed-scroll", "bearing-housing"):
        got = on_rigid_shell(frame_with(**STIFF_FRAME, keys_on=keys_on), LOW)[0] @ load.ravel()
        assert got[:, 5].sum() == pytest.approx(force * radius, rel=1e-5)


def light(**changes):
    """Nearly massless parts."""
    bodies = {part.name: {"mass_kg": 1e-3} for part in PARTS}
    return {
        **{name: {**bodies.get(name, {}), **changes.pop(name, {})} for name in bodies},
        **changes,
    }


@pytest.mark.parametrize(
    ("overhang_m", "share"), [(0.035, 1.0 + OVERHANG), (0.005, 1.0 + 5.0 / 185.0)]
)
def test_without_bolts_soft_contacts_share_as_separate_joints_do(overhang_m, share):
    """A third of the force on each contact of the fixed scroll; a quarter on each weld."""
    soft = dict.fromkeys(("weld_n_per_m", "leg_n_per_m", "seal_n_per_m"), 100.0)
    soft["land_n_per_m"] = 0.0
    bolts = {"lateral_stiffness_n_per_m": 0.0, "axial_stiffness_n_per_m": 0.0}
    frame = frame_with(**light(bolts=bolts, contacts=soft, joint_loss_factor_ratio=0.0))
    shaft = shaft_with(
        length_m=0.185 + overhang_m,
        density_kg_per_m3=1.0,
        rotor_mass_kg=1e-3,
        youngs_modulus_pa=1e13,
    )
    on_shell = on_heavy_shell(frame, shaft)
    contacts, forces = on_shell.contacts, on_shell.contact_forces(np.array([1e-3]))[0]
    force = forces @ pair([1.0, 0.0, 0.0], [0.0, 0.0, 0.13])
    outwards, _, around = force.reshape(-1, 3).T
    angle = np.arctan2(*contacts.rigid[::3, [1, 0]].T)
    along_x = outwards * np.cos(angle) - around * np.sin(angle)
    of_part = contacts.part[::3]
    assert along_x[of_part == FIXED_SCROLL] == pytest.approx(np.full(3, 1.0 / 3.0), abs=1e-4)
    assert along_x[of_part == BEARING_HOUSING] == pytest.approx(np.full(4, -share / 4.0), abs=3e-4)


def test_peaks_of_the_base_case():
    """Shaft's bending at 512 Hz, scroll on pin at 736 Hz, from a computation of its kind."""
    frame = frame_with(stator={"mass_kg": 1e-3}, contacts={"land_n_per_m": 0.0})
    frequency = np.arange(400.0, 900.0, 4.0)
    got = on_rigid_shell(frame, frequency) @ pair([1.0, 0.0, 0.0], [0.0, 0.0, 0.13])
    lower, housing = abs(got[:, LOWER_BEARING, 0]), abs(got[:, BEARING_HOUSING, 0])
    assert frequency[np.argmax(lower)] == pytest.approx(512.0, rel=0.04)
    assert frequency[np.argmax(housing)] == pytest.approx(736.0, rel=0.04)


def test_a_stator_that_nothing_holds_feels_nothing():
    frame = frame_with(contacts={"land_n_per_m": 0.0})
    got = on_rigid_shell(frame, np.array([48.3, 517.0, 1333.0, 2900.0]))
    assert abs(got[..., 6 * STATOR :]).max() < 1e-9 * abs(got).max()
    assert not got[:, STATOR].any()


def test_shaft_of_88_cells_by_transfer_matrices():
    """The pair at 500 Hz, where the shaft bends, and 4 kHz: another method, exact in each cell."""
    frame, frequency = frame_with(), np.array([*np.arange(480.0, 520.0), 4000.0])
    load = pair([1.0, 0.0, 0.0], [0.0, 0.0, 0.13])
    got = (on_rigid_shell(frame, frequency) @ load)[:, LOWER_BEARING, 0]
    contacts = contacts_of(frame, STRUCTURE, RADIUS)
    bearings = bearings_of(frame, shaft_with())
    held = 1.0 / np.array([each.flexibility(2.0 * np.pi * frequency) for each in bearings])
    lines = zip(held.T, frequency, strict=True)
    every = [forces_on_rigid_wall(frame, MACHINE.shaft, contacts, *line) for line in lines]
    forces = np.reshape(every, (frequency.size, -1, load.size))
    expected = (wrenches(contacts, forces) @ load)[:, LOWER_BEARING, 0]
    assert abs(expected).max() > 20.0
    # Cubic elements of 17 mm err by (k h)⁴/1440, 0.03 % of a frequency, at 4 kHz in the rotor;
    # a pole and a zero of loss 0.1 near it make that 20 times as large each.
    assert abs(got / expected - 1.0).max() < 0.012
