"""Ground and barrier against tabled values, closed forms, quadrature and a second method."""

from types import SimpleNamespace

import numpy as np
import pytest
from documents import ABRAMOWITZ, SECOND
from evidence import claim
from scipy.integrate import quad
from scipy.special import hankel1, j0
from support import TINY

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.base.revolution import capped_cylinder
from vibroacoustics.radiation.box import closed_box
from vibroacoustics.radiation.exact import Mirror, green
from vibroacoustics.radiation.outdoors.barrier import Barrier, diffracted
from vibroacoustics.radiation.outdoors.green import (
    Outdoors,
    normalised_impedance,
    reflection_coefficient,
)
from vibroacoustics.radiation.revolution.mesh import mesh
from vibroacoustics.radiation.revolution.radiator import WallPressure
from vibroacoustics.radiation.revolution.sampling import over_ground
from vibroacoustics.radiation.transfer_vectors import transfer_vectors
from vibroacoustics.study.loading import load_study
from vibroacoustics.study.receivers import Receiver

FLOOR = Mirror(axis=2, sign=-1, position_m=0.0)
PASTURE, SNOW = Outdoors(0.0, 200e3), Outdoors(0.0, 12.5e3)
FAR = np.array([4.0, 0.0, 1.5])


def by_quadrature(outdoors, height_m, receiver, hertz):
    """Sommerfeld's integral over wavenumbers along the ground, exact for local reaction."""
    k, beta = 2.0 * np.pi * hertz / 343.0, outdoors.admittance(hertz)
    across, above = np.hypot(*receiver[:2]), receiver[2] + height_m

    def travelling(angle):
        kz = 1j * k * np.cos(angle)
        return j0(k * np.sin(angle) * across) * np.exp(-kz * above) * np.sin(angle) / (
            1j * np.cos(angle) + 1j * beta
        ) / 1j  # fmt: skip

    def staying(s):
        return j0(k * np.cosh(s) * across) * np.exp(-k * np.sinh(s) * above) * np.cosh(s) / (
            np.sinh(s) + 1j * beta
        )  # fmt: skip

    end = np.arcsinh(40.0 / (k * above))
    correction = integral(travelling, np.pi / 2.0) + integral(staying, end)
    point = np.array([[0.0, 0.0, height_m]])
    hard = green(point, receiver, np.array([hertz]), [FLOOR])[0, 0]
    return hard - 2j * k * beta * correction / (4.0 * np.pi)


def integral(function, end):
    """From zero, real and imaginary part."""
    real = quad(lambda x: function(x).real, 0.0, end, limit=800)[0]
    return real + 1j * quad(lambda x: function(x).imag, 0.0, end, limit=800)[0]


def decibels(one, other):
    return 20.0 * np.log10(np.abs(one / other))


def test_miki_as_printed():
    """1 + 0.070 (f/σ)^-0.632 - j 0.107 (f/σ)^-0.632, to the printed digits."""
    for ratio in (1e-4, 1e-3, 1e-2, 0.1, 1.0):
        expected = 1.0 + (0.070 - 0.107j) * ratio**-0.632
        assert normalised_impedance(np.array(500.0), 500.0 / ratio) == pytest.approx(
            expected, rel=3e-3
        )


@pytest.mark.parametrize(
    ("at", "value"),  # w(z), Abramowitz and Stegun, Table 7.9
    [(1.0, 0.3047442 + 0.2082189j), (0.5, 0.5331567 + 0.2304883j)],
)
def test_boundary_loss_factor_by_tabled_error_functions(at, value):
    """R = 0 where cos θ = β: then Q is F alone, at w = (1 + j) at."""
    given = reflection_coefficient(4.0, 0.5, np.array(at**2), np.array(0.5))
    expected = 1.0 + 1j * np.sqrt(np.pi) * (1.0 + 1.0j) * at * value
    claim(
        f"Boundary loss factor at w = (1 + j) {at:g}", kind="printed", unit="1", tolerance=3e-7,
        source=ABRAMOWITZ("table 7.9"), computed=np.conj(given), reference=expected,
        topics=("ground",),
    )  # fmt: skip


