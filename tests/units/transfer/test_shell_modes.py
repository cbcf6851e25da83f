"""Modes of the closed shell: exact theories, three-dimensional elasticity, invariants."""

import csv

import numpy as np
import pytest
import solid_of_revolution as solid
from cylinder_theories import diaphragm_frequencies_hz, donnell_frequencies_hz
from documents import APART, FORM
from evidence import claim
from numpy.polynomial.legendre import leggauss
from pydantic import ValidationError
from scipy.linalg import eigh
from scipy.optimize import brentq
from scipy.special import ive, jv
from shell_response import (
    PointForces,
    dense,
    elastic_flexibility,
    mobility,
    normal_velocity,
    residual_flexibility,
    static_flexibility,
)
from support import ROOT, whole_surface

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.base.revolution import capped_cylinder
from vibroacoustics.machine.shell import Shell
from vibroacoustics.machine.shell_structure import Joint, ShellStructure
from vibroacoustics.radiation.bodies import turned
from vibroacoustics.radiation.patterns import Pattern
from vibroacoustics.transfer.shell_modes.elements import (
    NODE_DOFS,
    matrices,
    strains,
)
from vibroacoustics.transfer.shell_modes.harmonic import Harmonic
from vibroacoustics.transfer.shell_modes.loads import JointLoads, joint_forces
from vibroacoustics.transfer.shell_modes.meridian import Meridian, bending_wavelength_m
from vibroacoustics.transfer.shell_modes.modes import (
    ElasticShell,
    _largest_displacement,
    elastic_shell,
)
from vibroacoustics.transfer.shell_modes.projection import modal_forces, patch_forces
from vibroacoustics.transfer.shell_modes.sampled import SampledMode

PRINTED = ROOT / "data" / "validation" / "shell_modes.csv"
EPS = np.finfo(float).eps
LINE = Joint(height_m=0.0, welds=1)
STEEL = ShellStructure(
    thickness_m=3.2e-3,
    youngs_modulus_pa=2.06e11,
    poisson_ratio=0.3,
    density_kg_per_m3=7850.0,
    loss_factor_ratio=0.01,
    bearing_housing=LINE,
    fixed_scroll=LINE,
    stator=LINE,
)
FLAT = Shell(
    outer_diameter_m=0.165,
    height_m=0.417,
    centre_of_mass_height_m=0.19,
    floor_clearance_m=0.025,
)
DOMED = FLAT.model_copy(update={"dome_height_m": 0.04})
RADIUS = (0.165 - 3.2e-3) / 2.0
SURFACE_MASS = 7850.0 * 3.2e-3
MAXIMUM_HZ = 4500.0


@pytest.fixture(scope="module")
def flat():
    return elastic_shell(FLAT, STEEL, MAXIMUM_HZ)


@pytest.fixture(scope="module")
def domed():
    return elastic_shell(DOMED, STEEL, MAXIMUM_HZ)


def of_order(shell, order):
    """Frequencies of one order, each once."""
    return np.array(
        [
            mode.frequency_hz
            for mode in shell.modes
            if mode.around.order == order and mode.around.angle_rad == 0.0
        ]
    )


def shear_and_rotation(frequency_hz):
    """What Kirchhoff's plates lack, relative to the frequency: (k h)² (1 + 12/(5 (1 - ν))) / 24.

    Second-order term of Mindlin's plate with shear coefficient 5/6.
    """
    wave = 2.0 * np.pi / bending_wavelength_m(STEEL, 1.0) * np.sqrt(frequency_hz)
    return (wave * STEEL.thickness_m) ** 2 * (1.0 + 12.0 / (5.0 * 0.7)) / 24.0


# --- closed forms --------------------------------------------------------------------------------


def test_published_frequencies():
    """Printed to 10 Hz at worst ("about"), and Young's modulus is not: 206 or 207 GPa are alike."""
    lines = PRINTED.read_text(encoding="utf-8").splitlines()[1:]
    for row in csv.DictReader(lines):
        span, order = 1e-3 * float(row["span_mm"]), int(row["circumferential_order"])
        found = diaphragm_frequencies_hz(STEEL, RADIUS, span, order, 1)[0]
        printed = float(row["frequency_hz"])
        claim(
            f"Cylinder of {row['span_mm']} mm by Flügge's theory, order {order}", unit="Hz",
            kind="second code", source=APART("Flügge's theory"), computed=found,
            reference=printed, tolerance=0.003 * printed, topics=("structure",),
        )  # fmt: skip


def test_printed_orders_are_the_lowest_two():
    for span, orders in ((0.38, [2, 3]), (0.3, [3, 2]), (0.2, [3, 4])):
        found = [diaphragm_frequencies_hz(STEEL, RADIUS, span, n, 1)[0] for n in range(1, 9)]
        assert (np.argsort(found)[:2] + 1).tolist() == orders


