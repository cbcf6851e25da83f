"""The machine side: cut cells, and bodies whose sound field is known."""

import numpy as np
import pytest

from vibroacoustics.errors import ParameterError
from vibroacoustics.radiation.bodies import Cylinder, Sphere, outward_normal
from vibroacoustics.radiation.box import BoxField
from vibroacoustics.radiation.cut_cells import cut_cells
from vibroacoustics.radiation.exact import box_green, sphere_pressure
from vibroacoustics.radiation.join import join
from vibroacoustics.radiation.near_field import NearField
from vibroacoustics.radiation.patterns import (
    Pattern,
    pulsating,
    rigid_body,
    rigid_body_velocity,
)

FREQUENCY_HZ = np.array([25.0, 48.0, 117.0, 250.0, 500.0, 1000.0])
ANGLES = np.radians([0.0, 30.0, 60.0, 75.0, 84.0, 120.0, 180.0])


def pressure(near, field, microphone, floor_z_m=None, frequency_hz=FREQUENCY_HZ):
    return join(near.box, field, box_green(near.box, microphone, frequency_hz, floor_z_m))


def level_difference(a, b):
    return 20.0 * np.log10(np.abs(a) / np.abs(b))


@pytest.mark.parametrize(
    "body", [Sphere(0.1, (0.01, 0.02, -0.03)), Cylinder(0.08, -0.2, 0.21)], ids=["sphere", "can"]
)
class TestBodies:
    def test_distance_is_exact(self, body):
        """Walking the distance along the normal ends on the surface."""
        points = np.random.default_rng(1).uniform(-0.3, 0.3, (500, 3))
        distance = body.signed_distance(points)
        surface = points - distance[:, None] * outward_normal(body, points)
        np.testing.assert_allclose(body.signed_distance(surface), 0.0, atol=1e-7)

    def test_bounds_touch_the_body(self, body):
        lower, upper = body.bounds()
        corners = np.array([lower, upper])
        middle = corners.mean(axis=0)
        for axis in range(3):
            touching = np.tile(middle, (2, 1))
            touching[:, axis] = corners[:, axis]
            np.testing.assert_allclose(body.signed_distance(touching), 0.0, atol=1e-12)


class TestPatterns:
    def test_rotations_turn_right_handed(self):
        point = np.array([0.0, 0.5, 0.0])
        np.testing.assert_allclose(rigid_body_velocity("rx", point), [0.0, 0.0, 0.5])
        np.testing.assert_allclose(rigid_body_velocity("rz", point), [-0.5, 0.0, 0.0])
        np.testing.assert_allclose(rigid_body_velocity("ty", point), [0.0, 1.0, 0.0])

    def test_unknown_dof_is_refused(self):
        with pytest.raises(ParameterError, match="'tw' is not one of tx, ty"):
            rigid_body_velocity("tw", np.zeros(3))