def test_limits_of_the_reflection():
    hard = reflection_coefficient(10.0, 0.0, np.array([3.0]), np.array([0.3]))
    plane = reflection_coefficient(1e5, 0.1 + 0.1j, np.array([1e3]), np.array([0.8]))
    assert hard[0] == 1.0
    assert plane[0] == pytest.approx((0.7 - 0.1j) / (0.9 + 0.1j), abs=1e-6)


@pytest.mark.parametrize(("outdoors", "most_db"), [(PASTURE, 0.09), (SNOW, 0.45)])
def test_monopole_over_ground_by_quadrature(outdoors, most_db):
    for hertz in (50.0, 250.0, 1000.0):
        differences = []
        for height in (0.05, 0.3, 1.0):
            for receiver in (np.array([1.0, 0.0, 0.3]), FAR, np.array([10.0, 0.0, 1.5])):
                point = np.array([[0.0, 0.0, height]])
                given = outdoors.green(point, receiver, hertz)[0]
                exact = by_quadrature(outdoors, height, receiver, hertz)
                differences.append(decibels(given, exact))
        claim(
            f"Monopole over ground of {1e-3 * outdoors.flow_resistivity_pa_s_per_m2:g} kPa s/m², "
            f"{hertz:g} Hz", kind="second code", computed=differences, reference=0.0, unit="dB",
            source=SECOND("Sommerfeld's integral, test_outdoors"), tolerance=most_db,
            topics=("ground",),
        )  # fmt: skip


@pytest.mark.parametrize("outdoors", [PASTURE, SNOW])
def test_vertical_dipole_over_ground_by_quadrature(outdoors):
    """Two monopoles 10 mm apart, one against the other; also that ground undoes its mirror."""
    for hertz in (50.0, 250.0, 1000.0):
        for height in (0.05, 0.4):
            pair = np.array([[0.0, 0.0, height + 0.005], [0.0, 0.0, height - 0.005]])
            given = -np.diff(outdoors.green(pair, FAR, hertz))[0]
            exact = -np.diff([by_quadrature(outdoors, z, FAR, hertz) for z in pair[:, 2]])[0]
            assert abs(decibels(given, exact)) < 0.2
        if hertz == 50.0:
            hard = -np.diff(green(pair, FAR, np.array([hertz]), [FLOOR])[0])[0]
            assert decibels(exact, hard) > 0.5


@pytest.mark.parametrize("height", [0.08, 0.2, 0.35])
def test_monopole_in_the_body_by_quadrature(height):
    """Its field over the hard floor, on the wall of a cylinder, brings that over the ground."""
    shape = mesh(capped_cylinder(0.08, 0.03, 0.42, 0.0), 0.02, 1)
    source = np.array([0.0, 0.0, height])
    nodes = np.insert(shape.points, 1, 0.0, axis=1)
    normals = np.insert(shape.normals, 1, 0.0, axis=1)
    scene = SimpleNamespace(outdoors=PASTURE, walls=(FLOOR,), upright_walls=())
    for hertz in (50.0, 250.0, 1000.0):
        table, k = np.array([hertz]), 2.0 * np.pi * hertz / 343.0
        pressure, beside = (
            green(nodes + offset * normals, source, table, [FLOOR])[0] for offset in (0.0, 1e-5)
        )
        velocity = (beside - pressure) / 1e-5 / (-1j * k * 343.0 * 1.2)
        column = SimpleNamespace(
            pattern=np.array([0]), sine=np.array([0]), velocity=velocity[:, None]
        )
        radiator = SimpleNamespace(mesh=shape, orders=1, patterns=1, by_order=[column])
        added = over_ground(scene, FAR[None, :])(radiator, WallPressure(hertz, [pressure[:, None]]))
        joined = green(source[None, :], FAR, table, [FLOOR])[0, 0] + added[0, 0]
        assert abs(decibels(joined, PASTURE.green(source[None, :], FAR, hertz)[0])) < 0.01
        assert abs(decibels(joined, by_quadrature(PASTURE, height, FAR, hertz))) < 0.07