@pytest.mark.parametrize("order", [2, 3, 4, 6])
def test_long_shell_bends_like_rayleighs_ring(order):
    """ω² = E h² n² (n² - 1)² / (12 ρ (1 - ν²) R⁴ (n² + 1)) at infinite span, to order k n⁴.

    Donnell's theory has n⁴ in place of (n² - 1)².
    """
    n, k = order, STEEL.thickness_m**2 / (12.0 * RADIUS**2)
    speed = np.sqrt(2.06e11 / 7850.0 / 0.91)
    size = np.sqrt(k * n**2 / (n**2 + 1.0)) * speed / (2.0 * np.pi * RADIUS)
    fluegge = diaphragm_frequencies_hz(STEEL, RADIUS, 1e4, n, 1)[0]
    donnell = donnell_frequencies_hz(STEEL, RADIUS, 1e4, n, 1)[0]
    exact = size * (n**2 - 1.0)
    claim(
        f"Long shell by Flügge's theory as a ring, order {n}", kind="exact", unit="Hz",
        source=FORM("Rayleigh's ring"), computed=fluegge, reference=exact,
        tolerance=exact * k * n**4, topics=("structure",),
    )  # fmt: skip
    assert donnell == pytest.approx(size * n**2, rel=k * n**4)


@pytest.mark.parametrize("span", [0.38, 0.3, 0.2])
@pytest.mark.parametrize("order", [2, 3, 4, 5])
def test_donnell_is_too_high_by_up_to_the_rings_excess(span, order):
    """Printed as 1 to 10 %; the ring's n²/(n² - 1) is the most."""
    exact = diaphragm_frequencies_hz(STEEL, RADIUS, span, order, 1)[0]
    excess = donnell_frequencies_hz(STEEL, RADIUS, span, order, 1)[0] / exact
    assert 1.005 < excess < order**2 / (order**2 - 1.0)


def test_torsion_and_axial_families():
    """n = 0: torsion at c_s m / 2L (to 1.5 k), the others coupled by ν; n = 2: far above 4 kHz."""
    shear_speed = np.sqrt(2.06e11 / 2.6 / 7850.0)
    for half_waves in (1, 2):
        found = diaphragm_frequencies_hz(STEEL, RADIUS, 0.38, 0, half_waves)
        k = STEEL.thickness_m**2 / (12.0 * RADIUS**2)
        exact = shear_speed * half_waves / 0.76
        assert np.min(np.abs(found / exact - 1.0)) < 1.51 * k
    assert diaphragm_frequencies_hz(STEEL, RADIUS, 0.38, 2, 1)[1] > 2.5 * 4000.0


# --- elements against exact solutions ------------------------------------------------------------


def between_diaphragms(order, elements, span=0.38):
    """Open cylinder whose ends move neither outwards nor around."""
    heights = np.linspace(0.0, span, elements + 1)
    meridian = Meridian(np.stack([np.full(elements + 1, RADIUS), heights], axis=1))
    stiffness, mass = dense(matrices(meridian, STEEL, order))
    last = NODE_DOFS * elements
    kept = np.setdiff1d(np.arange(len(mass)), [0, 2, last, last + 2])
    at = np.ix_(kept, kept)
    return np.sqrt(np.abs(eigh(stiffness[at], mass[at], eigvals_only=True))) / (2.0 * np.pi)


def sanders_hz(order, half_waves, span=0.38):
    """Exact frequency of Sanders' theory between shear diaphragms.

    Strains of Leissa, Vibration of Shells (1973), table 2.3, on a cylinder for u = A cos λs,
    v = B sin λs, w = C sin λs.
    """
    n, wave, radius, nu = order, half_waves * np.pi / span, RADIUS, 0.3
    even = np.array([[-wave, 0, 0], [0, n / radius, 1 / radius],
                     [0, 0, wave**2], [0, n / radius**2, n**2 / radius**2]])  # fmt: skip
    odd = np.array([[-n / radius, wave, 0],
                    [n / (2 * radius**2), 1.5 * wave / radius, 2 * n * wave / radius]])  # fmt: skip
    stretch = 2.06e11 * 3.2e-3 / (1 - nu**2)
    parts = np.array([[1, nu], [nu, 1]])
    bend = stretch * 3.2e-3**2 / 12
    stiffness = even[:2].T @ parts @ even[:2] * stretch + even[2:].T @ parts @ even[2:] * bend
    stiffness += np.outer(odd[0], odd[0]) * stretch * (1 - nu) / 2
    stiffness += np.outer(odd[1], odd[1]) * bend * (1 - nu) / 2
    return np.sqrt(np.linalg.eigvalsh(stiffness)[0] / SURFACE_MASS) / (2.0 * np.pi)


@pytest.mark.parametrize("order", [1, 2, 3, 5])
def test_elements_give_the_exact_frequencies_of_their_theory(order):
    found = between_diaphragms(order, 40)
    for half_waves in (1, 2, 3):
        # Cubic shapes: (k h)⁴/1440 of a bending frequency, k h = 3π/40 at most, and as much for
        # each of the fields that are coupled; rounding eps |K|/(ω² |M|), 1e-9.
        nearest = found[np.argmin(np.abs(found - sanders_hz(order, half_waves)))]
        assert nearest == pytest.approx(sanders_hz(order, half_waves), rel=1e-5)


