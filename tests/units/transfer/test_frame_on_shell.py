"""The frame in the elastic shell: conservation, reciprocity, elimination, flexibility."""

from dataclasses import replace

import numpy as np
import pytest
from frames import frame_with
from scipy.linalg import block_diag
from support import ROOT

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.machine.frame import PARTS, Frame
from vibroacoustics.machine.shell_structure import Joint
from vibroacoustics.mechanics.journal_film import JournalFilm
from vibroacoustics.study.loading import load_study
from vibroacoustics.transfer.frame.contacts import rigid_rows
from vibroacoustics.transfer.frame.of_machine import frame_on_shell
from vibroacoustics.transfer.frame.symmetric import answers, solve_symmetric, upper_pairs
from vibroacoustics.transfer.natural_frequencies import framed_hz
from vibroacoustics.transfer.path import computed_path
from vibroacoustics.transfer.shell_modes.harmonic import Harmonic
from vibroacoustics.transfer.shell_modes.modes import elastic_shell
from vibroacoustics.transfer.shell_modes.projection import velocity_per_force
from vibroacoustics.transfer.shell_modes.statics import WallFlexibility, local_flexibility_factor

MACHINE = load_study(ROOT / "tests" / "studies" / "sources_made_up.toml").machine


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


@pytest.mark.parametrize("spread_rad", [0.0, 0.9])
def test_welds_move_with_the_rigid_shell(spread_rad):
    """u = t + ω × p out, up and around, mean over each weld by midpoints: (0.9 / 400)² / 24."""
    joint = Joint(height_m=0.07, welds=3, first_angle_rad=0.4, spread_rad=spread_rad)
    rows, radius = rigid_rows(joint, 0.08), 0.08
    for weld in range(3):
        around = 0.4 + weld * 2.0 * np.pi / 3.0 + spread_rad * ((np.arange(400) + 0.5) / 400 - 0.5)
        cosine, sine, none = np.cos(around), np.sin(around), np.zeros(400)
        place = np.stack([radius * cosine, radius * sine, none + 0.07], axis=-1)
        axes = np.stack([[cosine, sine, none], [none, none, none + 1.0], [-sine, cosine, none]])
        for number, unit in enumerate(np.eye(6)):
            motion = unit[:3] + np.cross(unit[3:], place)
            expected = np.einsum("acp,pc->ap", axes, motion).mean(axis=1)
            assert rows[3 * weld : 3 * weld + 3, number] == pytest.approx(expected, abs=1e-6)


FREQUENCY = np.array([0.0, 48.3, 517.0, 1333.0, 2900.0])


def with_bearings(inner, frequency_hz):
    """Stiffness of bodies, shaft and bearings with loss, shape (freedom, freedom)."""
    lossy = [
        part.stiffness * (1.0 + 1j * part.loss_factor_ratio) for part in (inner.bodies, inner.shaft)
    ]
    flexibility = inner.flexibility(np.array([2.0 * np.pi * frequency_hz]))[:, 0]
    between = inner.gaps[-flexibility.size :]
    return block_diag(*lossy) + between.T @ (between / flexibility[:, None])


def at_contacts(on_shell):
    """Motion at the contacts per freedom of the parts, shape (contact, freedom)."""
    return on_shell.inner.gaps[: len(on_shell.contacts.part)]


def with_rigid_films(on_shell):
    """Bearings of metal alone."""
    rigid = JournalFilm(0.0, 1e30 * np.eye(2), np.zeros((2, 2)))
    bearings = tuple(replace(bearing, film=rigid) for bearing in on_shell.inner.bearings)
    return replace(on_shell, inner=replace(on_shell.inner, bearings=bearings))


def velocities(on_shell, frequency_hz):
    """Of the shell's modes and then its rigid motions per load, (motion, load, frequency)."""
    count = on_shell.natural_hz.size + 6
    each = np.repeat(np.eye(count)[..., None], frequency_hz.size, axis=-1)
    return on_shell.sound(each[:, :-6], each[:, -6:], frequency_hz).of_loads


def motion_of_parts(on_shell, frequency_hz):
    """Freedoms per load on a part, with the shell's forces put on as loads."""
    inner, omega = on_shell.inner, 2.0 * np.pi * frequency_hz
    forces = on_shell.contact_forces(np.array([frequency_hz]))[0]
    dynamic = with_bearings(inner, frequency_hz) - omega**2 * inner.mass
    return np.linalg.solve(dynamic, inner.loads - at_contacts(on_shell).T @ forces), forces


def test_forces_on_the_shell_are_its_mass_times_its_acceleration(on_shell):
    """Force and moment: what is put on the parts less their own change of momentum."""
    net = np.tile(np.eye(6), len(PARTS))
    for frequency in FREQUENCY[1:]:
        squares = (2.0 * np.pi * frequency) ** 2
        moved, forces = motion_of_parts(on_shell, frequency)
        momentum = -squares * on_shell.inner.rigid.T @ on_shell.inner.mass @ moved
        total = on_shell.contacts.rigid.T @ forces
        assert total == pytest.approx(net - momentum, abs=1e-7 * abs(momentum).max())
        velocity = velocities(on_shell, np.array([frequency]))[-6:].reshape(6, -1)
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