def test_motion_along_y_is_that_along_x_turned():
    """cos θ at a point is sin θ at that point turned by 90°, and nothing across; 52 angles."""
    shape = mesh(capped_cylinder(0.08, 0.03, 0.42, 0.0), 0.02, 1)
    scene = SimpleNamespace(outdoors=PASTURE, walls=(FLOOR,), upright_walls=())
    nothing = np.zeros((len(shape.points), 0))
    order_0 = SimpleNamespace(pattern=np.array([], int), sine=np.array([], int), velocity=nothing)
    wave = np.repeat(shape.points[:, :1] + 1j * shape.points[:, 1:], 2, axis=1)
    order_1 = SimpleNamespace(pattern=np.array([0, 1]), sine=np.array([0, 1]), velocity=wave)
    radiator = SimpleNamespace(mesh=shape, orders=2, patterns=2, by_order=[order_0, order_1])
    pressure = WallPressure(250.0, [nothing, 400.0 * wave])
    points = np.array([[2.0, 0.0, 1.5], [0.0, 2.0, 1.5]])
    along_x, along_y = over_ground(scene, points)(radiator, pressure).T
    np.testing.assert_allclose(along_y, along_x[::-1], rtol=1e-9, atol=1e-9 * abs(along_x[0]))
    assert abs(along_x[1]) < 1e-9 * abs(along_x[0])


def test_monopole_in_the_box_needs_the_ground_under_it():
    """With the side on the floor the box brings the field over the ground; without, not quite."""
    lines = [np.linspace(-0.18, 0.18, 49), np.linspace(-0.18, 0.18, 49), np.linspace(0.0, 0.5, 69)]
    source, errors = np.array([[0.02, 0.01, 0.08]]), {}
    for with_floor in (True, False):
        box = closed_box(lines, [4, 4, 0], [44, 44, 64], {(2, -1)}, with_floor)
        for hertz in (50.0, 1000.0):
            field = [
                green(p, source[0], np.array([hertz]), [FLOOR])[0] for p in (box.inner, box.outer)
            ]
            greens = [SNOW.green(p, FAR, hertz) for p in (box.inner, box.outer)]
            joined = np.sum(box.weights * (field[0] * greens[1] - field[1] * greens[0]))
            exact = SNOW.green(source, FAR, hertz)[0]
            errors[with_floor, hertz] = abs(decibels(joined, exact))
    assert max(errors[True, 50.0], errors[True, 1000.0]) < 0.04
    assert errors[False, 1000.0] > 0.3


def test_hard_ground_and_a_wall_are_image_sources():
    wall = Mirror(axis=0, sign=-1, position_m=-0.6, reflection=0.7)
    points = np.random.default_rng(4).uniform(0.1, 0.4, (20, 3))
    given = Outdoors(0.0).green(points, FAR, 700.0, [wall])
    expected = green(points, FAR, np.array([700.0]), [FLOOR, wall])[0]
    np.testing.assert_allclose(given, expected, rtol=1e-12)


def macdonald(k, distance, end):
    """MacDonald's integral from -end on, turned by 45 ° into the complex plane.

    All of it is e^{jkR}/(kR); a positive end is all less the rest, as the turned path grows there.
    """
    if end > 0.0:
        return np.exp(1j * k * distance) / (k * distance) - macdonald(k, distance, -end)
    turn = np.exp(0.25j * np.pi)

    def integrand(t):
        s = -end + t * turn
        return 1j * hankel1(1, k * distance + s * s) / np.sqrt(s * s + 2.0 * k * distance) * turn

    return integral(integrand, 12.0 / (1.0 - end))