def test_frequency_converges_with_the_fourth_power_or_better():
    errors = [between_diaphragms(3, n)[1] / sanders_hz(3, 2) - 1.0 for n in (4, 8)]
    assert errors[0] > errors[1] > 0.0
    assert np.log2(errors[0] / errors[1]) > 3.9


@pytest.mark.parametrize("order", [2, 3])
def test_three_dimensional_elasticity_between_diaphragms(order):
    """Between shear diaphragms, 0.38 m apart: two theories and a solid agree within 1 %.

    Kirchhoff's excess is at most that of the flat plate, since part of the energy is stretching;
    the theories themselves differ from each other by terms of (h/R) (h/R) n².
    """
    strip = solid.open_cylinder(RADIUS, 0.38, 3.2e-3, 0.03)
    exact = solid.frequencies_hz(strip, order, 2.06e11, 0.3, 7850.0, 1, diaphragms=True)[0]
    fluegge = diaphragm_frequencies_hz(STEEL, RADIUS, 0.38, order, 1)[0]
    spread = (order * STEEL.thickness_m / RADIUS) ** 2
    for found in (fluegge, between_diaphragms(order, 40)[0]):
        assert -spread < found / exact - 1.0 < shear_and_rotation(exact) + spread
        assert found == pytest.approx(exact, rel=0.01)
    assert fluegge == pytest.approx(between_diaphragms(order, 40)[0], rel=spread)


@pytest.mark.parametrize("order", [0, 1, 2, 3])
def test_clamped_disc(order):
    """J_n(x) I_n'(x) = I_n(x) J_n'(x) (Leissa, Vibration of Plates, 1969, eq. 2.2)."""

    def equation(x):
        return jv(order, x) * ive(order + 1, x) + ive(order, x) * jv(order + 1, x)

    roots = np.array([brentq(equation, x, x + 0.25) for x in np.arange(1.0, 12.0, 0.25)
                      if equation(x) * equation(x + 0.25) < 0.0])[:2]  # fmt: skip
    bending = 2.06e11 * 3.2e-3**3 / 12.0 / 0.91
    exact = (roots / 0.08) ** 2 * np.sqrt(bending / SURFACE_MASS) / (2.0 * np.pi)
    radius = np.linspace(0.0, 0.08, 25)
    harmonic = Harmonic(Meridian(np.stack([radius, np.zeros(25)], axis=1)), STEEL, order)
    stiffness, mass = dense(harmonic.free_matrices)
    edge = 24 * NODE_DOFS + np.arange(NODE_DOFS)
    kept = np.flatnonzero(~np.isin(harmonic.kept, edge))
    at = np.ix_(kept, kept)
    found = np.sqrt(eigh(stiffness[at], mass[at], eigvals_only=True)) / (2.0 * np.pi)
    # (k h)⁴/1440 with k h = 9.2/24: 1.5e-5
    assert found[:2] == pytest.approx(exact, rel=2e-5)


@pytest.mark.parametrize("order", range(7))
def test_domed_shell_against_three_dimensional_elasticity(domed, order):
    """Up to 4.5 kHz, caps included, within 1 %: what Kirchhoff's shell lacks.

    The dome's straight pieces, doubled in number, change a frequency by 1.2e-3 at most, upwards.
    """
    strip = solid.domed(0.0825, 0.417, 0.04, 3.2e-3, 0.02)
    found = of_order(domed, order)
    exact = solid.frequencies_hz(strip, order, 2.06e11, 0.3, 7850.0, found.size + 3)
    exact = exact[exact > 50.0][: found.size]
    excess = found / exact - 1.0
    assert np.all(excess > 0.0)
    assert np.all(excess < shear_and_rotation(exact) + 1.2e-3)
    assert np.all(excess < 0.01)


@pytest.mark.parametrize("order", range(6))
def test_flat_caps_against_three_dimensional_elasticity(flat, order):
    """The sharp corner: caps bend freely up to the wall's middle surface, really up to its inside.

    A cap's frequency goes with 1/R²: low by h/R at most. The solid's corner errs by 2e-3.
    """
    strip = solid.flat_capped(0.0825, 0.417, 3.2e-3, 0.006)
    found = of_order(flat, order)
    exact = solid.frequencies_hz(strip, order, 2.06e11, 0.3, 7850.0, found.size + 3)
    exact = exact[exact > 50.0][: found.size]
    assert np.all(found / exact - 1.0 > -3.2e-3 / RADIUS)
    assert np.all(found / exact - 1.0 < shear_and_rotation(exact))
    if order in (2, 3):
        assert found[0] == pytest.approx(exact[0], rel=0.0025)


# --- invariants ----------------------------------------------------------------------------------


@pytest.mark.parametrize("order", [0, 1])
@pytest.mark.parametrize("shell", ["flat", "domed"])
def test_rigid_motions_have_no_strain(shell, order, request):
    body = request.getfixturevalue(shell)
    harmonic = body.harmonics[order]
    motions = harmonic.reduction @ harmonic.rigid_motions
    stiffness, _ = dense(matrices(body.meridian, STEEL, order))
    size = np.abs(stiffness).max() * np.abs(motions).max() ** 2
    assert np.abs(motions.T @ stiffness @ motions).max() < 100.0 * EPS * size
    assert harmonic.rigid_motions.shape[1] == 2


