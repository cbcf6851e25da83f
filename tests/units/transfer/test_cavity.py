"""Gas in the shell: modes against closed forms, force on the wall, response both ways."""

import numpy as np
import pytest
from documents import APART, FORM
from evidence import claim
from gas_and_wall import GasAndWall
from scipy.optimize import brentq
from scipy.special import jnp_zeros, jvp, yvp
from support import ROOT

from vibroacoustics.machine.cavities import DischargeDome
from vibroacoustics.study.loading import load_study
from vibroacoustics.transfer.cavity.elements import (
    annulus_profile,
    disc_profile,
    interpolation,
    matrices,
)
from vibroacoustics.transfer.cavity.in_shell import GasInShell, GasOrder, Mouth
from vibroacoustics.transfer.cavity.of_machine import spaces_of
from vibroacoustics.transfer.cavity.response import DrivenGas
from vibroacoustics.transfer.cavity.wall import WallPressure
from vibroacoustics.transfer.path import computed_path
from vibroacoustics.transfer.shell_modes.elements import (
    AXIAL,
    CIRCUMFERENTIAL,
    NODE_DOFS,
    RADIAL,
)
from vibroacoustics.transfer.shell_modes.modes import Around

RADIUS, CAP, DEPTH, RIM = 0.0793, 0.0368, 0.017, 0.187
DENSITY, SOUND = 112.0, 178.0


def hertz(wavenumber_squared, sound_speed=SOUND):
    return np.sqrt(wavenumber_squared) * sound_speed / (2.0 * np.pi)


def with_axial(wavenumbers, height, sound_speed=SOUND, below_hz=4500.0):
    """Modes that are products with cos mπz/H, rising, without the uniform one."""
    axial = np.pi * np.arange(12) / height
    every = np.sort(hertz(np.add.outer(np.square(wavenumbers), axial**2).ravel(), sound_speed))
    return every[(every > 0.0) & (every < below_hz)]


@pytest.mark.parametrize("order", range(5))
@pytest.mark.parametrize("height", [0.03, 0.052])
def test_flat_disc_has_bessels_roots(order, height):
    roots = [0.0] * (order == 0) + list(jnp_zeros(order, 10))
    expected = with_axial(np.array(roots) / RADIUS, height)
    modes = hertz(GasOrder(disc_profile(RADIUS, 0.0, height, 0.1), order).modes[0])
    obtained = modes[order == 0 :][: expected.size]
    claim(
        f"Gas in a flat disc of {1e3 * height:g} mm, order {order}", kind="exact", unit="Hz",
        source=FORM("roots of J'_n and cos mπz/H"), computed=obtained, reference=expected,
        tolerance=4e-4 * expected, topics=("discharge_dome",),
    )  # fmt: skip


@pytest.mark.parametrize("order", range(4))
def test_annulus_has_the_roots_of_two_walls(order):
    inner, outer, height = 0.06, 0.079, 0.075

    def both_rigid(k):
        first = jvp(order, k * inner) * yvp(order, k * outer)
        return first - jvp(order, k * outer) * yvp(order, k * inner)

    tried = np.linspace(1.0, 400.0, 2000)
    signs = np.flatnonzero(np.diff(np.sign(both_rigid(tried))))
    roots = [brentq(both_rigid, tried[i], tried[i + 1]) for i in signs]
    expected = with_axial(np.array([0.0] * (order == 0) + roots), height, 182.0)
    modes = hertz(GasOrder(annulus_profile(inner, outer, 0.0, height), order).modes[0], 182.0)
    obtained = modes[order == 0 :][: expected.size]
    claim(
        f"Gas in an annulus, order {order}", kind="exact", unit="Hz", computed=obtained,
        source=FORM("roots of J'_n Y'_n between two walls"), reference=expected,
        tolerance=4e-4 * expected, topics=("suction_annulus",),
    )  # fmt: skip
    if order:
        assert obtained[0] == pytest.approx(417.0 * order, rel=3e-3)


def dome():
    return disc_profile(RADIUS, CAP, DEPTH, RIM - DEPTH)