def half_plane(source, receiver, k):
    """Green's function of a hard half plane x = 2 m, z < 1.8 m, by MacDonald's integrals.

    Bowman, Senior, Uslenghi, Electromagnetic and Acoustic Scattering by Simple Shapes (1969), 8.2.
    """

    (r0, first), (r, second) = (
        (np.hypot(x - 2.0, z - 1.8), np.arctan2(2.0 - x, 1.8 - z) % (2.0 * np.pi))
        for x, _, z in (source, receiver)
    )
    along = receiver[1] - source[1]
    around = np.hypot(r + r0, along)
    total = 0.0
    for angle in (second - first, second + first):
        distance = np.sqrt(r**2 + r0**2 - 2.0 * r * r0 * np.cos(angle) + along**2)
        end = 2.0 * np.sqrt(k * r * r0 / (around + distance)) * np.cos(angle / 2.0)
        total += macdonald(k, distance, end)
    return np.conj(total) * k / (4.0 * np.pi)


SCREEN = Barrier(axis=0, sign=1, position_m=2.0, top_m=1.8)
GEOMETRIES = {
    "hidden": ((0.0, 0.0, 0.3), (4.0, 0.0, 1.5)),
    "line of sight": ((0.0, 0.0, 1.0), (8.0, 2.0, 4.2)),
    "near the edge": ((0.2, 0.3, 0.6), (3.0, 0.5, 1.2)),
    "clear": ((0.0, 0.0, 0.5), (9.0, 0.0, 7.0)),
}


def four_ways(source, receiver, k, half=half_plane):
    """Sum of the exact fields of source and image at receiver and image, on hard ground."""
    flip = np.array([1.0, 1.0, -1.0])
    ends = (np.array(source), flip * source), (np.array(receiver), flip * receiver)
    return sum(half(a, b, k) for a in ends[0] for b in ends[1])


@pytest.mark.parametrize("geometry", GEOMETRIES)
@pytest.mark.parametrize("along", [None, 0, 2])
def test_barrier_over_hard_ground_is_four_exact_half_planes(geometry, along):
    """Monopole, and dipoles along x and z: within 0.2 dB where it is above -15 dB.

    Exact: MacDonald's integrals by quadrature; relative to free field.
    """
    source, receiver = map(np.array, GEOMETRIES[geometry])
    outdoors = Outdoors(0.0, None, SCREEN)
    step = np.zeros(3) if along is None else 2e-3 * np.eye(3)[along]
    sides = (1.0,) if along is None else (1.0, -1.0)
    loud = 0
    for hertz in np.geomspace(100.0, 4000.0, 9):
        k = 2.0 * np.pi * hertz / 343.0
        computed = exact = free = 0.0
        for side in sides:
            moved = source + side * step
            distance = np.linalg.norm(receiver - moved)
            computed += side * outdoors.green(moved[None], receiver, hertz)[0]
            exact += side * four_ways(moved, receiver, k)
            free += side * np.exp(-1j * k * distance) / (4.0 * np.pi * distance)
        if decibels(exact, free) > -15.0:
            loud += 1
            assert abs(decibels(computed, exact)) < 0.2
    assert loud >= 2


def test_diffracted_sound_is_macdonalds_integral():
    """Shadow and its edge, from a twentieth of a wavelength to fifty: 0.03 dB and 0.5 degrees."""
    over = np.array([3.0])
    for turns in (0.3, 1.0, 4.0, 7.9, 8.1, 30.0, 300.0):
        k = turns / over[0]
        for ratio in (0.05, 0.5, 0.9, 0.999, 1.0):
            distance = ratio * over
            computed = diffracted(k, distance, over)[0]
            end = -np.sqrt(k * (over[0] - distance[0]))
            exact = np.conj(macdonald(k, distance[0], end)) * k / (4.0 * np.pi)
            assert abs(computed / exact - 1.0) < 0.009


