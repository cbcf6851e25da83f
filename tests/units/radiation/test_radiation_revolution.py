"""Boundary elements on the meridian: kernels, elements, exact fields, uniqueness."""

import numpy as np
import pytest
from documents import FORM
from evidence import claim
from radiation_parts import normal_velocity
from ring_sources import hemisphere, ring_field
from scipy import special
from sphere_sound import sphere_pressure

from vibroacoustics.base.revolution import capped_cylinder, polygon, sphere
from vibroacoustics.radiation.exact import free_green, wavenumber
from vibroacoustics.radiation.patterns import Pattern, rigid_body
from vibroacoustics.radiation.revolution.layers import layers
from vibroacoustics.radiation.revolution.mesh import mesh
from vibroacoustics.radiation.revolution.profile import above_floor
from vibroacoustics.radiation.revolution.radiator import (
    Radiator,
    null_points,
    radiated,
    wall_pressure,
)
from vibroacoustics.radiation.revolution.ring import DIGITS, ring, rules

FLAT = capped_cylinder(0.0825, -0.2, 0.217)
DOMED = capped_cylinder(0.0825, -0.2, 0.217, 0.03)
CONE = polygon([(0.0, -0.2), (0.09, -0.2), (0.05, 0.15), (0.0, 0.2)])
SOURCE = (0.04, 0.05)


def _errors(profile, frequency_hz, longest_m, gradings, orders=9, floor_z_m=None, points=None):
    """Errors (order,) over the order's largest pressure at 18 microphones, of a ring inside."""
    elements = mesh(above_floor(profile, floor_z_m), longest_m, gradings)
    k = float(wavenumber(np.array(frequency_hz)))
    _, velocity = ring_field(
        elements.points, elements.normals, SOURCE, frequency_hz, orders, floor_z_m
    )
    columns = [order[:, None] for order in velocity]
    if points is None:
        points = hemisphere(-0.22 if floor_z_m is None else floor_z_m)
    wall = wall_pressure(elements, null_points(elements), k, columns, floor_z_m)
    ours = np.array(radiated(elements, points, k, columns, wall, floor_z_m))[:, :, 0]
    exact, _ = ring_field(points, np.zeros_like(points), SOURCE, frequency_hz, orders, floor_z_m)
    return np.abs(ours - exact).max(axis=1) / np.abs(exact).max(axis=1)


@pytest.mark.parametrize("distance_m", [1e-7, 1e-4, 2e-3, 0.03, 0.4])
@pytest.mark.parametrize("frequency_hz", [30.0, 10000.0])
def test_ring_against_fine_quadrature(distance_m, frequency_hz):
    """Every order of both kernels, however near, within 1e-7 of the largest."""
    k, orders = float(wavenumber(np.array(frequency_hz))), 17
    rng = np.random.default_rng(1)
    for _ in range(5):
        turn, lean = 2.0 * np.pi * rng.random(2)
        radius = 0.08 * rng.uniform(0.05, 1.0)
        source = np.array(
            [
                abs(radius + distance_m * np.cos(turn)),
                distance_m * np.sin(turn),
                np.cos(lean),
                np.sin(lean),
            ]
        )
        ours = np.empty((4, orders))
        ring(radius, 0.0, source, k, DIGITS, rules(orders), ours)
        for part, expected in zip((0, 2), _fine_ring(radius, source, k, orders), strict=True):
            error = np.abs(ours[part] + 1j * ours[part + 1] - expected)
            assert error.max() < 1e-7 * np.abs(expected).max()


def _fine_ring(radius, source, k, orders):
    """Both kernels by Gauss points on pieces that shrink towards the near side."""
    across, along = source[0] - radius, source[1]
    width = np.hypot(across, along) / np.sqrt(radius * source[0])
    ends = np.pi * 1.5 ** -np.arange(1.0 + np.ceil(np.log(20.0 + 20.0 / width) / np.log(1.5)))
    ends = np.concatenate([[0.0], ends[::-1]])
    local, weights = np.polynomial.legendre.leggauss(40)
    angle = (ends[:-1, None] + np.diff(ends)[:, None] * (1.0 + local) / 2.0).ravel()
    share = (np.diff(ends)[:, None] * weights / 2.0).ravel()
    sine = np.sin(angle / 2.0) ** 2
    distance = np.sqrt(across**2 + along**2 + 4.0 * radius * source[0] * sine)
    field = np.exp(-1j * k * distance) / distance
    facing = source[2] * across + source[3] * along + 2.0 * source[2] * radius * sine
    turns = np.cos(np.multiply.outer(np.arange(orders), angle)) * share * source[0] / (2.0 * np.pi)
    return turns @ field, turns @ (-facing * (1.0 + 1j * k * distance) * field / distance**2)


