"""Walls too thin for the grid are refused, not leaked through; narrow cells keep the time step."""

import numpy as np
import pytest
from radiation_parts import floor, revolved
from support import radiated

from vibroacoustics.base.errors import ParameterError, SolverError
from vibroacoustics.base.revolution import capped_cylinder
from vibroacoustics.radiation import near_grid as near_grid_module
from vibroacoustics.radiation.bodies import block, join_bodies, sphere, turned
from vibroacoustics.radiation.by_cut_cells import check_grids_agree, check_walls, solid_parts
from vibroacoustics.radiation.exact import Mirror
from vibroacoustics.radiation.machine_side import Radiated, near_fields
from vibroacoustics.radiation.near_field import NearField
from vibroacoustics.radiation.near_grid import COURANT_NUMBER, near_grid
from vibroacoustics.radiation.patterns import rigid_body
from vibroacoustics.radiation.scene import Scene

MACHINE = turned(capped_cylinder(0.0825, -0.19, 0.1))


def cup(wall_m, radius_m=0.15, bottom_m=-0.26, height_m=0.5):
    """Round cup with an open top."""
    inner, top = radius_m - wall_m, bottom_m + height_m
    outline = [(radius_m, bottom_m), (radius_m, top), (inner, top), (inner, bottom_m + wall_m)]
    return revolved(outline, bottom_m, bottom_m + wall_m)


def coarser(body, spacing_m):
    return near_fields(Scene(body, (), ()), spacing_m, 1000.0)[1].grid


class TestThinWalls:
    @pytest.mark.parametrize("wall_m", [0.001, 0.004, 0.012])
    def test_a_cup_of_a_wall_thinner_than_a_cell_is_refused(self, wall_m):
        body = join_bodies([MACHINE, cup(wall_m)])
        with pytest.raises(ParameterError, match=r"spacing_mm = 12 mm: .* % of the cells .*leak"):
            check_walls(body, coarser(body, 0.012), 0.012)

    @pytest.mark.parametrize(("wall_m", "spacing_m"), [(0.036, 0.0138), (0.02, 0.0076)])
    def test_the_spacing_that_is_asked_for_will_do(self, wall_m, spacing_m):
        body = join_bodies([MACHINE, cup(wall_m)])
        check_walls(body, coarser(body, spacing_m), spacing_m)

    @pytest.mark.parametrize(
        "body",
        [
            MACHINE,
            sphere(0.1, (0.003, 0.001, 0.002)),
            join_bodies([MACHINE, block(np.array([-0.12, 0.01, -0.1]), np.array([0, 0.014, 0.1]))]),
            join_bodies(
                [MACHINE, block(np.array([-0.12, -0.1, -0.19]), np.array([0, 0.1, -0.187]))]
            ),
        ],
        ids=["can", "ball", "fin", "foot"],
    )
    def test_what_air_goes_round_is_not(self, body):
        check_walls(body, coarser(body, 0.012), 0.012)


@pytest.mark.long
def test_a_machine_in_a_hard_cup_is_refused():
    """36 mm of wall, a gap of a cell and a half at 24 mm: sideways a mode rings on between them."""
    surroundings = Scene(MACHINE, (cup(0.036),), ())
    near = NearField(surroundings.body, 0.024, 1500.0)
    moving = surroundings.moving(rigid_body("tx"))
    with pytest.raises(
        SolverError, match=r"tx: the pressure has not died down: what is left .* % after"
    ):
        radiated(near, moving, np.arange(100.0, 1501.0, 100.0))


def test_grids_that_disagree_are_refused():
    finer = np.ones((2, 6, 10), dtype=complex)
    coarser_one = finer.copy()
    coarser_one[:, 3:] = 0.0  # weak motions
    finer[:, 1], coarser_one[:, 1] = 0.01, 0.03  # silent by symmetry but for the grid's errors
    check_grids_agree(Radiated(finer, coarser_one), 0.024)
    coarser_one[:, 2, :7] = 2.5
    with pytest.raises(ParameterError, match=r"mm = 24 mm: .* error of tz .* 70 % of its pressure"):
        check_grids_agree(Radiated(finer, coarser_one), 0.024)


def test_parts_beside_an_upper_wall_mirror_those_beside_a_lower_one():
    """The grid ends at the wall, less than the short way from the body."""
    solids = []
    for sign in (-1, 1):
        wall = Mirror(axis=0, sign=sign, position_m=sign * 0.0925)
        solid, start, parts = solid_parts(MACHINE, near_grid(MACHINE, 0.02, [wall]))
        assert solid.shape[0] % parts == 0
        assert start[0] >= 0
        solids.append(solid)
    # Rounding decides on parts that the wall of the can only touches.
    unlike = np.count_nonzero(solids[1][::-1] != solids[0])
    assert unlike < 0.01 * np.count_nonzero(solids[0])


class TestNarrowCells:
    def test_a_gap_does_not_shorten_the_time_step(self):
        """14 mm cells between floor and bottom among those of 20 mm."""
        grid = near_grid(MACHINE, 0.02, (floor(-0.19 - 0.042),))
        assert grid.widths(2).min() == pytest.approx(0.014)
        assert grid.courant_number == COURANT_NUMBER
        assert grid.time_step_s == pytest.approx(COURANT_NUMBER * 0.02 / 343.0)

    def test_the_narrowest_cells_shorten_it_a_little(self):
        """6.7 mm of 20 mm: 4 + 2 · 3² = 22 instead of at most 18."""
        grid = near_grid(MACHINE, 0.02, (floor(-0.21),))
        assert grid.courant_number == pytest.approx(COURANT_NUMBER * np.sqrt(18.0 / 22.0), rel=1e-3)

    @pytest.mark.parametrize("gap_m", [0.042, 0.02])
    def test_the_step_does_not_matter(self, gap_m, monkeypatch):
        """Half the time step changes the field on the box by less than 1 %: it is stable."""
        fields = []
        for courant in (COURANT_NUMBER, COURANT_NUMBER / 2.0):
            monkeypatch.setattr(near_grid_module, "COURANT_NUMBER", courant)
            near = NearField(MACHINE, 0.02, 1000.0, (floor(-0.19 - gap_m),))
            fields.append(radiated(near, rigid_body("tz"), np.array([100.0, 400.0])).outer)
        change = np.abs(fields[0] - fields[1]).max(axis=1) / np.abs(fields[1]).max(axis=1)
        assert np.all(change < 0.01), change
