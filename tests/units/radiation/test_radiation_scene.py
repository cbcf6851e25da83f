"""From parameters to geometry: bodies, walls, cabinets, and velocities from files."""

import numpy as np
import pytest
import trimesh
from pydantic import ValidationError
from support import whole_surface

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.machine.shell import Shell
from vibroacoustics.radiation.bodies import block, join_bodies
from vibroacoustics.radiation.cabinet import cabinet_panels
from vibroacoustics.radiation.cut_cells import cut_cells
from vibroacoustics.radiation.exact import images
from vibroacoustics.radiation.near_grid import near_grid
from vibroacoustics.radiation.patterns import Pattern, rigid_body
from vibroacoustics.radiation.scene import (
    Scene,
    file_patterns,
    machine_body,
    position_m,
    room_walls,
    scene,
)
from vibroacoustics.study.body import BoxBody, MeshBody, SphereBody
from vibroacoustics.study.radiation import RadiationSettings
from vibroacoustics.study.receivers import Receiver
from vibroacoustics.study.surroundings import (
    Cabinet,
    Opening,
    Surroundings,
    Wall,
)

SHELL = Shell(
    outer_diameter_m=0.165, height_m=0.417, centre_of_mass_height_m=0.2, floor_clearance_m=0.02
)
FLOOR_Z = -0.22
CABINET = Cabinet(depth_m=0.5, width_m=0.6, height_m=0.7, panel_thickness_m=0.02)


def settings(body=None, **surroundings):
    chosen = {} if body is None else {"body": body}
    return RadiationSettings(surroundings=Surroundings(**surroundings), **chosen)


def in_cells_of_6_mm(cabinet):
    surroundings = Surroundings(cabinet=cabinet)
    return RadiationSettings(surroundings=surroundings, near_field_spacing_m=0.006)


def refused(match, *, body=None, **surroundings):
    """A refusal of the scene in one line."""
    with pytest.raises(ParameterError, match=match) as caught:
        scene(SHELL, settings(body, **surroundings))
    assert "\n" not in str(caught.value)


class TestMachine:
    @pytest.mark.parametrize(
        ("body", "lower", "upper"),
        [
            (None, [-0.0825, -0.0825, -0.2], [0.0825, 0.0825, 0.217]),
            (BoxBody(kind="box", length_m=0.3, width_m=0.2, height_m=0.4), [-0.15, -0.1, -0.2],
             [0.15, 0.1, 0.2]),
            (SphereBody(kind="sphere", diameter_m=0.24), [-0.12, -0.12, -0.2], [0.12, 0.12, 0.04]),
        ],
        ids=["shell", "box", "sphere"],
    )  # fmt: skip
    def test_stands_at_the_height_of_the_shell(self, body, lower, upper):
        """About the centre of mass; facets keep areas and volumes and lie 2e-4 of a radius off."""
        again = machine_body(SHELL, settings(body).body).bounds()
        np.testing.assert_allclose(again, [lower, upper], atol=3e-4 * 0.12)

    def test_mesh_counts_from_the_bottom_in_its_unit(self, tmp_path):
        path = tmp_path / "body.stl"
        trimesh.creation.box(bounds=[[-80, -70, 0], [90, 70, 300]]).export(path)
        body = machine_body(SHELL, MeshBody(kind="mesh", file=str(path)))
        np.testing.assert_allclose(
            body.bounds(), [[-0.08, -0.07, -0.2], [0.09, 0.07, 0.1]], atol=1e-8
        )

    def test_receiver_counts_from_the_floor(self):
        receiver = Receiver(x_m=0.5, y_m=-0.4, height_m=1.2)
        np.testing.assert_allclose(position_m(SHELL, receiver), [0.5, -0.4, 0.98])


