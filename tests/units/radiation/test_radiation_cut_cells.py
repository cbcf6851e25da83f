"""Cut cells, pieces of the surface, what they push, and the grid they lie in."""

import dataclasses

import numpy as np
import pytest
from radiation_parts import floor, normal_velocity
from support import whole_surface

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.base.revolution import capped_cylinder
from vibroacoustics.radiation.bodies import Body, block, join_bodies, sphere, turned
from vibroacoustics.radiation.cut_cells import cut_cells
from vibroacoustics.radiation.exact import Mirror
from vibroacoustics.radiation.near_field import NearField
from vibroacoustics.radiation.near_grid import BOX_MARGIN_M, PML_CELLS, near_grid
from vibroacoustics.radiation.patterns import Pattern, rigid_body

BALL = sphere(0.1, (0.003, 0.001, 0.002))
CAN = turned(capped_cylinder(0.083, -0.11, 0.12))
LINES = 100
"""Lines over the width of a cell's face: what an open area rests on."""


def area(body):
    return np.linalg.norm(body.area_vectors(), axis=1).sum()


def cell_volumes(grid):
    return np.einsum("i,j,k->ijk", *(grid.widths(axis) for axis in range(3)))


def solid_volume(cells, grid):
    return ((1.0 - cells.volumes) * cell_volumes(grid)).sum()


class TestCutCells:
    @pytest.mark.parametrize("body", [BALL, CAN], ids=["ball", "can"])
    def test_wall_of_a_closed_body_has_no_vector_area(self, body):
        """Rounding only: cells beyond the body are whole, and open areas telescope."""
        cells = cut_cells(body, near_grid(body, 0.02))
        np.testing.assert_allclose(cells.wall_areas.sum(axis=0), 0.0, atol=1e-15)

    def test_uniform_pressure_gives_no_moment(self):
        """Cells' middles stand for the wall's, so each row of cells carries opposite forces.

        Exact for every axis: the areas along a row of cells sum to zero, and so do their moments
        about the row's own line. Rounding of some hundred areas of 4e-4 m².
        """
        grid = near_grid(CAN, 0.02)
        cells = cut_cells(CAN, grid)
        middles = grid.middles(cells.wall_cells)
        for axis in range(3):
            force = cells.wall_areas[:, axis]
            for other in {0, 1, 2} - {axis}:
                assert abs(middles[:, other] @ force) < 1e-15

    @pytest.mark.long
    def test_area_and_volume_converge_at_second_order(self):
        """Sphere; a plane replaces the wall in each cell: (h/a)²/24 of the area and less.

        Two steps of 1.5; at second order the error falls by 5.06 over both, 3.4 at order 1.5.
        Summed lengths fluctuate with the cut: a grid's own error is averaged over three places.
        """
        errors = []
        for spacing in (0.036, 0.024, 0.016):
            area_errors, volume_errors = [], []
            for shift in (0.0, 0.0041, 0.0083):
                body = sphere(0.1, (shift, 0.7 * shift, -0.4 * shift))
                grid = _fixed(spacing)
                cells = cut_cells(body, grid)
                total = np.linalg.norm(cells.wall_areas, axis=1).sum()
                area_errors.append(abs(total / (4 * np.pi * 0.01) - 1))
                lowest = solid_volume(cells, grid) / (4 / 3 * np.pi * 0.001) - 1
                volume_errors.append(abs(lowest))
            errors.append([np.mean(area_errors), np.mean(volume_errors)])
        errors = np.array(errors)
        order = np.log(errors[0] / errors[2]) / np.log(2.25)
        assert order[0] > 1.5
        assert errors[2, 0] < 5e-3
        # Exact lines leave the volume the error of 16 x 16 lines a cell and of the lower bound.
        assert np.all(errors[:, 1] < 1e-3)

    def test_block_in_the_grid_is_exact(self):
        """Planes of faces lie in its faces: every cell is whole or solid.

        Lines lie 7e-7 of a cell off their places.
        """
        body = block(np.array([-0.1, -0.06, 0.0]), np.array([0.1, 0.06, 0.3]))
        grid = near_grid(body, 0.02, [floor(-0.05)])
        cells = cut_cells(body, grid)
        for values in (*cells.open_areas, cells.volumes):
            np.testing.assert_allclose(np.minimum(values, 1 - values), 0.0, atol=1e-12)
        np.testing.assert_allclose(solid_volume(cells, grid), 0.2 * 0.12 * 0.3, rtol=1e-12)
        for axis in range(3):
            np.testing.assert_allclose(
                np.abs(cells.wall_areas[:, axis]).sum(),
                2 * 0.2 * 0.12 * 0.3 / (0.2, 0.12, 0.3)[axis],
                rtol=1e-12,
            )

    def test_overlapping_blocks_are_their_union(self):
        """An L of two blocks that overlap, and the same L of two that touch."""
        long = block(np.array([0.003, 0.0, 0.0]), np.array([0.203, 0.1, 0.1]))
        over = block(np.array([0.003, 0.0, 0.0]), np.array([0.103, 0.1, 0.25]))
        upon = block(np.array([0.003, 0.0, 0.0999]), np.array([0.103, 0.1, 0.25]))
        union, again = (join_bodies([long, other]) for other in (over, upon))
        grid = near_grid(union, 0.018)
        ours, theirs = cut_cells(union, grid), cut_cells(again, grid)
        np.testing.assert_allclose(ours.volumes, theirs.volumes, atol=1e-12)
        for a, b in zip(ours.open_areas, theirs.open_areas, strict=True):
            np.testing.assert_allclose(a, b, atol=1e-12)
        expected = 0.2 * 0.1 * 0.1 + 0.1 * 0.1 * 0.15
        # Faces that the grid does not follow end between lines: half of 1/16 of a cell each.
        np.testing.assert_allclose(solid_volume(ours, grid), expected, rtol=0.018 / 32 / 0.1 * 4)

    @pytest.mark.parametrize("body", [BALL, CAN], ids=["ball", "can"])
    def test_volumes_are_bounded_below(self, body):
        cells = cut_cells(body, near_grid(body, 0.02))
        x, y, z = cells.open_areas
        total = x[1:] + x[:-1] + y[:, 1:] + y[:, :-1] + z[:, :, 1:] + z[:, :, :-1]
        assert np.all(cells.volumes >= total / 18.0 - 1e-12)
        assert np.all(cells.volumes[total == 0.0] == 0.0)

    def test_an_open_surface_is_refused(self):
        with pytest.raises(ParameterError, match="not closed"):
            cut_cells(Body(BALL.vertices, BALL.faces[2000:]), near_grid(BALL, 0.02))


