"""The frame as load path: exact limits, conservation, reciprocity, one large system."""

import numpy as np
import pytest
from frames import frame_with
from support import ROOT

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.machine.frame import Frame
from vibroacoustics.machine.shell_structure import Joint
from vibroacoustics.mechanics.critical_speed import free_scroll_shaft
from vibroacoustics.mechanics.loads import (
    BEARING_HOUSING,
    FIXED_SCROLL,
    LOWER_BEARING,
    ORBITING_SCROLL,
    PARTS,
    STATOR,
)
from vibroacoustics.study.loading import load_study
from vibroacoustics.transfer.frame import (
    contact_forces,
    contacts_of,
    inner_set,
    shell_compliance,
)
from vibroacoustics.transfer.frame.on_shell import SHAFT_ELEMENT_M, frame_on_shell
from vibroacoustics.transfer.path import computed_path
from vibroacoustics.transfer.shell_modes import elastic_shell
from vibroacoustics.transfer.shell_modes.harmonic import Harmonic
from vibroacoustics.transfer.shell_modes.statics import WallFlexibility, local_flexibility_factor

STUDY = load_study(ROOT / "tests" / "studies" / "sources_made_up.toml")
MACHINE = STUDY.machine
STRUCTURE = MACHINE.structure.model_copy(
    update={
        name: getattr(MACHINE.structure, name).model_copy(update={"spread_rad": 0.0})
        for name in ("bearing_housing", "fixed_scroll", "stator")
    }
)
RADIUS = 0.081
OVERHANG = 35.0 / 185.0
STIFF = 1e14
LOW = np.array([2.0])
STIFF_FRAME = {
    "bolts": {"lateral_stiffness_n_per_m": STIFF, "axial_stiffness_n_per_m": STIFF},
    "thrust_face": {"stiffness_n_per_m": STIFF},
    "keys_stiffness_n_per_m": STIFF,
    "pin_stiffness_n_per_m": STIFF,
    "contacts": {"weld_n_per_m": STIFF, "leg_n_per_m": STIFF, "land_n_per_m": STIFF},
    "bearing_loss_factor_ratio": 0.0,
    "joint_loss_factor_ratio": 0.0,
}


def shaft_with(**changes):
    return free_scroll_shaft(MACHINE.shaft.model_copy(update=changes), SHAFT_ELEMENT_M)


def on_rigid_shell(frame, frequency_hz, shaft=None):
    """Wrench of each part on a shell at rest about the origin, (frequency, part, 6, load)."""
    contacts = contacts_of(frame, STRUCTURE, RADIUS)
    inner = inner_set(frame, shaft or shaft_with(), contacts)
    still = np.zeros((frequency_hz.size, *[len(contacts.part)] * 2))
    forces = contact_forces(inner, contacts.stiffness, still, frequency_hz)
    return wrenches(contacts, forces)


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
    bodies = {name: {"mass_kg": 1e-6} for name in PARTS}
    return {
        **{name: {**bodies.get(name, {}), **changes.pop(name, {})} for name in bodies},
        **changes,
    }


@pytest.mark.parametrize(
    ("overhang_m", "share"), [(0.035, 1.0 + OVERHANG), (0.005, 1.0 + 5.0 / 185.0)]
)
def test_without_bolts_soft_contacts_share_as_separate_joints_do(overhang_m, share):
    """A third of the force on each contact of the fixed scroll; a quarter on each weld."""
    soft = {"weld_n_per_m": 1.0, "leg_n_per_m": 1.0, "seal_n_per_m": 1.0, "land_n_per_m": 0.0}
    bolts = {"lateral_stiffness_n_per_m": 0.0, "axial_stiffness_n_per_m": 0.0}
    frame = frame_with(**light(bolts=bolts, contacts=soft, joint_loss_factor_ratio=0.0))
    shaft = shaft_with(
        length_m=0.185 + overhang_m,
        density_kg_per_m3=1e-3,
        rotor_mass_kg=1e-6,
        youngs_modulus_pa=1e13,
    )
    contacts = contacts_of(frame, STRUCTURE, RADIUS)
    inner = inner_set(frame, shaft, contacts)
    still = np.zeros((1, *[len(contacts.part)] * 2))
    forces = contact_forces(inner, contacts.stiffness, still, np.array([1e-3]))[0]
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