def test_both_ways_are_the_same():
    """Source and microphone exchanged, with ground, barrier and a path along it."""
    here, there = np.array([0.1, 0.3, 0.4]), np.array([4.0, 2.0, 1.2])
    for hertz in (63.0, 800.0):
        to, back = (
            Outdoors(0.0, 80e3, Barrier(0, sign, 2.0, 1.5)).green(a[None, :], b, hertz)[0]
            for sign, a, b in ((1, here, there), (-1, there, here))
        )
        assert to == pytest.approx(back, rel=1e-12)
        plain = PASTURE.green(here[None, :], there, hertz)
        assert plain == pytest.approx(PASTURE.green(there[None, :], here, hertz), rel=1e-12)


@pytest.fixture(scope="module")
def study():
    return load_study(TINY).replace({"radiation.room_solver": "closed-form"})


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"ground": {"material": "clay"}}, "ground.material = 'clay': must be 'snow', 'moss'"),
        ({"ground": {"flow_resistivity_kpa_s_per_m2": 0.1}}, "= 0.1 kPa s/m²: out of range"),
        ({"ground": {}}, "material, flow_resistivity_kpa_s_per_m2: give one of them"),
        ({"ground": {"material": "snow"}, "floor": False}, "floor = true is needed"),
        ({"barrier": {"side": "+x", "distance_mm": 3000.0, "height_mm": 0.0}}, "= 0.0 mm:"),
        (
            {"barrier": {"side": "+x", "distance_mm": 2e3, "height_mm": 1e3},
             "walls": {"+x": {"distance_mm": 900.0}}},
            "barrier.side = +x: a wall is there",
        ),
    ],
)  # fmt: skip
def test_what_is_wrong_is_one_line(study, changes, words):
    with pytest.raises(ParameterError, match=r"radiation\.surroundings") as caught:
        study.replace({f"radiation.surroundings.{key}": value for key, value in changes.items()})
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


def test_what_does_not_go_together(study):
    ground = {"radiation.surroundings.ground": {"material": "pasture"}}
    with pytest.raises(ParameterError, match='room_solver = "k-wave"'):
        study.replace({**ground, "radiation.room_solver": "k-wave"})
    with pytest.raises(ParameterError, match="has ground or a barrier"):
        study.replace({**ground, "sound_power": {}})
    near = {"side": "-y", "distance_mm": 300.0, "height_mm": 1500.0}
    barred = study.replace({"radiation.surroundings.barrier": near}).radiation
    with pytest.raises(
        ParameterError, match=r"the machine is 217.5 mm off it; needed at least 300"
    ):
        transfer_vectors(study.machine.shell, study.receivers, barred)


@pytest.mark.long
def test_both_methods_bring_the_same_over_ground(study):
    """Boundary elements and cut cells, 18 mm: within 0.12 dB to 500 Hz, as on the hard floor."""
    receivers = {
        "near": Receiver(x_m=3.0, y_m=0.0, height_m=1.5),
        "far": Receiver(x_m=10.0, y_m=2.0, height_m=1.5),
    }
    changes = {
        "radiation.near_field_spacing_mm": 18.0,
        "radiation.surroundings.ground": {"material": "pasture"},
        "radiation.surroundings.barrier": {"side": "+x", "distance_mm": 2e3, "height_mm": 1.8e3},
    }
    by_elements, by_cells = (
        transfer_vectors(
            study.machine.shell,
            receivers,
            study.replace({**changes, "radiation.method": method}).radiation,
        )["transfer_vector"].sel(dof=["tx", "tz", "ry"], frequency=[50.0, 100.0, 250.0, 500.0])
        for method in ("revolution", "cut-cells")
    )
    assert np.abs(decibels(by_cells, by_elements)).max() < 0.12