def _fixed(spacing):
    """A grid that does not follow the body, wide enough for every shift of it."""
    return dataclasses.replace(near_grid(sphere(0.13), spacing), mirrored=())


class TestSurfacePoints:
    PLANES = tuple(np.arange(-0.2, 0.2, 0.0173) for _ in range(3))

    @pytest.mark.parametrize("body", [BALL, CAN], ids=["ball", "can"])
    def test_pieces_make_up_the_surface(self, body):
        """Sums over about 1e5 pieces: rounding of 1e-16 of the whole times some hundred."""
        points = whole_surface(body, self.PLANES)
        np.testing.assert_allclose(points.area.sum(), area(body), rtol=1e-12)
        np.testing.assert_allclose(points.area @ points.normal, 0.0, atol=1e-13)
        volume = np.einsum("p,pi,pi->", points.area, points.normal, points.position) / 3.0
        whole = np.einsum("fi,fi->", body.triangles[:, 0], body.area_vectors()) / 3.0
        np.testing.assert_allclose(volume, whole, rtol=1e-12)
        by_face = np.bincount(points.face, points.area, body.faces.shape[0])
        np.testing.assert_allclose(by_face, np.linalg.norm(body.area_vectors(), axis=1), rtol=1e-9)

    def test_no_piece_crosses_a_plane(self):
        """Exact means of linear functions between planes: ∮ f n dA of each slab by its pieces.

        A piece that crossed a plane would count as a whole on one side. So the area between two
        planes is compared with that of the cylinder's side, 128 facets wide, and exact.
        """
        height = np.array([-0.1, 0.0, 0.05, 0.1])
        points = whole_surface(CAN, (np.array([-0.3, 0.3]), np.array([-0.3, 0.3]), height))
        side = np.abs(points.normal[:, 2]) < 0.5
        slab = np.searchsorted(height, points.position[side, 2])
        shares = np.bincount(slab, points.area[side])
        lengths = np.diff([-0.11, *height, 0.12])
        np.testing.assert_allclose(shares / shares.sum(), lengths / 0.23, rtol=1e-9)

    def test_weights_are_of_the_triangle(self):
        points = whole_surface(CAN, self.PLANES)
        np.testing.assert_allclose(points.weights.sum(axis=1), 1.0, rtol=1e-12)
        assert points.weights.min() >= -1e-12
        again = np.einsum("pk,pki->pi", points.weights, CAN.triangles[points.face])
        np.testing.assert_allclose(again, points.position, atol=1e-15)

    def test_a_plane_within_a_face(self):
        """Planes in the caps and through every corner leave no sliver of no area out or twice."""
        planes = (np.array([-0.083, 0.0, 0.083]),) * 2 + (np.array([-0.11, 0.0, 0.12]),)
        points = whole_surface(CAN, planes)
        np.testing.assert_allclose(points.area.sum(), area(CAN), rtol=1e-9)