def test_mass_of_the_flat_capped_shell(flat):
    """Wall and caps of the middle surface: 2πRL + 2πR², in translation along z and x."""
    height = 0.417 - 3.2e-3
    mass = SURFACE_MASS * 2.0 * np.pi * RADIUS * (height + RADIUS)
    axial, sideways = (flat.harmonics[order] for order in (0, 1))
    for harmonic, freedoms in ((axial, {1: 1.0}), (sideways, {0: 1.0, 2: -1.0})):
        _, mass_matrix = dense(matrices(flat.meridian, STEEL, harmonic.order))
        motion = np.zeros(len(mass_matrix))
        for freedom, value in freedoms.items():
            motion[freedom : NODE_DOFS * (flat.meridian.elements + 1) : NODE_DOFS] = value
        assert motion @ mass_matrix @ motion == pytest.approx(mass, rel=1e-12)


def test_modes_are_orthogonal_and_not_rigid(flat):
    """In mass and in stiffness, and to the rigid motions: nothing is counted twice.

    Rounding of the eigenvalues is eps times the largest one of the elements, over the least kept.
    """
    for harmonic in flat.harmonics:
        frequencies, shapes = harmonic.modes(MAXIMUM_HZ)
        stiffness, mass = dense(matrices(flat.meridian, STEEL, harmonic.order))
        largest = eigh(*dense(harmonic.free_matrices), eigvals_only=True)[-1]
        squares = (2.0 * np.pi * frequencies) ** 2
        assert np.abs(shapes.T @ mass @ shapes - np.eye(squares.size)).max() < 1e-11
        rounding = 10.0 * EPS * largest
        assert np.abs(shapes.T @ stiffness @ shapes - np.diag(squares)).max() < rounding
        assert rounding < 1e-2 * squares.min()
        rigid = harmonic.reduction @ harmonic.rigid_motions
        assert np.abs(rigid.T @ mass @ shapes).max(initial=0.0) < 1e-10


def quadrature(meridian):
    """Points on the middle surface with their areas: Gauss along each element, even around."""
    place, weight = leggauss(4)
    share = (place + 1.0) / 2.0
    start, step = meridian.nodes[:-1, None], np.diff(meridian.nodes, axis=0)[:, None]
    along = (start + share[:, None] * step).reshape(-1, 2)
    line = (weight / 2.0 * meridian.lengths[:, None]).ravel()
    angle = 2.0 * np.pi * np.arange(16) / 16
    radius, height = np.repeat(along, 16, axis=0).T
    angle = np.tile(angle, along.shape[0])
    area = np.repeat(line * along[:, 0] * 2.0 * np.pi / 16, 16)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), height], axis=1), area


def test_surface_velocities_carry_the_modal_mass_and_no_momentum(flat):
    """By integration of the velocities that radiate over the whole surface.

    Modal mass 2 T / v², no momentum, no moment of momentum. Four Gauss points are exact for
    products of cubics with r, 16 around for those of orders up to 6 and x.
    """
    points, area = quadrature(flat.meridian)
    velocities = np.array([mode.velocity(points) for mode in flat.modes])
    masses = np.array([mode.modal_mass_kg for mode in flat.modes])
    shares = SURFACE_MASS * area
    gram = np.einsum("p,apk,bpk->ab", shares, velocities, velocities, optimize=True)
    scale = np.sqrt(np.outer(masses, masses))
    assert np.abs(gram / scale - np.eye(masses.size)).max() < 1e-9
    total = shares.sum()
    momentum = np.einsum("p,apk->ak", shares, velocities)
    turning = np.einsum("p,apk->ak", shares, np.cross(points, velocities))
    assert np.abs(momentum).max() < 1e-10 * total
    assert np.abs(turning).max() < 1e-10 * total * 0.2
    # The amplitude is a node's; a wave of ten elements rises (2π/10)²/8 = 5 % above it.
    # A twin has its largest motion at angles that may lie between ours.
    size = np.linalg.norm(velocities, axis=2).max(axis=1)
    assert size.max() < 1.05
    assert (
        min(s for s, mode in zip(size, flat.modes, strict=True) if not mode.around.angle_rad) > 0.95
    )


def test_twins_are_the_same_mode_turned(flat):
    rng = np.random.default_rng(1)
    points = rng.uniform(-1.0, 1.0, (50, 3)) * [RADIUS, RADIUS, 0.18]
    for cosine, sine in zip(flat.modes[:-1], flat.modes[1:], strict=True):
        if sine.around.name != "sin":
            continue
        assert cosine.name[:-3] == sine.name[:-3]
        assert cosine.frequency_hz == sine.frequency_hz
        angle = sine.around.angle_rad
        turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0],
                         [0, 0, 1]])  # fmt: skip
        turned = cosine.velocity(points) @ turn.T
        assert np.abs(sine.velocity(points @ turn.T) - turned).max() < 1e-12