@pytest.mark.parametrize(
    ("order", "expected"),
    [(0, [1365, 1941]), (1, [711, 1857]), (2, [1155, 2289]), (3, [1570, 2682])],
)
def test_dome_as_computed_elsewhere(order, expected):
    """Elements of another code, to its digits."""
    modes = hertz(GasOrder(dome(), order).modes[0])[order == 0 :]
    print(f"n = {order}: expected {expected} Hz, obtained {np.round(modes[:2], 1)} Hz")
    claim(
        f"Gas in the dome, order {order}", kind="second code", source=APART("finite elements"),
        computed=modes[:2], reference=expected, tolerance=0.6, unit="Hz",
        topics=("discharge_dome",),
    )  # fmt: skip


# --- attachment mode ---


def test_attachment_mode_is_the_steady_response_that_modes_leave_out():
    """At the source and far below the first mode, where modes alone miss most of it."""
    gas = GasOrder(dome(), 2)
    source = interpolation(gas.profile, 0.005, RIM - DEPTH)
    stiffness, mass = matrices(gas.profile, 2)
    free = gas.profile.nodes[..., 0].ravel() > 0.0
    squares, shapes = gas.with_attachment(source)
    alone = slice(0, -1)
    for frequency in (400.0, 900.0, 1700.0, 2600.0):
        wavenumber = (2.0 * np.pi * frequency / SOUND) ** 2
        system = (stiffness - wavenumber * mass)[np.ix_(free, free)]
        direct = source[free] @ np.linalg.solve(system, source[free])
        each = (source @ shapes) ** 2 / (squares - wavenumber)
        assert each.sum() == pytest.approx(direct, rel=0.01)
        assert abs(each[alone].sum() / direct) < 0.5
    np.testing.assert_allclose(shapes.T @ mass @ shapes, np.eye(squares.size), atol=1e-8)
    np.testing.assert_allclose(shapes.T @ stiffness @ shapes, np.diag(squares), atol=1e-4)


def test_a_source_on_the_axis_drives_order_zero_alone():
    for order in range(4):
        gas = GasOrder(dome(), order)
        source = interpolation(gas.profile, 0.0, RIM - DEPTH)
        _, shapes = gas.with_attachment(source)
        assert np.any(np.abs(source @ shapes) > 1.0) == (order == 0)


# --- force on the wall ---


@pytest.fixture(scope="module")
def path():
    study = load_study(ROOT / "tests" / "studies" / "sources_made_up.toml")
    domed = study.machine.shell.model_copy(update={"dome_height_m": 0.04})
    return computed_path(domed, study.machine.structure, 4100.0, 1.0)


def rigid_motion(meridian, order):
    """Along z for order 0, along x and about y for order 1, as amplitudes; see `Harmonic`."""
    radius, height = meridian.nodes.T
    total = NODE_DOFS * radius.size + 4 * meridian.elements
    motions = np.zeros((total, 1 + order))
    nodes = motions[: NODE_DOFS * radius.size]
    if order == 0:
        nodes[AXIAL::NODE_DOFS, 0] = 1.0
        return motions
    nodes[RADIAL::NODE_DOFS] = np.stack([np.ones_like(height), height], axis=1)
    nodes[CIRCUMFERENTIAL::NODE_DOFS] = -nodes[RADIAL::NODE_DOFS]
    nodes[AXIAL::NODE_DOFS, 1] = -radius
    return motions


def test_uniform_pressure_has_no_net_force(path):
    meridian, space = path.wall.shell.meridian, dome()
    forces = WallPressure(space, True).generalised(meridian, Around(0, 0.0))
    net = rigid_motion(meridian, 0).T @ forces @ np.ones(forces.shape[1])
    assert abs(net[0]) < 1e-9 * np.pi * RADIUS**2
    open_below = WallPressure(space, False).generalised(meridian, Around(0, 0.0))
    assert abs(open_below.sum()) > 0.0