class TestWalls:
    def test_floor_alone_by_default(self):
        (floor,) = room_walls(SHELL, settings())
        assert (floor.axis, floor.sign, floor.hard) == (2, -1, True)
        np.testing.assert_allclose(floor.position_m, FLOOR_Z)
        assert room_walls(SHELL, settings(floor=False)) == ()

    def test_distances_and_reflections(self):
        """The pressure that comes back is the root of the energy: sqrt(1 - absorption)."""
        walls = {"-x": Wall(distance_m=1.5), "+y": Wall(distance_m=0.3, absorption_ratio=0.36)}
        _, left, back = room_walls(SHELL, settings(walls=walls))
        assert (left.axis, left.sign, left.position_m, left.hard) == (0, -1, -1.5, True)
        assert (back.axis, back.sign, back.position_m, back.hard) == (1, 1, 0.3, False)
        assert back.reflection == pytest.approx(0.8)
        np.testing.assert_allclose(back.depth_m(np.array([0.0, 0.1, 0.0])), 0.2)
        np.testing.assert_allclose(left.depth_m(np.array([0.1, 0.1, 0.0])), 1.6)
        positions, strengths = images(np.array([0.2, 0.1, 0.0]), (left, back))
        np.testing.assert_allclose(positions[:, 0], [0.2, -3.2, 0.2, -3.2])
        np.testing.assert_allclose(positions[:, 1], [0.1, 0.1, 0.5, 0.5])
        np.testing.assert_allclose(strengths, [1.0, 1.0, 0.8, 0.8])

    def test_near_walls_are_hard_and_close_and_the_floor(self):
        walls = {"-x": Wall(distance_m=0.4), "+y": Wall(distance_m=0.3, absorption_ratio=0.1)}
        near = scene(SHELL, settings(walls=walls)).near_walls
        assert [(wall.axis, wall.sign) for wall in near] == [(2, -1), (0, -1)]
        far = scene(SHELL, settings(walls={"-x": Wall(distance_m=0.9)}))
        assert [wall.axis for wall in far.near_walls] == [2]
        assert len(far.walls) == 2

    def test_machine_in_a_wall_is_refused(self):
        refused(r"is 7\.\d+ mm off the wall across x; needed at least 10 mm",
                walls={"+x": Wall(distance_m=0.09)})  # fmt: skip
        refused(r"is -\d.* mm off the wall across y", walls={"-y": Wall(distance_m=0.05)})

    def test_walls_that_face_each_other_are_refused(self):
        with pytest.raises(ValidationError, match="-x and \\+x face each other: at most one wall"):
            Surroundings(walls={"-x": Wall(distance_m=1.0), "+x": Wall(distance_m=1.0)})