def test_radiating_body_takes_a_mode_as_its_pattern(flat):
    """On the polygon of 128 sides outside the middle surface."""
    body = turned(
        capped_cylinder(FLAT.cylinder.radius_m, -FLAT.centre_of_mass_height_m, 0.417 - 0.19)
    )
    at = whole_surface(body, (np.linspace(-0.3, 0.3, 25),) * 3)
    oval = next(mode for mode in flat.modes if mode.name == "n2_1_cos")
    drum = next(mode for mode in flat.modes if mode.name == "n0_1_all")
    patterns = [Pattern(mode.name, lambda at, m=mode: m.velocity(at.position))
                for mode in (oval, drum)]  # fmt: skip
    normal = [np.einsum("pi,pi->p", pattern.velocity(at), at.normal) for pattern in patterns]
    assert normal[0] == pytest.approx(normal_velocity(oval, at.position, at.normal), abs=1e-14)
    wall = np.abs(at.normal[:, 2]) < 0.5
    # One half wave that the caps hold, about.
    height = at.position[wall, 2] + 0.19 - 0.417 / 2.0
    angle = np.arctan2(at.position[wall, 1], at.position[wall, 0])
    shape = np.cos(2.0 * angle) * np.cos(np.pi * height / 0.417)
    assert np.corrcoef(normal[0][wall], shape)[0, 1] > 0.99
    # Volume velocity: none of the oval; of the drum as from the middle surface, whose caps and wall
    # are smaller by the thickness: by 2 h/R at most.
    volume = [at.area @ velocity for velocity in normal]
    # Rule of three points on pieces of 25 mm at most, k h = 0.2: (k h)⁴/1000.
    assert abs(volume[0]) < 2e-6 * at.area.sum()
    points, area = quadrature(flat.meridian)
    outwards = np.stack([points[:, 0], points[:, 1], 0.0 * area], axis=1) / RADIUS
    low, high = flat.meridian.wall_heights_m
    for end, side in ((low, -1.0), (high, 1.0)):
        outwards[np.abs(points[:, 2] - end) < 1e-9] = [0.0, 0.0, side]
    middle = area @ normal_velocity(drum, points, outwards)
    assert volume[1] == pytest.approx(middle, rel=2.0 * 3.2e-3 / RADIUS)


def test_sign_of_a_mode_does_not_depend_on_rounding(flat):
    """Both caps of a symmetric shell move alike: noise and sign of the solver change no shape."""
    frequencies, shapes = Harmonic(flat.meridian, flat.structure, 0).modes(3000.0)
    size = _largest_displacement(flat.meridian, shapes)
    parts = np.sort(np.abs(shapes / size), axis=0)
    assert np.any(parts[-2] > 1.0 - 1e-9)  # of two that move most the solver's noise chooses one
    generator = np.random.default_rng(2)
    for _ in range(8):
        noise = 1.0 + 1e-10 * generator.standard_normal(shapes.shape)
        turned = shapes * noise * generator.choice([-1.0, 1.0], frequencies.size)
        again = turned / _largest_displacement(flat.meridian, turned)
        np.testing.assert_allclose(again, shapes / size, atol=1e-8)


def test_orders_that_are_left_out_have_no_mode(flat):
    for order in (len(flat.harmonics), len(flat.harmonics) + 1):
        harmonic = Harmonic(flat.meridian, STEEL, order)
        assert harmonic.modes(MAXIMUM_HZ)[0].size == 0
    assert Harmonic(flat.meridian, STEEL, 6).modes(MAXIMUM_HZ)[0].size > 0


def test_a_round_section_only_raises_frequencies(flat):
    """Rayleigh's theorem on constraints; a free span lies above the same span between diaphragms,
    which the wall beyond it can only stiffen."""
    held = elastic_shell(FLAT, STEEL.model_copy(update={"span_m": 0.3}), MAXIMUM_HZ)
    for order in range(7):
        free, fixed = of_order(flat, order), of_order(held, order)
        # Meshes differ by one element: (k h)⁴/1440, below 1e-5 twice.
        assert np.all(fixed >= free[: fixed.size] * (1.0 - 2e-5))
    assert of_order(held, 0) == pytest.approx(of_order(flat, 0), rel=2e-5)
    for order in (2, 3, 4):
        simple = diaphragm_frequencies_hz(STEEL, RADIUS, 0.3, order, 1)[0]
        assert simple < of_order(held, order)[0] < 1.25 * simple


# --- forces --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "joint",
    [
        Joint(height_m=0.11, welds=3, first_angle_rad=0.3, spread_rad=0.25),
        Joint(height_m=-0.02, band_m=0.06, welds=1, first_angle_rad=-1.0, spread_rad=6.0),
        Joint(height_m=0.05, welds=4),
    ],
)
def test_joint_is_the_sum_of_forces_at_points(flat, joint):
    """Closed form around against 32 Gauss points, exact to rounding for 7 x 6 rad; both take the
    same heights."""
    points, forces = joint_forces(joint, RADIUS)
    assert forces.sum(axis=0)[:, :3] == pytest.approx(np.eye(3), abs=1e-14)
    moment = np.cross(points, np.moveaxis(forces, 1, 2).swapaxes(0, 1)).sum(axis=1)
    assert moment[3, 2] == pytest.approx(1.0)
    expected = [np.einsum("pi,pil->l", mode.velocity(points), forces) for mode in flat.modes]
    found = modal_forces(flat, JointLoads(joint))
    assert np.abs(found - expected).max() < 1e-12 * np.abs(expected).max()