# --- on the elastic shell ------------------------------------------------------------------------


@pytest.fixture(scope="module")
def path():
    return computed_path(MACHINE.shell, MACHINE.structure, 1500.0, 1.0)


class Framed:
    """The machine with another frame."""

    def __init__(self, frame):
        self.frame, self.housing = frame, MACHINE.housing

    def has_table(self, wanted):
        return wanted is Frame or MACHINE.has_table(wanted)

    def table(self, wanted):
        return self.frame if wanted is Frame else MACHINE.table(wanted)


@pytest.fixture(scope="module")
def on_shell(path):
    seal = {"contacts": {"seal_n_per_m": 3e6}}
    return frame_on_shell(Framed(frame_with(**seal, axially_compliant=True)), path)


FREQUENCY = np.array([0.0, 48.3, 517.0, 1333.0, 2900.0])


def motion_of_parts(on_shell, frequency_hz):
    """Freedoms per load on a part, with the shell's forces put on as loads."""
    inner, omega = on_shell.inner, 2.0 * np.pi * frequency_hz
    forces = on_shell.forces(np.array([frequency_hz])).on_contacts[0]
    dynamic = inner.stiffness - omega**2 * inner.mass
    return np.linalg.solve(dynamic, inner.loads - inner.contacts.T @ forces), forces


def test_forces_on_the_shell_are_its_mass_times_its_acceleration(on_shell):
    """Force and moment: what is put on the parts less their own change of momentum."""
    net = np.tile(np.eye(6), len(PARTS))
    for frequency in FREQUENCY[1:]:
        squares = (2.0 * np.pi * frequency) ** 2
        moved, forces = motion_of_parts(on_shell, frequency)
        momentum = -squares * on_shell.inner.rigid.T @ on_shell.inner.mass @ moved
        total = on_shell.contacts.rigid.T @ forces
        assert total == pytest.approx(net - momentum, abs=1e-7 * abs(momentum).max())
        velocity = on_shell.forces(np.array([frequency])).rigid_velocity.reshape(6, -1)
        together = np.linalg.solve(on_shell.machine_mass, net)
        acceleration = 2j * np.pi * frequency * velocity + together
        assert on_shell.shell_mass @ acceleration == pytest.approx(
            total, abs=1e-9 * abs(total).max()
        )


def test_parts_answer_each_other_alike(on_shell):
    """Motion of one part per load on another is that of the other per load on the one."""
    for frequency in FREQUENCY[1:]:
        moved = on_shell.inner.loads.T @ motion_of_parts(on_shell, frequency)[0]
        assert moved == pytest.approx(moved.T, abs=1e-7 * abs(moved).max())
        shell = on_shell.compliance(np.array([frequency]))[0]
        assert shell == pytest.approx(shell.T, abs=1e-12 * abs(shell).max())


def test_nothing_moves_at_frequency_zero(on_shell):
    got = on_shell.forces(FREQUENCY)
    for array in (got.on_modes, got.rigid_velocity):
        assert not array[..., 0].any()
        assert np.all(np.isfinite(array))


def test_elimination_is_that_of_one_large_system(on_shell):
    """Freedoms of the parts, modes and rigid motion of the shell side by side."""
    inner, contacts = on_shell.inner, on_shell.contacts
    bare = np.zeros_like(on_shell.residual)
    shell = np.concatenate([on_shell.modal_forces.T, contacts.rigid], axis=1)
    modes, loss = on_shell.natural_hz.size, on_shell.loss_factor_ratio
    across = np.concatenate([inner.contacts, -shell], axis=1)
    size, parts = across.shape[1], inner.mass.shape[0]
    mass = np.zeros((size, size))
    mass[:parts, :parts] = inner.mass
    mass[parts : parts + modes, parts : parts + modes] = np.diag(on_shell.modal_mass_kg)
    mass[parts + modes :, parts + modes :] = on_shell.shell_mass
    stiffness = across.T @ (contacts.stiffness[:, None] * across)
    stiffness[:parts, :parts] += inner.stiffness
    own = on_shell.modal_mass_kg * (2.0 * np.pi * on_shell.natural_hz) ** 2 * (1.0 + 1j * loss)
    rows = np.arange(parts, parts + modes)
    stiffness[rows, rows] += own
    rigid = contacts.rigid @ np.linalg.solve(on_shell.shell_mass, contacts.rigid.T)
    for frequency in FREQUENCY[1:]:
        dynamic = stiffness - (2.0 * np.pi * frequency) ** 2 * mass
        loads = np.concatenate([inner.loads, np.zeros((size - parts, inner.loads.shape[1]))])
        expected = contacts.stiffness[:, None] * (across @ np.linalg.solve(dynamic, loads))
        at = np.array([frequency])
        compliance = shell_compliance(
            on_shell.modal_forces,
            on_shell.natural_hz,
            on_shell.modal_mass_kg,
            loss,
            bare,
            rigid,
            at,
        )
        got = contact_forces(inner, contacts.stiffness, compliance, at)[0]
        assert got == pytest.approx(expected, abs=1e-8 * abs(expected).max())