def test_a_pressure_that_rises_across_pushes_with_its_gradient_times_the_volume(path):
    """Gauss's theorem of p = x; its moment is that of the volume about its middle."""
    meridian, space = path.wall.shell.meridian, dome()
    forces = WallPressure(space, True).generalised(meridian, Around(1, 0.0))
    pressure = space.nodes[..., 0].ravel()  # r cos θ
    force, moment = rigid_motion(meridian, 1).T @ forces @ pressure
    mass = matrices(space, 0)[1]
    volume = mass.sum()
    assert volume == pytest.approx(np.pi * RADIUS**2 * (DEPTH + 2.0 * CAP / 3.0), rel=1e-5)
    assert force == pytest.approx(volume, rel=2e-3)
    assert moment == pytest.approx(mass.sum(axis=0) @ space.nodes[..., 1].ravel(), rel=5e-3)


@pytest.mark.parametrize("dome_m", [0.04, 0.0])
def test_gas_of_the_dome_ends_a_walls_thickness_below_the_top(path, dome_m):
    """Its rim is that of the cap, or the inner face of a flat one."""
    study = load_study(ROOT / "tests" / "studies" / "sources_made_up.toml")
    shell = study.machine.shell.model_copy(update={"dome_height_m": dome_m})
    dome = DischargeDome(
        depth_m=DEPTH, port_offset_m=0.0, tube_diameter_m=0.01, tube_height_m=0.01,
        quality_ratio=60.0,
    )  # fmt: skip
    machine = study.machine.model_copy(update={"shell": shell, "discharge_dome": dome})
    path.gas.clear()
    profile = spaces_of(machine, path)["discharge_dome"].profile
    top = shell.height_m - shell.centre_of_mass_height_m
    thickness = study.machine.structure.thickness_m
    assert profile.upper[0] == pytest.approx(top - thickness)
    assert profile.upper[-1] == pytest.approx(top - max(dome_m, thickness))
    assert profile.lower == pytest.approx(profile.upper[-1] - DEPTH)
    path.gas.clear()


# --- response ---


def piston_gas_plate(modes):
    """A piston moves a column of gas whose other end is a plate on a spring."""
    length, area, spring_hz, mass = 0.1, 0.01, 300.0, 0.4
    number = np.arange(modes)
    size = np.where(number == 0, 1.0, np.sqrt(2.0)) / np.sqrt(length * area)
    at_plate = area * size * (-1.0) ** number
    column = DrivenGas(
        (np.pi * number / length) ** 2, size, 0.0 * size, at_plate[:, None], 0.0, 1e12
    )
    both = GasAndWall(column, DENSITY, SOUND, np.array([spring_hz]), np.array([mass]), 0.01)
    return both, length, area


@pytest.mark.parametrize(("modes", "median"), [(10, 8e-3), (40, 2e-3), (160, 5e-4)])
def test_piston_gas_and_sprung_plate(modes, median):
    """Against the waves of the column: p = P cos k(L - x) + jρc v sin k(L - x)."""
    both, length, area = piston_gas_plate(modes)
    frequency = np.arange(20.0, 1500.0, 7.0)
    omega = 2.0 * np.pi * frequency
    impedance = 0.4 * ((2.0 * np.pi * 300.0) ** 2 * (1.0 + 0.01j) - omega**2) / (1j * omega)
    k = omega / SOUND
    through = np.cos(k * length) + 1j * impedance / (area * DENSITY * SOUND) * np.sin(k * length)
    expected = 1.0 / through
    moved = both.motion(frequency, area, np.zeros(1))
    error = np.abs(1j * omega * moved[0] / expected - 1.0)
    print(f"{modes} modes: median error {np.median(error):.2e}, largest {error.max():.2e}")
    assert np.median(error) < 1.2 * median


@pytest.fixture(scope="module")
def coupled(path):
    space = GasInShell(dome(), True, path.wall.shell.meridian, path.modes)
    port = Mouth(0.005, RIM - DEPTH, (0.7,))
    gas = space.driven(port, Mouth(RADIUS, RIM - 0.007, (2.9,)), 9e-5, 60.0)
    return GasAndWall(gas, DENSITY, SOUND, path.natural_hz, path.modal_mass_kg, 0.01)