class TestWallFlux:
    NEAR = NearField(BALL, 0.02, 1000.0)

    def flux(self, pattern, near=None):
        near = near or self.NEAR
        return near.wall_fluxes([pattern])[0]

    @pytest.mark.parametrize("dof", ["tx", "ty", "tz"])
    def test_translation_sums_to_nothing(self, dof):
        flux = self.flux(rigid_body(dof))
        assert abs(flux.sum()) < 1e-12 * np.abs(flux).sum()
        axis = "xyz".index(dof[1])
        # A translation on the grid's wall areas; its size by the dipole that is taken off.
        areas = self.NEAR.cells.wall_areas
        size = np.linalg.lstsq(areas, flux, rcond=None)[0]
        np.testing.assert_allclose(flux, areas @ size, atol=1e-12 * np.abs(flux).max())
        np.testing.assert_allclose(size, np.eye(3)[axis], atol=1e-4)

    @pytest.mark.parametrize("dof", ["rx", "ry", "rz"])
    def test_rotation_sums_to_nothing(self, dof):
        near = NearField(Body(CAN.vertices + 0.05, CAN.faces), 0.02, 1000.0)
        flux = self.flux(rigid_body(dof), near)
        assert abs(flux.sum()) < 1e-12 * np.abs(flux).sum()

    def test_pulsating_sphere_has_its_exact_volume_velocity(self):
        """Out of the fluid counts positive: a growing body is minus its area."""
        flux = self.flux(normal_velocity("n", lambda points: np.ones(len(points))))
        np.testing.assert_allclose(flux.sum(), -area(BALL), rtol=1e-12)

    @pytest.mark.parametrize(
        "body", [CAN, turned(capped_cylinder(0.083, -0.11, 0.12, 0.03))], ids=["flat", "dome"]
    )
    def test_sliding_is_silent(self, body):
        near = NearField(body, 0.02, 1000.0)
        np.testing.assert_array_equal(self.flux(rigid_body("rz"), near), 0.0)

    def test_linear(self):
        first, second = rigid_body("tx"), normal_velocity("n", lambda points: points[:, 2])
        both = Pattern("b", lambda at: 2.0 * first.velocity(at) - 3.0 * second.velocity(at))
        expected = 2.0 * self.flux(first) - 3.0 * self.flux(second)
        # The share that makes the sum exact follows the size of the motion, and is no linear
        # function: it is the difference of surface and cells, bounded by the lines' error below.
        np.testing.assert_allclose(self.flux(both), expected, atol=3e-3 * np.abs(expected).max())

    @pytest.mark.parametrize("body", [BALL, CAN], ids=["ball", "can"])
    def test_cells_and_pieces_agree_cell_by_cell(self, body):
        """Two ways to the wall's vector area: open faces by lines, and pieces of the surface.

        A face's open share is a mean over 100 lines: each misses the wall by up to half of 1/100
        of the cell's width, along the outline of a corner at most once each way, so the share errs
        by up to 1/100; a cell has two faces across each axis: 2/100 of a face. Pieces in cells
        that are all but solid belong to their neighbours: these are left out of the comparison.
        """
        near = NearField(body, 0.02, 1000.0)
        points = whole_surface(body, near.grid.edges)
        cell = near.grid.cells_at(points.position + 1e-3 * near.grid.spacing_m * points.normal)
        wall_cells = near.cells.wall_cells
        whole = np.isin(cell, wall_cells)
        wall = np.searchsorted(wall_cells, cell[whole])
        assert points.area[~whole].sum() < 1e-3 * area(body)
        areas = [
            np.bincount(wall, (points.area * part)[whole], wall_cells.size)
            for part in points.normal.T
        ]
        difference = near.cells.wall_areas + np.stack(areas, axis=1)
        assert np.abs(difference).max() < 2.0 / LINES * 0.02**2 * 1.1
        assert np.linalg.norm(difference, axis=1).sum() < 1.0 / LINES * area(body)