class TestCabinet:
    @staticmethod
    def volume(cabinet, spacing=0.01):
        """Of the union, by a coarse cut; every face of the panels lies in a plane of the grid."""
        body = join_bodies(list(cabinet_panels(cabinet, FLOOR_Z)))
        grid = near_grid(body, spacing)
        cells = np.einsum("i,j,k->ijk", *(grid.widths(axis) for axis in range(3)))
        return ((1.0 - cut_cells(body, grid).volumes) * cells).sum()

    OUTER = 0.54 * 0.64 * 0.72
    INNER = 0.5 * 0.6 * 0.7

    def test_closed(self):
        """Five panels: outer block (floor to lid's top) less the inner one, rounding."""
        assert len(list(cabinet_panels(CABINET, FLOOR_Z))) == 5
        np.testing.assert_allclose(self.volume(CABINET), self.OUTER - self.INNER, rtol=1e-6)

    @pytest.mark.parametrize(
        ("side", "hole"),
        [("-x", 0.02 * 0.6 * 0.7), ("+y", 0.02 * 0.5 * 0.7), ("top", 0.02 * 0.5 * 0.6)],
    )
    def test_open_side(self, side, hole):
        """The neighbours' edges stay: the panel's inside size is missing."""
        cabinet = CABINET.model_copy(update={"open_sides": (side,)})
        assert len(list(cabinet_panels(cabinet, FLOOR_Z))) == 4
        volume = self.OUTER - self.INNER - hole
        np.testing.assert_allclose(self.volume(cabinet), volume, rtol=1e-6)

    @pytest.mark.parametrize(
        "side", ["top", *(pytest.param(side, marks=pytest.mark.long) for side in ("-x", "+y"))]
    )
    def test_opening(self, side):
        """0.2 m x 0.1 m, 20 mm deep, well inside of the panel: four blocks around it."""
        opening = Opening(along_m=0.05, up_m=0.15, width_m=0.2, height_m=0.1)
        cabinet = CABINET.model_copy(update={"openings": {side: opening}})
        panels = list(cabinet_panels(cabinet, FLOOR_Z))
        assert len(panels) == 8
        volume = self.OUTER - self.INNER - 0.2 * 0.1 * 0.02
        np.testing.assert_allclose(self.volume(cabinet), volume, rtol=1e-6)
        body = join_bodies(panels)
        middle = {
            "-x": [-0.26, 0.05, FLOOR_Z + 0.15],
            "+y": [0.05, 0.31, FLOOR_Z + 0.15],
            "top": [0.05, 0.15, FLOOR_Z + 0.71],
        }[side]
        assert not body.contains(np.array(middle))
        across = {"-x": 1, "+y": 0, "top": 0}[side]
        for step, inside in ((0.099, False), (0.101, True), (-0.099, False), (-0.101, True)):
            assert body.contains(np.array(middle) + step * np.eye(3)[across]) == inside

    def test_opening_at_the_floor(self):
        """It reaches the panel's edge: three blocks, and the part below the floor is cut off."""
        opening = Opening(along_m=0.0, up_m=0.0, width_m=0.2, height_m=0.1)
        cabinet = CABINET.model_copy(update={"openings": {"+x": opening}})
        assert len(list(cabinet_panels(cabinet, FLOOR_Z))) == 4 + 3
        volume = self.OUTER - self.INNER - 0.2 * 0.05 * 0.02
        np.testing.assert_allclose(self.volume(cabinet), volume, rtol=1e-6)

    def test_panels_come_after_the_machine_and_stand_still(self):
        with_cabinet = scene(SHELL, settings(cabinet=CABINET))
        alone = scene(SHELL, settings())
        np.testing.assert_array_equal(with_cabinet.machine.triangles, alone.body.triangles)
        bounds = np.stack(with_cabinet.machine.bounds())
        np.testing.assert_array_equal(bounds, np.stack(alone.body.bounds()))
        lower, upper = with_cabinet.body.bounds()
        np.testing.assert_allclose(lower, [-0.27, -0.32, FLOOR_Z])
        np.testing.assert_allclose(upper, [0.27, 0.32, FLOOR_Z + 0.72])
        far = (np.array([-1.0, 1.0]),) * 3
        at = whole_surface(with_cabinet.body, far)
        velocity = with_cabinet.moving(rigid_body("tx")).velocity(at)
        on_machine = np.hypot(at.position[:, 0], at.position[:, 1]) < 0.09
        np.testing.assert_array_equal(velocity[:, 0], on_machine * 1.0)

    def test_machine_that_does_not_fit_is_refused(self):
        for changed in ({"depth_m": 0.18}, {"width_m": 0.18}, {"height_m": 0.44}):
            refused(r"cabinet: the machine is [\d.]+ mm off the panels; needed at least 10 mm",
                    cabinet=CABINET.model_copy(update=changed))  # fmt: skip

    def test_panels_through_a_wall_are_refused(self):
        """The outer face is 0.3 + 0.02 m from the shell's axis; it may touch the wall."""
        refused(r"cabinet: its panels reach through a wall",
                cabinet=CABINET, walls={"+y": Wall(distance_m=0.319)})  # fmt: skip
        scene(SHELL, settings(cabinet=CABINET, walls={"+y": Wall(distance_m=0.32)}))

    def test_cabinet_without_a_floor_is_refused(self):
        with pytest.raises(ValidationError, match="cabinet: stands on the floor"):
            Surroundings(floor=False, cabinet=CABINET)

    def test_thin_panels_are_refused(self):
        thin = CABINET.model_copy(update={"panel_thickness_m": 0.0088})
        with pytest.raises(ValidationError, match=r"panel_thickness_mm = 8\.8 mm: thinner than a"):
            in_cells_of_6_mm(thin)
        in_cells_of_6_mm(CABINET.model_copy(update={"panel_thickness_m": 0.009}))
        settings(cabinet=thin)  # automatic cells are as thin as the panels ask for