def test_elements_close_the_surface():
    """Area and volume of cylinder, cone and sphere."""
    cylinder = 2.0 * np.pi * 0.0825 * (0.0825 + 0.417)
    frustum = np.pi * 0.14 * np.hypot(0.04, 0.35)
    tip = np.pi * 0.05 * np.hypot(0.05, 0.05)
    ball = 4.0 * np.pi * 0.1**2
    for profile, area in (
        (FLAT, cylinder),
        (CONE, np.pi * 0.09**2 + frustum + tip),
        (sphere(0.1, 0.3), ball),
    ):
        elements = mesh(profile, 0.05, 2)
        ring_area = 2.0 * np.pi * elements.points[:, 0] * elements.weights
        assert ring_area.sum() == pytest.approx(area, rel=1e-6)
        outward = np.einsum("ni,ni->n", elements.normals, elements.points - np.array([0.0, 0.01]))
        assert np.all(outward > 0.0) or profile not in (FLAT, CONE)


def test_elements_shrink_towards_edges_only():
    """Two gradings leave 0.3² of an element at the rims, none where domes run into the side.

    A narrow knuckle has nodes of its own.
    """
    flat, domed = mesh(FLAT, 0.03, 2), mesh(DOMED, 0.03, 2)
    assert flat.lengths.min() == pytest.approx(0.0275 * 0.09, rel=1e-6)
    assert flat.lengths.max() < 0.03
    assert domed.lengths.min() > 0.01
    assert _errors(capped_cylinder(0.0825, -0.2, 0.217, 0.002), 4000.0, 0.03, 2).max() < 1e-4


def test_constant_pressure_is_no_sound():
    """Gauss: the static double layer of a constant is -1/2 on the wall and -1 inside."""
    elements = mesh(CONE, 0.04, 1)
    points = np.concatenate([elements.points, null_points(elements)])
    double = layers(elements, points, 0.0, 1)[1][0].sum(axis=1)
    count = len(elements.points)
    np.testing.assert_allclose(double[:count], -0.5, atol=3e-5)
    np.testing.assert_allclose(double[count:], -1.0, atol=3e-6)


@pytest.mark.parametrize(
    ("profile", "floor_z_m"),
    [(FLAT, None), (DOMED, -0.22), (CONE, -0.2005), (FLAT, -0.2), (sphere(0.15, 0.0), -0.16)],
    ids=["flat in free field", "domed", "cone", "flat on the floor", "sphere"],
)
def test_rings_inside(profile, floor_z_m, request):
    """Orders 0 to 8 on 18 microphones: 0.02 dB at 100 Hz, 1 and 4 kHz, 0.05 dB at 10 kHz.

    Off the floor, on it and with gaps of half a millimetre and of a point.
    """
    for frequency_hz, longest_m, most in (
        (100.0, 0.03, 1e-4),
        (1000.0, 0.03, 1e-4),
        (4000.0, 0.03, 1e-4),
        (10000.0, 0.023, 2e-3),
    ):
        errors = _errors(profile, frequency_hz, longest_m, 2, floor_z_m=floor_z_m)
        claim(
            f"Boundary elements, {request.node.callspec.id}, {frequency_hz:g} Hz", kind="exact",
            source=FORM("field of rings of sources in the body"), unit="1",
            computed=errors, reference=0.0, tolerance=most, topics=("radiation",),
        )  # fmt: skip


def test_order_of_convergence():
    """Elements 0.6 times as long err by less than 0.6² of what they did; rather by 0.6⁷."""
    errors = [_errors(FLAT, 10000.0, longest_m, 2).max() for longest_m in (0.05, 0.03, 0.018)]
    orders = np.diff(np.log(errors)) / np.log(0.6)
    assert np.all(orders > 4.0), (errors, orders)


