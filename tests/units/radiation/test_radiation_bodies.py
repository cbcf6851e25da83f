"""Radiating bodies: measures, inside and outside, plane faces, and meshes from files."""

import io
import struct

import numpy as np
import pytest
import trimesh

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.base.revolution import capped_cylinder
from vibroacoustics.radiation.bodies import (
    Body,
    block,
    checked_mesh,
    join_bodies,
    read_mesh,
    sphere,
    turned,
)


def area(body):
    return np.linalg.norm(body.area_vectors(), axis=1).sum()


def volume(body):
    return np.einsum("fi,fi->", body.triangles[:, 0], body.area_vectors()) / 3.0


def dome_area(radius, height):
    """Half of an oblate spheroid (radius > height): 2πa²(1 + (1 - e²)/e artanh e)/2."""
    e = np.sqrt(1.0 - (height / radius) ** 2)
    return np.pi * radius**2 * (1.0 + (1.0 - e**2) / e * np.arctanh(e))


R, H, DOME = 0.0825, 0.417, 0.04
BODIES = {
    "sphere": (sphere(0.12, (0.3, -0.2, 0.1)), 4 / 3 * np.pi * 0.12**3, 4 * np.pi * 0.12**2),
    "flat": (
        turned(capped_cylinder(R, -0.19, -0.19 + H)),
        np.pi * R**2 * H,
        2 * np.pi * R * H + 2 * np.pi * R**2,
    ),
    "domed": (
        turned(capped_cylinder(R, -0.19, -0.19 + H, DOME)),
        np.pi * R**2 * (H - 2 * DOME) + 4 / 3 * np.pi * R**2 * DOME,
        2 * np.pi * R * (H - 2 * DOME) + 2 * dome_area(R, DOME),
    ),
    "block": (
        block(np.array([-0.1, 0.0, 0.2]), np.array([0.2, 0.1, 0.6])),
        0.3 * 0.1 * 0.4,
        2 * (0.3 * 0.1 + 0.3 * 0.4 + 0.1 * 0.4),
    ),
}
FACETS_VOLUME = {"sphere": 0.0, "flat": 0.0, "domed": 4e-4, "block": 0.0}
"""Relative error that the facets may make beside rounding; see `test_volume`."""


@pytest.mark.parametrize("name", BODIES)
class TestMeasures:
    def test_volume(self, name):
        """Exact where the mesh is scaled to be: sphere, and sections across the cylinder's axis.

        A dome's outline is 32 chords of 90°, each inside of it by a share θ²/6 = 4e-4 at most of
        the dome's volume.
        """
        body, expected, _ = BODIES[name]
        np.testing.assert_allclose(volume(body), expected, rtol=FACETS_VOLUME[name] + 1e-12)

    def test_area(self, name):
        """Facets around an axis: (π/128)²/6 = 1e-4 on the side; twice that on curved faces."""
        body, _, expected = BODIES[name]
        np.testing.assert_allclose(area(body), expected, rtol=1e-12 if name == "block" else 4e-4)

    def test_closed_with_its_normals_outwards(self, name):
        body = BODIES[name][0]
        assert checked_mesh(body, name) is body
        np.testing.assert_allclose(body.area_vectors().sum(axis=0), 0.0, atol=1e-14)


class TestContains:
    def test_sphere_against_its_distance(self):
        """The facets lie within 3e-4 of a radius of the sphere."""
        body = sphere(0.1, (0.01, 0.02, -0.03))
        points = np.random.default_rng(1).uniform(-0.15, 0.15, (60, 3))
        depth = 0.1 - np.linalg.norm(points - [0.01, 0.02, -0.03], axis=1)
        clear = np.abs(depth) > 1e-4
        inside = np.array([body.contains(point) for point in points])
        np.testing.assert_array_equal(inside[clear], depth[clear] > 0.0)
        assert inside.any()
        assert not inside.all()

    def test_union_of_overlapping_blocks(self):
        body = join_bodies(
            [block(np.zeros(3), np.full(3, 0.2)), block(np.full(3, 0.1), np.ones(3))]
        )
        for point, inside in (
            (0.05, True),
            (0.15, True),
            (0.5, True),
            (-0.01, False),
            (1.1, False),
        ):
            assert body.contains(point + np.array([0.0, 0.01, 0.02])) == inside