class TestNearGrid:
    def test_planes_lie_in_walls_and_plane_faces(self):
        body = block(np.array([-0.1031, -0.06, 0.0]), np.array([0.1007, 0.0613, 0.3]))
        walls = [floor(-0.0317), Mirror(0, 1, 0.2519)]
        grid = near_grid(body, 0.013, walls)
        for axis, planes in enumerate(
            [(-0.1031, 0.1007, 0.2519), (-0.06, 0.0613), (-0.0317, 0.0, 0.3)]
        ):
            for plane in planes:
                assert np.abs(grid.edges[axis] - plane).min() < 1e-12
        assert grid.edges[2][0] == -0.0317
        assert grid.edges[0][-1] == 0.2519
        assert grid.box_start[2] == 0
        assert grid.box_stop[0] == grid.shape[0]
        assert grid.on_walls == {(2, -1), (0, 1)}

    def test_crowding_planes_are_left_out(self):
        """A step of half a cell would need cells of half the size."""
        low = block(np.zeros(3), np.array([0.2, 0.2, 0.1]))
        high = block(np.zeros(3), np.array([0.1, 0.1, 0.106]))
        grid = near_grid(join_bodies([low, high]), 0.013)
        assert np.abs(grid.edges[2] - 0.1).min() < 1e-12
        assert grid.widths(2).min() > 0.013 / 2

    @pytest.mark.parametrize("body", [CAN, BALL], ids=["can", "ball"])
    @pytest.mark.parametrize("spacing", [0.008, 0.02])
    def test_cells_keep_their_size(self, body, spacing):
        """At most a quarter of a unit longer than its cells, at least half (one unit, too long).

        The can is 23 cm high and the wall 3 cm off it, several units or one.
        """
        grid = near_grid(body, spacing, [floor(-0.14)])
        for axis in range(3):
            widths = grid.widths(axis)
            assert widths.max() <= 1.25 * spacing * (1 + 1e-9)
            assert widths.min() >= 0.1 * spacing

    @pytest.mark.parametrize("gap", [0.004, 0.0075, 0.012, 0.027])
    def test_units_share_their_planes(self, gap):
        """Three cells of the finer grid where the coarser one has two, from the floor to the lid.

        However narrow the gap: a plane that crowds one grid is left out of both.
        """
        wall = floor(-0.11 - gap)
        fine = near_grid(CAN, 0.008, [wall], cells_per_unit=3)
        coarse = near_grid(CAN, 0.012, [wall], cells_per_unit=2)
        between = [grid.edges[2][grid.edges[2] <= 0.12 + 1e-9] for grid in (fine, coarse)]
        assert between[0][-1] == pytest.approx(0.12)
        assert (between[0].size - 1) * 2 == (between[1].size - 1) * 3
        np.testing.assert_allclose(between[0][::3], between[1][::2], atol=1e-12)

    @pytest.mark.parametrize("spacing", [0.008, 0.02])
    def test_box_keeps_its_margin(self, spacing):
        grid = near_grid(CAN, spacing, [floor(-0.137)])
        least = max(BOX_MARGIN_M, 3 * spacing) - 1e-9
        lower, upper = CAN.bounds()
        for axis in range(3):
            edges = grid.edges[axis]
            assert edges[grid.box_stop[axis]] - upper[axis] >= least
            if axis < 2:
                assert lower[axis] - edges[grid.box_start[axis]] >= least
                # The absorbing cells and two more lie beyond the box.
                assert grid.box_start[axis] == edges.size - 1 - grid.box_stop[axis] == PML_CELLS + 2