def test_equal_forces_on_the_welds_are_the_load_of_their_joint(flat):
    """x̂ = r̂ cos θ - θ̂ sin θ and ŷ = r̂ sin θ + θ̂ cos θ at each weld; a torque has the arm R."""
    joint = Joint(height_m=0.11, welds=3, first_angle_rad=0.3)
    angle = 0.3 + 2.0 * np.pi * np.arange(3) / 3.0
    cos, sin, none = np.cos(angle), np.sin(angle), np.zeros(3)
    arm = np.full(3, 1.0 / flat.meridian.wall_radius_m)
    loads = np.array([
        [cos, none, -sin], [sin, none, cos], [none, none + 1.0, none], [none, none, arm],
    ])  # fmt: skip
    shares = loads.transpose(2, 1, 0).reshape(9, 4) / 3.0
    expected = modal_forces(flat, JointLoads(joint))
    found = patch_forces(flat, joint) @ shares
    assert np.abs(found - expected).max() < 1e-12 * np.abs(expected).max()


def test_band_is_the_mean_over_its_height(flat):
    """Midpoint rule: (k 1.5 mm)²/24 = 4e-4 with k of 1/15 mm⁻¹ at 4.5 kHz."""
    banded = modal_forces(flat, JointLoads(Joint(height_m=0.05, band_m=0.06, welds=4)))
    heights = 0.02 + 0.06 * (np.arange(40) + 0.5) / 40
    lines = [modal_forces(flat, JointLoads(Joint(height_m=float(z), welds=4))) for z in heights]
    assert np.abs(banded - np.mean(lines, axis=0)).max() < 4e-4 * np.abs(banded).max()


def driven_orders(shell, joint):
    """Orders around that each unit load drives."""
    forces = modal_forces(shell, JointLoads(joint))
    return [
        {mode.around.order for mode, force in zip(shell.modes, column, strict=True)
         if abs(force) > 1e-12}
        for column in forces.T
    ]  # fmt: skip


def test_orders_that_welds_drive(flat):
    """A sideways force at N welds drives n = |1 ± k N|, an axial one and a torque n = k N."""
    everywhere = Joint(height_m=0.1, welds=3, spread_rad=2.0 * np.pi / 3.0)
    assert driven_orders(flat, everywhere) == [{1}, {1}, {0}, {0}]
    three = Joint(height_m=0.1, welds=3, first_angle_rad=0.2, spread_rad=0.3)
    assert driven_orders(flat, three) == [{1, 2, 4, 5}, {1, 2, 4, 5}, {0, 3, 6}, {0, 3, 6}]
    four = three.model_copy(update={"welds": 4})
    assert driven_orders(flat, four) == [{1, 3, 5}, {1, 3, 5}, {0, 4}, {0, 4}]