def test_steady_flexibility_is_the_sum_over_all_modes(path):
    """Of one order around, all modes that the elements have."""
    shell = path.wall.shell
    freedoms = np.arange(300, 340)
    for order in (0, 1, 3):
        harmonic = Harmonic(shell.meridian, shell.structure, order)
        frequency, shapes = harmonic.modes(1e8)
        shapes = shapes[freedoms]
        elastic = frequency < 3e7  # rigid motions are moved beyond
        modes = (shapes / (2.0 * np.pi * frequency) ** 2)[:, elastic] @ shapes[:, elastic].T
        steady = harmonic.static_flexibility(freedoms)
        assert steady == pytest.approx(modes, rel=0.0, abs=1e-6 * abs(modes).max())


def test_flexibility_at_a_weld():
    """18.5 N/µm outwards and 660 N/µm along were computed elsewhere for 47 modes and the rest."""
    weld = MACHINE.structure.bearing_housing.model_copy(update={"band_m": 0.012})
    dome = MACHINE.shell.model_copy(update={"dome_height_m": 0.04})
    wall = WallFlexibility(elastic_shell(dome, MACHINE.structure, 1000.0))
    outwards, up, _ = 1e-6 / np.diag(wall.at([weld]))[:3]
    assert outwards == pytest.approx(18.5, rel=0.15)
    assert up == pytest.approx(660.0, rel=0.1)


def test_what_the_modes_leave_out_only_softens(path, on_shell):
    assert np.linalg.eigvalsh(on_shell.residual)[0] > -1e-9 * abs(on_shell.residual).max()
    stiffness = on_shell.modal_mass_kg * (2.0 * np.pi * on_shell.natural_hz) ** 2
    modes = on_shell.modal_forces.T @ (on_shell.modal_forces / stiffness[:, None])
    total = path.wall.flexibility.at(on_shell.contacts.joints)
    assert modes + on_shell.residual == pytest.approx(total, abs=1e-12 * abs(total).max())
    assert np.trace(on_shell.residual) > 0.1 * np.trace(total)


def test_flexibility_of_another_wall():
    """Twice the thickness computed anew: 1/t² outwards at a weld to a fifth."""
    wall = MACHINE.structure
    thick = wall.model_copy(update={"thickness_m": 0.004, "youngs_modulus_pa": 2.12e11})
    weld = Joint(height_m=0.0, band_m=0.012, welds=3, spread_rad=0.14)
    each = [
        WallFlexibility(elastic_shell(MACHINE.shell, w, 800.0)).at([weld]) for w in (wall, thick)
    ]
    outwards = each[1][0, 0] / each[0][0, 0]
    assert outwards == pytest.approx(local_flexibility_factor(wall, thick), rel=0.2)


def test_a_stator_that_nothing_holds_feels_nothing():
    frame = frame_with(contacts={"land_n_per_m": 0.0})
    got = on_rigid_shell(frame, FREQUENCY[1:])
    assert not got[..., 6 * STATOR :].any()
    assert not got[:, STATOR].any()


def test_parts_heavier_than_the_machine_are_one_line(path):
    with pytest.raises(
        ParameterError, match=r"housing\.mass_kg = 35 kg: frame and shaft weigh"
    ) as e:
        frame_on_shell(Framed(frame_with(stator={"mass_kg": 30.0})), path)
    assert len(str(e.value).splitlines()) == 1