def test_order_of_convergence_at_edges():
    """A stiff flat-capped cylinder that moves along itself and across, against a finer mesh."""
    patterns = [rigid_body(dof) for dof in ("tx", "tz", "ry")]
    microphones = np.array([[0.7, 0.4, 0.3], [0.0, 0.9, -0.1], [-0.5, 0.2, 0.8]])

    def pressure(longest_m, gradings):
        radiator = Radiator(mesh(FLAT, longest_m, gradings), patterns, -0.22)
        return radiator.pressures(radiator.solve(2000.0), microphones)

    reference = pressure(0.02, 5)
    size = np.abs(reference).max(axis=0)
    errors = [
        (np.abs(pressure(longest_m, gradings) - reference) / size).max()
        for longest_m, gradings in ((0.08, 1), (0.04, 2), (0.02, 3))
    ]
    assert errors[0] < 1e-2
    assert np.all(np.diff(np.log(errors)) / np.log(0.5) > 2.0), errors


def test_unique_where_the_inside_resonates():
    """At the resonances of a soft sphere's inside the surface's equation alone has no answer."""
    radius = 0.1
    body = mesh(sphere(radius, 0.0), 0.03, 1)
    microphones = hemisphere(0.0)
    for order, degree, root in ((0, 0, np.pi), (0, 0, 2.0 * np.pi), (1, 1, 4.4934094579)):
        k = root / radius
        cosine = body.points[:, 1] / radius
        velocity = [np.zeros((len(cosine), 0))] * order
        velocity.append(special.lpmv(order, degree, cosine)[:, None])
        columns = [np.asarray(column, dtype=float) for column in velocity]
        wall = wall_pressure(body, null_points(body), k, columns)
        ours = np.abs(radiated(body, microphones, k, columns, wall)[order][:, 0])
        frequency_hz = np.array([k * 343.0 / (2.0 * np.pi)])
        exact = np.abs(sphere_pressure(degree, radius, 1.0, np.ones(1), frequency_hz)[0])
        exact = exact * np.abs(special.lpmv(order, degree, microphones[:, 1]))
        np.testing.assert_allclose(ours, exact, atol=1e-4 * exact.max())
        alone = layers(body, body.points, k, order + 1)[1][order]
        least = np.linalg.svd(0.5 * np.eye(len(cosine)) - alone, compute_uv=False)[-1]
        assert least < 1e-4


def test_monopole_off_the_axis_is_heard_all_around():
    """All orders at once, microphones off the plane, next to the wall and on the axis."""
    frequency_hz, source = 3000.0, np.array([0.02, -0.03, 0.1])
    floor_z_m = -0.23
    image = source * [1.0, 1.0, -1.0] + [0.0, 0.0, 2.0 * floor_z_m]

    def pressure(points):
        pair = (free_green(points, at, np.array([frequency_hz]))[0] for at in (source, image))
        return sum(pair)

    def velocity(points, step=1e-5):
        normals = np.stack([points - step * axis for axis in np.eye(3)])
        others = np.stack([points + step * axis for axis in np.eye(3)])
        slopes = [
            (pressure(b) - pressure(a)) / (2.0 * step) for a, b in zip(normals, others, strict=True)
        ]
        return np.stack(slopes, axis=1) * 1j / (2.0 * np.pi * frequency_hz * 1.2)

    patterns = [
        Pattern("real", lambda at: velocity(at.position).real),
        Pattern("imaginary", lambda at: velocity(at.position).imag),
    ]
    radiator = Radiator(mesh(DOMED, 0.03, 1), patterns, floor_z_m)
    microphones = np.array(
        [[0.5, 0.8, 0.3], [-0.9, 0.1, 0.0], [0.0, 0.0, 0.7], [0.06, -0.06, 0.1], [1.5, -2.0, 1.0]]
    )
    ours = radiator.pressures(radiator.solve(frequency_hz), microphones) @ np.array([1.0, 1j])
    np.testing.assert_allclose(ours, pressure(microphones), rtol=1e-4)


def test_sine_and_cosine_are_turned_copies():
    """ty is tx turned by a quarter; rz moves nothing; a mode of order 3 turns by a third."""
    oval = normal_velocity("oval", lambda p: np.cos(3.0 * np.arctan2(p[:, 1], p[:, 0])))
    patterns = [*map(rigid_body, ("tx", "ty", "rz")), oval]
    radiator = Radiator(mesh(FLAT, 0.05, 1), patterns)
    wall = radiator.solve(800.0)
    angle = 0.7
    points = np.array(
        [
            [np.cos(a), np.sin(a), 0.3]
            for a in (angle, angle + np.pi / 2.0, angle + 2.0 * np.pi / 3.0)
        ]
    )
    found = radiator.pressures(wall, points)
    assert found[0, 0] == pytest.approx(found[1, 1], rel=1e-9)
    assert found[0, 3] == pytest.approx(found[2, 3], rel=1e-9)
    assert not found[:, 2].any()