def test_pinched_ring():
    """Two forces inwards across a thin ring, Poisson's ratio 0 (Timoshenko, Strength of Materials).

    Each order: w = 2 F R³ / (π E I (n² - 1)²) per force pair at both ends; the stretching that the
    formula leaves out is (h/R)²/12 of it.
    """
    ring = STEEL.model_copy(update={"poisson_ratio": 0.0, "thickness_m": 8e-4})
    width = 2e-3
    meridian = Meridian(np.stack([np.full(5, RADIUS), np.linspace(0.0, width, 5)], axis=1))
    shell = ElasticShell(ring, meridian, 2000.0)
    ends = PointForces(
        np.array([[RADIUS, 0.0, width / 2.0], [-RADIUS, 0.0, width / 2.0]]),
        np.array([[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]),
    )
    found = static_flexibility(shell, ends, ends).sum()  # closing of the diameter per force
    second_moment = width * ring.thickness_m**3 / 12.0
    orders = np.arange(2, len(shell.harmonics), 2)
    assert orders.size >= 4
    series = 4.0 / np.pi * np.sum(1.0 / (orders**2 - 1.0) ** 2)
    expected = series * RADIUS**3 / (ring.youngs_modulus_pa * second_moment)
    assert found == pytest.approx(expected, rel=1e-4)
    # All orders: π/4 - 2/π = 0.1488 of F R³/(E I)
    assert series == pytest.approx(np.pi / 4.0 - 2.0 / np.pi, rel=2e-3)


POINTS = np.array([[RADIUS, 0.0, 0.1], [0.0, RADIUS, 0.02], [0.03, 0.02, 0.2254]])
DIRECTIONS = np.array([[0.8, 0.0, 0.6], [0.0, 1.0, 0.0], [0.0, 0.6, 0.8]])
PLACES = PointForces(POINTS, DIRECTIONS)
WELDED = JointLoads(Joint(height_m=0.11, band_m=0.02, welds=3, spread_rad=0.2))


def test_static_solution_leaves_out_the_rigid_motion_only(flat):
    """K u = g - M R Rᵀ g and Rᵀ M u = 0 define it."""
    for harmonic in flat.harmonics:
        around = flat.arounds(harmonic.order)[0]
        load = PLACES.generalised(flat.meridian, around)
        moved = elastic_flexibility(harmonic, load, MAXIMUM_HZ)
        free = moved[harmonic.kept]
        stiffness, mass = dense(harmonic.free_matrices)
        momentum = mass @ harmonic.rigid_motions
        given = harmonic.reduction.T @ load
        left = given - momentum @ (harmonic.rigid_motions.T @ given)
        rounding = 1e3 * EPS * np.abs(stiffness).max() * np.abs(free).max()
        assert np.abs(stiffness @ free - left).max() < rounding
        assert rounding < 0.02
        assert np.abs(momentum.T @ free).max(initial=0.0) < 1e-9 * np.abs(free).max()


def test_all_modes_together_are_the_static_solution(flat):
    """Every mode of the elements, to the last: Σ φ φᵀ / ω²."""
    for order in (0, 1, 3):
        harmonic = flat.harmonics[order]
        load = PLACES.generalised(flat.meridian, flat.arounds(order)[0])
        squares, shapes = eigh(*dense(harmonic.free_matrices))
        rigid = harmonic.rigid_motions.shape[1]
        driven = shapes[:, rigid:].T @ harmonic.reduction.T @ load
        modal = driven.T / squares[rigid:] @ driven
        direct = load.T @ elastic_flexibility(harmonic, load, MAXIMUM_HZ)
        assert np.abs(modal - direct).max() < 1e-6 * np.abs(direct).max()


@pytest.mark.parametrize("frequency", [1e-3, 100.0, 838.0, 2000.0])
def test_mobility_against_the_direct_solution(flat, frequency):
    """(K (1 + jη) - ω² M)⁻¹ less the rigid motion.

    A mode above f_max lacks 1/(1 - (f/f_r)²) of its flexibility; by Cauchy and Schwarz all of them
    less than (f/f_max)² / (1 - (f/f_max)²) of the root of both places' own residuals.
    """
    omega = 2.0 * np.pi * frequency
    direct = np.zeros((3, 4), dtype=complex)
    for harmonic in flat.harmonics:
        stiffness, mass = dense(harmonic.free_matrices)
        momentum = mass @ harmonic.rigid_motions
        shift = (2.0 * np.pi * MAXIMUM_HZ) ** 2
        held = (stiffness + shift * momentum @ momentum.T) * (1.0 + 0.01j)
        for around in flat.arounds(harmonic.order):
            load = harmonic.reduction.T @ WELDED.generalised(flat.meridian, around)
            response = harmonic.reduction.T @ PLACES.generalised(flat.meridian, around)
            load -= momentum @ (harmonic.rigid_motions.T @ load)
            direct += 1j * omega * response.T @ np.linalg.solve(held - omega**2 * mass, load)
    found = mobility(flat, PLACES, WELDED, np.array([frequency]))[..., 0]
    own = [np.diag(residual_flexibility(flat, load, load)) for load in (PLACES, WELDED)]
    share = (frequency / MAXIMUM_HZ) ** 2
    allowed = omega * share / (1.0 - share) * np.sqrt(np.outer(*own))
    assert np.all(np.abs(found - direct) < allowed + 1e-6 * np.abs(direct).max(axis=0))


def test_reciprocity_of_force_and_surface_velocity(flat):
    """Velocity of the surface that radiates, driven at a joint, against the joint driven there."""
    frequency = np.array([500.0, 838.0, 1500.0, 3000.0])
    lossy = 1.0 + 1j * STEEL.loss_factor_ratio
    there = np.zeros((3, 4, 4), dtype=complex)
    for mode, forces in zip(flat.modes, modal_forces(flat, WELDED), strict=True):
        omega = 2.0 * np.pi * frequency
        dynamic = (2.0 * np.pi * mode.frequency_hz) ** 2 * lossy - omega**2
        velocity = np.einsum("pi,pi->p", mode.velocity(POINTS), DIRECTIONS)
        there += np.einsum(
            "p,l,f->plf", velocity, forces, 1j * omega / mode.modal_mass_kg / dynamic
        )
    back = mobility(flat, WELDED, PLACES, frequency)
    rest = mobility(flat, PLACES, WELDED, frequency) - there
    # The residual is a spring: imaginary but for its loss, and grows as the frequency.
    assert np.abs(back.transpose(1, 0, 2) - there - rest).max() < 1e-12 * np.abs(back).max()
    spring = rest / (1j * 2.0 * np.pi * frequency) * lossy
    assert np.abs(spring - spring[..., :1]).max() < 1e-9 * np.abs(there).max()
    assert np.abs(spring.imag).max() < 1e-9 * np.abs(spring.real).max()


def test_strain_energy_of_a_mode_is_its_kinetic_energy(domed):
    """ω² m = ∫ strain energy by Gauss points of the test's own, twice as many."""
    mode = domed.modes[0]
    place, weight = leggauss(12)
    meridian = domed.meridian
    element = np.repeat(np.arange(meridian.elements), 12)
    place, weight = np.tile(place, meridian.elements), np.tile(weight, meridian.elements)
    amplitudes = mode.shape[_dofs(meridian)[element]]
    strain = np.einsum(
        "pai,pi->pa", strains(meridian, element, place, mode.around.order), amplitudes
    )
    start, end = meridian.nodes[element, 0], meridian.nodes[element + 1, 0]
    area = np.pi * weight * meridian.lengths[element] / 2.0
    area *= (start + end) / 2.0 + place * (end - start) / 2.0
    stretch = 2.06e11 * 3.2e-3 / 0.91
    energy = 0.0
    for first, factor in ((0, stretch), (3, stretch * 3.2e-3**2 / 12.0)):
        a, b, c = strain[:, first : first + 3].T
        energy += factor * np.sum(area * (a**2 + b**2 + 0.6 * a * b + 0.35 * c**2))
    assert energy == pytest.approx(
        mode.modal_mass_kg * (2.0 * np.pi * mode.frequency_hz) ** 2, rel=1e-7
    )


def _dofs(meridian):
    first = np.arange(meridian.elements)[:, None]
    inner = NODE_DOFS * (meridian.elements + 1) + 4 * first + np.arange(4)
    return np.concatenate([NODE_DOFS * first + np.arange(8), inner], axis=1)


# --- modes known at nodes ------------------------------------------------------------------------


def test_mode_sampled_at_nodes(flat):
    """Exact at the nodes; between nodes 9 mm apart as good as a wave of 200 mm is resolved."""
    angle, height = np.meshgrid(2.0 * np.pi * np.arange(60) / 60, np.linspace(-0.18, 0.22, 46))
    angle, height = angle.ravel(), height.ravel()
    nodes = np.stack([RADIUS * np.cos(angle), RADIUS * np.sin(angle), height], axis=1)
    mode = flat.modes[0]
    sampled = SampledMode("measured", 835.0, mode.modal_mass_kg, nodes, mode.velocity(nodes))
    assert np.abs(sampled.velocity(nodes[::7]) - mode.velocity(nodes[::7])).max() < 1e-9
    angle, height = angle[::5] + np.pi / 60.0, height[::5] * 0.95
    between = np.stack([RADIUS * np.cos(angle), RADIUS * np.sin(angle), height], axis=1)
    assert np.abs(sampled.velocity(between) - mode.velocity(between)).max() < 0.02
    driven = modal_forces(flat, WELDED)[0]
    assert np.abs(sampled.modal_forces(WELDED.joint, RADIUS) - driven).max() < 0.02


def test_sampled_mode_needs_places_of_its_own():
    with pytest.raises(ParameterError, match="mode a: nodes"):
        SampledMode("a", 1.0, 1.0, np.zeros((3, 3)), np.zeros((2, 3)))
    with pytest.raises(ParameterError, match="two nodes"):
        SampledMode("a", 1.0, 1.0, np.zeros((2, 3)), np.zeros((2, 3)))


# --- bad input -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("shell", "change", "words"),
    [
        (FLAT, {"span_m": 0.4138}, "span_mm = 413.8 mm: must be below 413.8 mm"),
        (DOMED, {"span_m": 0.38}, "span_mm = 380 mm: must be below 337 mm"),
        (FLAT, {"thickness_m": 0.02}, "thickness_mm = 20 mm: wall of 145 mm diameter"),
    ],
)
def test_shell_that_does_not_fit(shell, change, words):
    with pytest.raises(ParameterError, match=words):
        elastic_shell(shell, STEEL.model_copy(update=change), 1000.0)