class TestCutCells:
    @staticmethod
    def cut(body, spacing):
        return cut_cells(body, np.full(3, -0.2003), spacing, (round(0.4 / spacing),) * 3)

    def test_wall_of_a_closed_body_has_no_vector_area(self):
        cells = self.cut(Sphere(0.1, (0.003, 0.001, 0.002)), 0.02)
        np.testing.assert_allclose(cells.wall_areas.sum(axis=0), 0.0, atol=1e-15)

    def test_uniform_pressure_gives_no_moment(self):
        cells = self.cut(Cylinder(0.083, -0.11, 0.12), 0.02)
        moment = np.cross(cells.wall_centroids, cells.wall_areas).sum(axis=0)
        np.testing.assert_allclose(moment, 0.0, atol=1e-4 * 0.1 * np.abs(cells.wall_areas).sum())

    def test_area_and_volume_converge_at_second_order(self):
        body = Sphere(0.1, (0.003, 0.001, 0.002))
        area, volume = [], []
        for spacing in (0.04, 0.02, 0.01):
            cells = self.cut(body, spacing)
            total = np.linalg.norm(cells.wall_areas, axis=1).sum()
            area.append(abs(total / (4 * np.pi * 0.01) - 1))
            solid = (1.0 - cells.fluid_volumes).sum() * spacing**3
            volume.append(abs(solid / (4 / 3 * np.pi * 0.001) - 1))
        # Two halvings of the spacing: a factor of 16 at second order.
        assert area[2] < area[0] / 10
        assert volume[2] < 1e-3
        assert area[2] < 5e-3

    def test_centroids_lie_on_the_wall(self):
        body = Sphere(0.1, (0.003, 0.001, 0.002))
        cells = self.cut(body, 0.01)
        assert np.abs(body.signed_distance(cells.wall_centroids)).max() < 0.01 / 8

    def test_volumes_are_bounded_below(self):
        cells = self.cut(Sphere(0.1, (0.003, 0.001, 0.002)), 0.02)
        area = cells.open_areas
        total = area[0][1:] + area[0][:-1] + area[1][:, 1:] + area[1][:, :-1]
        total = total + area[2][:, :, 1:] + area[2][:, :, :-1]
        assert np.all(cells.volumes >= total / 18.0 - 1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("radius", [0.12, 0.0825])
@pytest.mark.parametrize(("name", "order"), [("pulsating", 0), ("tz", 1), ("tx", 1)])
def test_sphere_radiates_the_exact_field(radius, name, order):
    """Within 0.1 dB at every angle less than 20 dB below the maximum, 25 Hz to 1 kHz, at 1 m."""
    body = Sphere(radius)
    near = NearField(body, 0.0125, 2500.0)
    pattern = pulsating(body, 4 * np.pi * radius**2) if order == 0 else rigid_body(name)
    field = near.radiate(pattern, FREQUENCY_HZ)
    axis = 0 if name == "tx" else 2
    for angle in ANGLES:
        microphone = np.zeros(3)
        microphone[axis], microphone[(axis + 1) % 3] = np.cos(angle), np.sin(angle)
        expected = sphere_pressure(order, radius, 1.0, np.cos([angle]), FREQUENCY_HZ)[:, 0]
        simulated = pressure(near, field, microphone)
        np.testing.assert_allclose(level_difference(simulated, expected), 0.0, atol=0.1)
        # Phase as well: 0.05 rad is 3 degrees.
        assert np.abs(np.angle(simulated / expected)).max() < 0.05


def test_sphere_off_the_grid_and_the_origin_radiates_the_same():
    centre = (0.0041, -0.0037, 0.0029)
    near = NearField(Sphere(0.12, centre), 0.0125, 2500.0)
    field = near.radiate(rigid_body("tz"), FREQUENCY_HZ)
    microphone = np.array(centre) + np.array([0.6, 0.0, 0.8])
    expected = sphere_pressure(1, 0.12, 1.0, np.array([0.8]), FREQUENCY_HZ)[:, 0]
    simulated = pressure(near, field, microphone)
    np.testing.assert_allclose(level_difference(simulated, expected), 0.0, atol=0.1)


@pytest.mark.slow
def test_pressure_does_not_depend_on_the_box():
    body = Cylinder(0.0825, -0.2, 0.217)
    microphone = np.array([0.16, -0.96, 0.0])
    results = []
    for margin in (0.04, 0.08):
        near = NearField(body, 0.0165, 1500.0, -0.22, box_margin_m=margin)
        fields = [near.radiate(rigid_body(dof), FREQUENCY_HZ) for dof in ("tx", "tz")]
        results.append([pressure(near, field, microphone, -0.22) for field in fields])
    np.testing.assert_allclose(level_difference(*results), 0.0, atol=0.15)


def test_sliding_wall_radiates_nothing_without_a_run():
    near = NearField(Cylinder(0.0825, -0.2, 0.217), 0.0165, 1500.0)
    calls = []
    field = near.radiate(rigid_body("rz"), FREQUENCY_HZ, lambda *call: calls.append(call))
    assert not calls
    assert not field.inner.any()
    assert not field.outer.any()


class _Both:
    """Two bodies as one, for the mirror test."""

    def __init__(self, first, second):
        self.bodies = (first, second)

    def signed_distance(self, points):
        return np.minimum(*(body.signed_distance(points) for body in self.bodies))

    def bounds(self):
        lower, upper = zip(*(body.bounds() for body in self.bodies), strict=True)
        return np.min(lower, axis=0), np.max(upper, axis=0)


@pytest.mark.slow
@pytest.mark.parametrize("dof", ["tx", "tz", "ry"])
def test_floor_equals_free_field_with_the_mirrored_body(dof):
    """A body over a hard floor and its mirror image, moving as mirror images, in free field."""
    radius, height, floor = 0.09, 0.11, -0.11
    above, below = Sphere(radius), Sphere(radius, (0.0, 0.0, -2 * height))
    over_floor = NearField(above, 0.015, 1500.0, floor)
    free = NearField(_Both(above, below), 0.015, 1500.0)

    def mirrored(points):
        upper = rigid_body_velocity(dof, points)
        reflected = points * [1, 1, -1] + [0, 0, 2 * floor]
        lower = rigid_body_velocity(dof, reflected) * [1, 1, -1]
        return np.where(points[..., 2:] > floor, upper, lower)

    microphone = np.array([0.5, 0.3, 0.7])
    expected = pressure(free, free.radiate(Pattern(dof, mirrored), FREQUENCY_HZ), microphone)
    if dof == "ry":  # A sphere that turns about its own centre only slides.
        assert np.abs(expected).max() < 1e-12
        return
    field = over_floor.radiate(rigid_body(dof), FREQUENCY_HZ)
    simulated = pressure(over_floor, field, microphone, floor)
    np.testing.assert_allclose(level_difference(simulated, expected), 0.0, atol=0.05)


@pytest.mark.slow
def test_far_from_the_floor_the_image_alone_is_right():
    """Five radii up, a pulsating sphere and its image hardly scatter each other's sound."""
    radius, floor = 0.06, -0.3
    body = Sphere(radius)
    near = NearField(body, 0.012, 1500.0, floor)
    field = near.radiate(pulsating(body, 4 * np.pi * radius**2), FREQUENCY_HZ[:3])
    microphone = np.array([0.9, 0.0, 0.2])
    expected = sum(
        sphere_pressure(0, radius, np.hypot(0.9, z), np.ones(1), FREQUENCY_HZ[:3])[:, 0]
        for z in (0.2, 0.8)
    )
    simulated = pressure(near, field, microphone, floor, FREQUENCY_HZ[:3])
    # The image's velocity at the sphere is (a/2h)^2 = 1 % of the wall's and makes only a dipole.
    np.testing.assert_allclose(level_difference(simulated, expected), 0.0, atol=0.1)


@pytest.mark.slow
@pytest.mark.parametrize("clearance", [0.0, 0.02])
def test_cylinder_converges_with_the_spacing(clearance):
    """Mean level over microphones, coarse grids against 10 mm, to 500 Hz."""
    floor = -0.2 - clearance
    microphones = np.array([(0.16, -0.96, 0.22), (-0.83, 0.32, 0.45), (0.1, -0.1, 0.99)])
    microphones[:, 2] += floor
    levels = []
    for spacing in (0.02, 0.0125, 0.01):
        near = NearField(Cylinder(0.0825, -0.2, 0.217), spacing, 2000.0, floor)
        fields = [near.radiate(rigid_body(dof), FREQUENCY_HZ[:5]) for dof in ("tx", "tz", "rx")]
        p = np.array(
            [[pressure(near, f, m, floor, FREQUENCY_HZ[:5]) for m in microphones] for f in fields]
        )
        levels.append(10 * np.log10((np.abs(p) ** 2).mean(axis=1)))
    coarse, middle = (np.abs(level - levels[-1]).max() for level in levels[:2])
    # How the grid happens to cut the caps changes from spacing to spacing, so the order of
    # convergence shows on the sphere only (below); here the differences must be small and shrink.
    assert coarse < 0.6
    assert middle < 0.3
    assert middle < coarse


def test_error_falls_with_the_square_of_the_spacing():
    """Oscillating sphere, 1 m on the axis: complex error against the exact field, from 250 Hz."""
    frequency = FREQUENCY_HZ[3:]
    expected = sphere_pressure(1, 0.12, 1.0, np.ones(1), frequency)[:, 0]
    errors = []
    for spacing in (0.03, 0.015):
        near = NearField(Sphere(0.12), spacing, 1000.0)
        field = near.radiate(rigid_body("tx"), frequency)
        simulated = pressure(near, field, np.array([1.0, 0.0, 0.0]), frequency_hz=frequency)
        errors.append(np.abs(simulated / expected - 1).max())
    assert errors[1] < errors[0] / 3.0


def test_translation_of_a_body_on_the_floor_displaces_air():
    """The bottom is not in the air: the top's volume velocity remains: a monopole."""
    near = NearField(Cylinder(0.0825, -0.2, 0.0), 0.0165, 1500.0, -0.2)
    low = np.array([20.0])
    field = near.radiate(rigid_body("tz"), low)
    microphone = np.array([3.0, 0.0, -0.2])
    simulated = pressure(near, field, microphone, -0.2, low)
    # j omega rho Q G with Q = pi R² and the source's own image: low frequency, far off.
    monopole = 2 * np.pi * 20 * 1.2 * np.pi * 0.0825**2 * 2 / (4 * np.pi * 3.0)
    np.testing.assert_allclose(np.abs(simulated), monopole, rtol=0.03)


def test_reciprocal_green_functions_leave_no_pressure_of_their_own():
    """Two outside sources satisfy the join's integral with zero: nothing radiates from inside."""
    near = NearField(Sphere(0.1), 0.0125, 1000.0)
    first, second = (
        box_green(near.box, np.array(p), FREQUENCY_HZ, None)
        for p in ([1.0, 0.2, 0.1], [-0.3, 0.9, 0.4])
    )
    residue = np.abs(join(near.box, first, second))
    scale = np.abs(join(near.box, BoxField(first.inner, 0 * first.outer), second))
    assert np.all(residue < 5e-3 * scale)


def test_memory_is_checked_before_the_run(monkeypatch):
    monkeypatch.setattr("psutil.virtual_memory", type("M", (), {"available": 2**20}))
    with pytest.raises(ParameterError, match=r"near_field_spacing_mm: the grid of \d+×\d+×\d+"):
        NearField(Sphere(0.1), 0.0125, 1000.0)


def test_all_runs_of_one_body_are_repeatable():
    near = NearField(Sphere(0.06), 0.0165, 1000.0)
    first, second = (near.radiate(rigid_body("tx"), FREQUENCY_HZ) for _ in range(2))
    np.testing.assert_array_equal(first.inner, second.inner)