def test_nothing_moves_at_frequency_zero(on_shell):
    for array in (velocities(on_shell, FREQUENCY).T, on_shell.contact_forces(FREQUENCY)):
        assert not array[0].any()
        assert np.all(np.isfinite(array))


def test_motion_under_loads_is_what_receivers_of_each_motion_hear(on_shell):
    """Loads put on directly, against reciprocity: from the receivers to the loads."""
    random, count = np.random.default_rng(1), on_shell.natural_hz.size
    shapes = (6 * len(PARTS), FREQUENCY.size), (count, FREQUENCY.size)
    on_parts, on_modes = (random.normal(size=(2, *shape)) for shape in shapes)
    on_parts, on_modes = on_parts[0] + 1j * on_parts[1], on_modes[0] + 1j * on_modes[1]
    each = np.repeat(np.eye(count + 6)[..., None], FREQUENCY.size, axis=-1)
    heard = on_shell.sound(each[:, :-6], each[:, -6:], FREQUENCY)
    expected = np.einsum("nlf,lf->nf", heard.of_loads, on_parts)
    expected += np.einsum("nmf,mf->nf", heard.of_modes(np.arange(FREQUENCY.size)), on_modes)
    moved = on_shell.velocities(on_parts, on_modes, FREQUENCY)
    largest = abs(expected).max(axis=0)
    assert abs(moved - expected).max(axis=0) == pytest.approx(
        0.0 * largest, abs=1e-9 * largest.max()
    )
    assert not moved[:, 0].any()


def test_natural_frequencies_make_the_contacts_infinitely_compliant(on_shell):
    """Without loss: there the compliance of the gaps has no inverse, or a mode moves no contact."""
    still = replace(with_rigid_films(on_shell), loss_factor_ratio=0.0)
    inner, stiff = still.inner, still.contacts.stiffness.real
    inner = replace(
        inner,
        bodies=replace(inner.bodies, loss_factor_ratio=0.0),
        shaft=replace(inner.shaft, loss_factor_ratio=0.0),
        bearings=tuple(
            replace(each, metal_stiffness=each.metal_stiffness.real) for each in inner.bearings
        ),
    )
    still = replace(still, inner=inner, contacts=replace(still.contacts, stiffness=stiff))
    hertz = framed_hz(on_shell)
    hertz = hertz[hertz < 1500.0]
    alone = [*still.natural_hz, *np.sqrt(np.abs(still.motions.squares)) / (2.0 * np.pi)]
    coupled = [one for one in hertz if abs(np.array(alone) / one - 1.0).min() > 1e-9]
    assert len(coupled) >= 8

    def least(frequency_hz):
        omega = np.array([2.0 * np.pi * frequency_hz])
        shell = answers(still._squares, omega) / still.modal_mass_kg[:, None]
        pairs, _ = still._compliance(shell, answers(still.motions.squares, omega), omega)
        full = np.zeros((len(still.inner.gaps),) * 2)
        rows, columns = upper_pairs(len(full))
        full[rows, columns] = full[columns, rows] = pairs[:, 0]
        return abs(np.linalg.eigvalsh(full)).min()

    for one in coupled:
        assert least(one) < 1e-3 * max(least(0.999 * one), least(1.001 * one))


def test_contacts_give_what_elimination_of_the_parts_gives(on_shell):
    """Frequency by frequency: f = Y B q, (D + Bᵀ Y B) q = P, Y = (1 + k C)⁻¹ k."""
    inner, contacts = on_shell.inner, on_shell.contacts
    held, rows = contacts.stiffness[:, None], contacts.rigid
    loss = on_shell.loss_factor_ratio
    for frequency in FREQUENCY[1:]:
        at, omega = np.array([frequency]), 2.0 * np.pi * frequency
        modes = velocity_per_force(on_shell.natural_hz, on_shell.modal_mass_kg, loss, at)
        compliance = on_shell.modal_forces.T @ (modes / (1j * omega) * on_shell.modal_forces)
        compliance += on_shell.residual / (1.0 + 1j * loss)
        compliance -= rows @ np.linalg.solve(on_shell.shell_mass, rows.T) / omega**2
        weighted = np.eye(len(held)) + held * compliance
        gaps = at_contacts(on_shell)
        through = np.linalg.solve(weighted, held * gaps)
        dynamic = with_bearings(inner, frequency) - omega**2 * inner.mass + gaps.T @ through
        expected = through @ np.linalg.solve(dynamic, inner.loads)
        got = on_shell.contact_forces(at)[0]
        assert got == pytest.approx(expected, abs=1e-9 * abs(expected).max())
        elastic = velocities(on_shell, at)[:-6].reshape(-1, expected.shape[1])
        driven = modes * (on_shell.modal_forces @ expected)
        assert elastic == pytest.approx(driven, abs=1e-9 * abs(driven).max())