class TestFilePatterns:
    """A block of 12 faces and 8 vertices whose velocities come from files."""

    MACHINE = block(np.array([-0.1, -0.1, 0.0]), np.array([0.1, 0.1, 0.3]))

    def pattern(self, path) -> Pattern:
        (pattern,) = file_patterns(
            MeshBody(kind="mesh", file="unused.stl", patterns={"bulge": str(path)}), self.MACHINE
        )
        return pattern

    def points(self):
        edges = np.linspace(-0.35, 0.35, 29)
        return whole_surface(self.MACHINE, (edges, edges, edges))

    def write(self, tmp_path, values):
        path = tmp_path / "bulge.csv"
        np.savetxt(path, values, delimiter=",")
        return path

    def test_no_mesh_no_patterns(self):
        assert file_patterns(SphereBody(kind="sphere", diameter_m=0.2), self.MACHINE) == []

    def test_number_for_each_face(self, tmp_path):
        values = np.arange(12.0)
        pattern, at = self.pattern(self.write(tmp_path, values)), self.points()
        assert pattern.name == "bulge"
        np.testing.assert_allclose(pattern.velocity(at), values[at.face][:, None] * at.normal)

    @pytest.mark.parametrize("number", [12, 8], ids=["face", "vertex"])
    def test_in_a_cabinet_only_the_machine_moves(self, tmp_path, number):
        """Values of the machine's mesh alone; the panels' faces and corners come after them."""
        panels = tuple(cabinet_panels(CABINET, -0.1))
        pattern = self.pattern(self.write(tmp_path, np.ones(number)))
        whole = Scene(self.MACHINE, panels, ())
        edges = np.linspace(-0.8, 0.8, 9)
        at = whole_surface(whole.body, (edges, edges, edges))
        on_machine = at.face < 12
        assert not on_machine.all()
        expected = at.normal * on_machine[:, None]
        np.testing.assert_allclose(whole.moving(pattern).velocity(at), expected, atol=1e-12)

    def test_vector_for_each_face(self, tmp_path):
        values = np.random.default_rng(1).standard_normal((12, 3))
        at = self.points()
        velocity = self.pattern(self.write(tmp_path, values)).velocity(at)
        np.testing.assert_allclose(velocity, values[at.face])

    def test_number_for_each_vertex_is_linear_between(self, tmp_path):
        values = 2.0 + self.MACHINE.vertices @ [3.0, -1.0, 0.5]
        at = self.points()
        velocity = self.pattern(self.write(tmp_path, values)).velocity(at)
        expected = (2.0 + at.position @ [3.0, -1.0, 0.5])[:, None] * at.normal
        np.testing.assert_allclose(velocity, expected, atol=1e-12)

    def test_vector_for_each_vertex_is_a_rotation(self, tmp_path):
        """A rigid rotation is linear in place: the file gives what the pattern `rx` gives."""
        values = np.cross([1.0, 0.0, 0.0], self.MACHINE.vertices)
        at = self.points()
        velocity = self.pattern(self.write(tmp_path, values)).velocity(at)
        np.testing.assert_allclose(velocity, rigid_body("rx").velocity(at), atol=1e-12)

    @pytest.mark.parametrize("shape", [(11,), (13, 3), (8, 2), (1,), (3, 8)])
    def test_wrong_length_is_refused(self, tmp_path, shape):
        self.refused(self.write(tmp_path, np.ones(shape)), "the mesh has 12 faces and 8 vertices")

    @pytest.mark.parametrize("content", ["1\n2\nthree\n", "1,2,3\n4,5\n", "\x00\x01", "nine"])
    def test_not_a_table_of_numbers_is_refused(self, tmp_path, content):
        path = tmp_path / "bulge.csv"
        path.write_text(content)
        self.refused(path, "radiation.body.patterns.bulge: .*is no table of numbers")

    def test_not_finite_is_refused(self, tmp_path):
        self.refused(
            self.write(tmp_path, [np.nan] * 12), "pattern bulge: holds values that are not"
        )

    def test_missing_is_refused(self, tmp_path):
        self.refused(tmp_path / "none.csv", "radiation.body.patterns.bulge: .*cannot be read")

    def test_nothing_is_refused(self, tmp_path):
        (tmp_path / "bulge.csv").write_text("")
        self.refused(tmp_path / "bulge.csv", "bulge")

    def test_not_text_is_refused(self, tmp_path):
        (tmp_path / "bulge.csv").write_bytes(b"\xff\xfe\x00\x80" * 9)
        self.refused(tmp_path / "bulge.csv", "radiation.body.patterns.bulge: .*is no table")

    def refused(self, path, match):
        with pytest.raises(ParameterError, match=match) as caught:
            self.pattern(path)
        assert "\n" not in str(caught.value)