def test_a_source_that_stays_is_as_one_computed_anew(path):
    """Modes with the source are kept from one set of values to the next; another source is not."""
    tube, others = Mouth(RADIUS, RIM - 0.007, (2.9,)), [(0.005, 0.7), (0.005, 1.9), (0.02, 1.9)]
    ports = [Mouth(radius, RIM - DEPTH, (angle,)) for radius, angle in others]
    space = GasInShell(dome(), True, path.wall.shell.meridian, path.modes)
    for port in ports:
        anew = GasInShell(dome(), True, path.wall.shell.meridian, path.modes)
        one, other = space.driven(port, tube, 0.0, 60.0), anew.driven(port, tube, 0.0, 60.0)
        np.testing.assert_allclose(one.at_source, other.at_source, rtol=1e-9, atol=1e-12)
        assert one.on_wall == pytest.approx(other.on_wall, abs=1e-9 * abs(other.on_wall).max())


def test_reciprocity(coupled):
    """Velocity of a mode per flow is minus the pressure at the source per force on the mode."""
    frequency = np.linspace(100.0, 4000.0, 37)
    omega = 2.0 * np.pi * frequency
    count = coupled.natural_hz.size
    moved = coupled.motion(frequency, 1.0, np.zeros(count))
    for wall in range(0, count, 7):
        pushed = coupled.motion(frequency, 0.0, np.eye(count)[wall])
        pressure = coupled.at_source(frequency, 0.0, pushed)
        scale = np.abs(omega * moved[wall]).max()
        assert np.abs(1j * omega * moved[wall] + pressure).max() < 1e-10 * scale


def test_one_way_coupling_is_enough(coupled):
    """Kinetic energy of the wall: in sum and by order around."""
    frequency = np.arange(200.0, 4000.0, 20.0)
    both_ways = np.abs(coupled.motion(frequency, 1.0, np.zeros(coupled.natural_hz.size))) ** 2
    forces = coupled.gas.wall_forces(DENSITY, SOUND, frequency)
    omega = 2.0 * np.pi * frequency
    lossy = (2.0 * np.pi * coupled.natural_hz[:, None]) ** 2 * (1.0 + 0.01j) - omega**2
    one_way = np.abs(forces / (coupled.modal_mass_kg[:, None] * lossy)) ** 2
    energy = coupled.modal_mass_kg[:, None] * omega**2
    change = 10.0 * np.log10((energy * both_ways).sum() / (energy * one_way).sum())
    print(f"two-way less one-way: {change:.2f} dB")
    assert abs(change) < 0.5


def test_tube_is_an_admittance_at_its_mouth(coupled):
    """The closed formula against one dense system; without it the uniform pressure only rises."""
    frequency = np.array([48.3, 720.0, 1941.0])
    gas = coupled.gas
    obtained = gas.of_flow(DENSITY, SOUND, frequency)
    for column, hz in enumerate(frequency):
        omega = 2.0 * np.pi * hz
        squares = SOUND**2 * gas.wavenumber_squared * (1.0 + 1j / 60.0) - omega**2
        mouth = 1j * omega * 9e-5 / (DENSITY * SOUND) * np.outer(gas.at_tube, gas.at_tube)
        system = np.diag(squares / (DENSITY * SOUND**2)) + mouth
        expected = np.linalg.solve(system, 1j * omega * gas.at_source)
        np.testing.assert_allclose(obtained[:, column], expected, rtol=1e-9, atol=1e-6)


def test_slow_flow_raises_the_pressure_of_the_plenum(coupled):
    """p = ρ c² Q/(jω V + S c): what the opening's equations take for it."""
    frequency = np.array([10.0])
    (uniform, *_) = coupled.gas.of_flow(DENSITY, SOUND, frequency)[:, 0]
    volume = matrices(dome(), 0)[1].sum()
    expected = DENSITY * SOUND**2 / (2j * np.pi * 10.0 * volume + 9e-5 * SOUND)
    assert uniform * coupled.gas.at_source[0] == pytest.approx(expected, rel=1e-3)
    assert not coupled.gas.wall_forces(DENSITY, SOUND, np.zeros(1)).any()