def test_contacts_give_what_natural_motions_of_all_together_give(on_shell):
    """K x = ω² M x with the contacts in K; loads freed of what moves the machine as one body."""
    on_shell = with_rigid_films(on_shell)
    inner, count = on_shell.inner, on_shell.natural_hz.size
    shell = np.concatenate([on_shell.modal_forces.T, on_shell.contacts.rigid], axis=1)
    stretch = np.concatenate([at_contacts(on_shell), -shell], axis=1)
    wall = on_shell.residual / (1.0 + 1j * on_shell.loss_factor_ratio)
    held = np.linalg.inv(np.diag(1.0 / on_shell.contacts.stiffness) + wall)
    lossy = (2.0 * np.pi * on_shell.natural_hz) ** 2 * (1.0 + 1j * on_shell.loss_factor_ratio)
    elastic = np.diag(on_shell.modal_mass_kg * lossy)
    stiffness = block_diag(with_bearings(inner, 1.0), elastic, np.zeros((6, 6)))
    stiffness = stiffness + stretch.T @ held @ stretch
    mass = block_diag(inner.mass, np.diag(on_shell.modal_mass_kg), on_shell.shell_mass)
    free = np.concatenate([inner.rigid, np.zeros((count, 6)), np.eye(6)])
    together = free @ np.linalg.solve(free.T @ mass @ free, free.T)
    root = np.linalg.inv(np.linalg.cholesky(mass))
    squares, unit = np.linalg.eig(root @ stiffness @ root.T)
    freed = np.eye(len(mass)) - mass @ together
    shapes, drives = root.T @ unit, np.linalg.solve(unit, root @ freed)
    loads = np.concatenate([inner.loads, np.zeros((count + 6, inner.loads.shape[1]))])
    for frequency in FREQUENCY[1:]:
        omega = 2.0 * np.pi * frequency
        moved = (shapes / (squares - omega**2)) @ drives
        each = np.eye(count + 6)[..., None]
        of_loads, of_modes = on_shell.sound(each[:, :-6], each[:, -6:], np.array([frequency]))
        expected = 1j * omega * (moved @ loads)[len(inner.mass) :]
        got = of_loads.reshape(expected.shape)
        assert got == pytest.approx(expected, abs=1e-8 * abs(expected).max())
        expected = 1j * omega * moved[len(inner.mass) :, len(inner.mass) : -6]
        assert of_modes(np.array([0]))[..., 0] == pytest.approx(
            expected, abs=1e-8 * abs(expected).max()
        )


def test_systems_side_by_side():
    """Complex symmetric matrices as a library solves them, more of them than go at a time."""
    sampled = np.random.default_rng(1).normal(size=(4, 200, 7, 7))
    matrix = sampled[0] + sampled[0].swapaxes(1, 2) + 1j * (sampled[1] @ sampled[1].swapaxes(1, 2))
    right = np.moveaxis(sampled[2] + 1j * sampled[3], 0, -1)[:, :3]
    rows, columns = upper_pairs(7)
    packed = matrix[:, rows, columns].T
    got = np.ascontiguousarray(right)
    solve_symmetric(packed.real.copy(), packed.imag.copy(), got)
    expected = np.linalg.solve(matrix, np.moveaxis(right, -1, 0))
    np.testing.assert_allclose(np.moveaxis(got, -1, 0), expected, rtol=1e-9, atol=1e-12)


@pytest.mark.long
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
    outwards, up, _ = 1e-6 / np.diag(wall.at_joints([weld]))[:3]
    assert outwards == pytest.approx(18.5, rel=0.15)
    assert up == pytest.approx(660.0, rel=0.1)


def test_what_the_modes_leave_out_only_softens(path, on_shell):
    assert np.linalg.eigvalsh(on_shell.residual)[0] > -1e-9 * abs(on_shell.residual).max()
    stiffness = on_shell.modal_mass_kg * (2.0 * np.pi * on_shell.natural_hz) ** 2
    modes = on_shell.modal_forces.T @ (on_shell.modal_forces / stiffness[:, None])
    total = path.wall.flexibility.at_joints(on_shell.contacts.joints)
    assert modes + on_shell.residual == pytest.approx(total, abs=1e-12 * abs(total).max())
    assert np.trace(on_shell.residual) > 0.1 * np.trace(total)


def test_flexibility_of_another_wall():
    """Twice the thickness computed anew: 1/t² outwards at a weld to a fifth."""
    wall = MACHINE.structure
    thick = wall.model_copy(update={"thickness_m": 0.004, "youngs_modulus_pa": 2.12e11})
    weld = Joint(height_m=0.0, band_m=0.012, welds=3, spread_rad=0.14)
    each = [
        WallFlexibility(elastic_shell(MACHINE.shell, w, 800.0)).at_joints([weld])
        for w in (wall, thick)
    ]
    outwards = each[1][0, 0] / each[0][0, 0]
    assert outwards == pytest.approx(local_flexibility_factor(wall, thick), rel=0.2)


def test_parts_heavier_than_the_machine_are_one_line(path):
    with pytest.raises(
        ParameterError, match=r"housing\.mass_kg = 35 kg: frame and shaft weigh"
    ) as e:
        frame_on_shell(Framed(frame_with(stator={"mass_kg": 30.0})), path)
    assert len(str(e.value).splitlines()) == 1