@pytest.mark.parametrize("frequency", [0.0, -1.0, np.inf, np.nan])
def test_frequency_must_be_above_zero(frequency):
    with pytest.raises(ParameterError, match=r"maximum_frequency_hz = .* Hz: must be above zero"):
        elastic_shell(FLAT, STEEL, frequency)


def test_too_many_waves_around():
    thin = STEEL.model_copy(update={"thickness_m": 2e-4})
    with pytest.raises(ParameterError, match="more than 64 waves around"):
        ElasticShell(thin, Meridian(np.array([[0.5, 0.0], [0.5, 1.0]])), 1e4).harmonics  # noqa: B018


def test_joint_beyond_the_wall(flat):
    with pytest.raises(ParameterError, match=r"height_mm = 220 mm .* from -188.4 to 225.4 mm"):
        modal_forces(flat, JointLoads(Joint(height_m=0.22, band_m=0.02, welds=3)))


@pytest.mark.parametrize(
    ("field", "value"),
    [("welds", 0), ("band_m", -0.01), ("spread_rad", 7.0), ("height_m", np.nan)],
)
def test_joint_out_of_range(field, value):
    with pytest.raises(ValidationError, match=field):
        Joint(**{"height_m": 0.1, "welds": 3, field: value})


def test_welds_that_do_not_fit_around():
    with pytest.raises(ValidationError, match=r"4 welds cover 458\.366 °; at most 360 °"):
        Joint(height_m=0.1, welds=4, spread_rad=2.0)
    with pytest.raises(ValidationError, match=r"4 welds cover 360\.36 °"):
        Joint(height_m=0.1, welds=4, spread_rad=1.001 * 0.5 * np.pi)
    assert Joint(height_m=0.1, welds=4, spread_rad=0.5 * np.pi).welds == 4