class TestFlats:
    def test_caps_of_a_flat_cylinder(self):
        """Both caps are equally large: their order is open."""
        body = turned(capped_cylinder(0.0825, -0.19, 0.227))
        np.testing.assert_allclose(np.sort(body.flats(2, 1e-4)), [-0.19, 0.227])

    def test_a_dome_has_none(self):
        assert turned(capped_cylinder(0.0825, -0.19, 0.227, 0.04)).flats(2, 1e-4).size == 0
        assert sphere(0.1).flats(0, 1e-3).size == 0

    def test_largest_first_and_none_below_the_least_area(self):
        small = block(np.array([0.0, 0.0, 0.3]), np.array([0.01, 0.01, 0.4]))
        body = join_bodies([small, block(np.array([0.0, 0.0, 0.0]), np.array([0.2, 0.1, 0.3]))])
        # z = 0.3 has the large top and the small bottom.
        np.testing.assert_allclose(body.flats(2, 1e-6), [0.3, 0.0, 0.4])
        np.testing.assert_allclose(body.flats(2, 1e-3), [0.3, 0.0])


class TestFiles:
    @staticmethod
    def write(path, body, file_type="stl", scale=1.0):
        mesh = trimesh.Trimesh(scale * body.vertices, body.faces, process=False)
        content = mesh.export(file_type=file_type)
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    @pytest.mark.parametrize("file_type", ["stl", "stl_ascii"])
    def test_round_trip_in_millimetres(self, tmp_path, file_type):
        """STL stores float32: 6e-8 of the largest coordinate, 227 mm."""
        body = turned(capped_cylinder(0.0825, -0.19, 0.227, 0.04))
        path = self.write(tmp_path / "can.stl", body, file_type, 1e3)
        again = read_mesh(path, 1e-3)
        assert again.faces.shape == body.faces.shape
        assert again.vertices.shape == body.vertices.shape
        np.testing.assert_allclose(again.triangles, body.triangles, atol=3e-8)

    def test_unit(self, tmp_path):
        path = self.write(tmp_path / "can.stl", block(np.zeros(3), np.ones(3)))
        np.testing.assert_allclose(volume(read_mesh(path, 0.0254)), 0.0254**3, rtol=1e-6)

    def refused(self, path, words):
        with pytest.raises(ParameterError, match=words) as caught:
            read_mesh(path, 1e-3)
        assert str(path) in str(caught.value)
        assert "\n" not in str(caught.value)

    def test_missing(self, tmp_path):
        self.refused(tmp_path / "none.stl", "cannot be read: No such file")

    def test_folder(self, tmp_path):
        self.refused(tmp_path, "cannot be read: Is a directory")

    @pytest.mark.parametrize(
        "content",
        [
            b"",
            b"no mesh at all\n" * 20,
            b"\x89PNG" + bytes(range(256)) * 4,
            b"\0" * 80 + struct.pack("<I", 100) + b"\0" * 50,
            b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 x\nendloop\nendfacet\nendsolid\n",
        ],
        ids=["nothing", "text", "picture", "cut short", "no number"],
    )
    def test_garbage(self, tmp_path, content):
        path = tmp_path / "garbage.stl"
        path.write_bytes(content)
        self.refused(path, "is no STL mesh|has no triangles")

    def test_no_triangles(self, tmp_path):
        path = tmp_path / "empty.stl"
        path.write_bytes(b"\0" * 80 + struct.pack("<I", 0))
        self.refused(path, "is no STL mesh|has no triangles")

    def test_open(self, tmp_path):
        body = sphere(50.0)
        path = self.write(tmp_path / "open.stl", Body(body.vertices, body.faces[1:]))
        self.refused(path, "not closed, or .* in one sense: 3 edges lack a partner")

    def test_inverted(self, tmp_path):
        body = sphere(50.0)
        path = self.write(tmp_path / "inverted.stl", Body(body.vertices, body.faces[:, ::-1]))
        self.refused(path, "is inverted: its normals point inwards")

    def test_mixed_orientation(self, tmp_path):
        body = block(np.zeros(3), np.full(3, 100.0))
        faces = body.faces.copy()
        faces[0] = faces[0, ::-1]
        path = self.write(tmp_path / "mixed.stl", Body(body.vertices, faces))
        self.refused(path, "not closed, or its triangles are not oriented in one sense")

    def test_not_finite(self, tmp_path):
        """Written by hand: trimesh drops such corners."""
        body = block(np.zeros(3), np.full(3, 100.0))
        triangles = body.triangles.astype("<f4")
        triangles[0, 0, 0] = np.nan
        file = io.BytesIO()
        file.write(b"\0" * 80 + struct.pack("<I", len(triangles)))
        for triangle in triangles:
            file.write(b"\0" * 12 + triangle.tobytes() + b"\0\0")
        path = tmp_path / "nan.stl"
        path.write_bytes(file.getvalue())
        self.refused(path, "has no triangles, or corners|not closed")
