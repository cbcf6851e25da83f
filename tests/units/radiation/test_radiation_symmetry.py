"""Mirror symmetry on the machine side: which bodies have it, and that it changes no result."""

import dataclasses

import numpy as np
import pytest
from radiation_parts import floor
from support import radiated

from vibroacoustics.base.revolution import capped_cylinder
from vibroacoustics.radiation.bodies import Body, block, join_bodies, sphere, turned
from vibroacoustics.radiation.exact import Mirror
from vibroacoustics.radiation.near_field import NearField
from vibroacoustics.radiation.near_grid import near_grid
from vibroacoustics.radiation.near_run import Recording
from vibroacoustics.radiation.patterns import Pattern, rigid_body
from vibroacoustics.radiation.symmetry import symmetric_axes

CAN = turned(capped_cylinder(0.083, -0.11, 0.14, 0.03))
FOOT = block(np.array([-0.1, -0.03, -0.11]), np.array([0.0, 0.03, -0.07]))
FREQUENCY_HZ = np.array([48.0, 117.0, 500.0, 1000.0])


def turned(body, angle):
    """Turned about the z axis."""
    turn = np.array(
        [[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]]
    )
    return Body(body.vertices @ turn.T, body.faces)


def test_grid_of_a_body_has_no_length_of_its_own():
    """All lengths times 50: the same planes, with a face of 144 mm² that is below 10 % of a unit's.

    Planes are rounded to 1e-7 m.
    """
    lower, upper = np.zeros(3), np.array([0.3, 0.24, 0.18])
    pin = block(np.array([0.04, 0.05, 0.18]), np.array([0.052, 0.062, 0.28]))
    body = join_bodies([block(lower, upper), pin])
    small = near_grid(body, 0.02, box_margin_m=0.04)
    large = near_grid(Body(50.0 * body.vertices, body.faces), 1.0, box_margin_m=2.0)
    for one, other in zip(small.edges, large.edges, strict=True):
        np.testing.assert_allclose(50.0 * one, other, atol=1e-5)
    assert (small.box_start, small.box_stop) == (large.box_start, large.box_stop)


class TestAxes:
    @pytest.mark.parametrize(
        ("body", "axes"),
        [
            (sphere(0.1, (0.003, 0.001, 0.002)), (0, 1, 2)),
            (CAN, (0, 1, 2)),
            (join_bodies([CAN, FOOT]), (1,)),
            (turned(block(-np.array([0.1, 0.06, 0.08]), np.array([0.1, 0.06, 0.08])), 0.3), (2,)),
        ],
        ids=["sphere", "can", "can with a foot", "turned block"],
    )
    def test_found_in_the_shape(self, body, axes):
        assert symmetric_axes(body) == axes

    def test_found_in_single_precision_and_whatever_the_triangles(self):
        """As an STL file holds them; the faces of a revolved outline are cut in one sense."""
        single = Body(CAN.vertices.astype(np.float32).astype(float), CAN.faces)
        assert symmetric_axes(single) == (0, 1, 2)

    def test_a_side_wider_by_a_hundredth_breaks_it(self):
        vertices = CAN.vertices.copy()
        vertices[vertices[:, 0] > 0.0, 0] *= 1.01
        assert symmetric_axes(Body(vertices, CAN.faces)) == (1, 2)

    def test_walls_break_it_across_themselves(self):
        assert near_grid(CAN, 0.02, [floor(-0.15)]).mirrored == (0, 1)
        assert near_grid(CAN, 0.02, [floor(-0.15), Mirror(0, 1, 0.3)]).mirrored == (1,)


def everything(at):
    """Translation, rotation, breathing and bending at once: no symmetry at all."""
    x, y, z = at.position.T
    bending = np.stack([np.cos(20.0 * z), x * 30.0 * y, np.sin(25.0 * x)], axis=1)
    return np.array([1.0, 0.5, 0.7]) + np.cross([3.0, -7.0, 5.0], at.position) + bending


@pytest.mark.slow
@pytest.mark.parametrize("walls", [(), (floor(-0.15),)], ids=["free", "floor"])
@pytest.mark.parametrize(
    "pattern",
    [
        *(pytest.param(rigid_body(dof), marks=pytest.mark.long) for dof in ("tx", "ry")),
        Pattern("everything", everything),
    ],
    ids=lambda pattern: pattern.name,
)
def test_equals_the_whole_grid(walls, pattern):
    """The same cells, in one run of the whole grid and in runs of its half, quarter or eighth.

    What is left: parts of the flux up to 1e-4 of it are left out. Runs end at other times.
    """
    part = NearField(CAN, 0.02, 1000.0, walls)
    whole = NearField(CAN, 0.02, 1000.0, walls)
    whole.cells = part.cells
    whole.grid = dataclasses.replace(part.grid, mirrored=())
    ours, theirs = (radiated(near, pattern, FREQUENCY_HZ) for near in (part, whole))
    for field, expected in ((ours.inner, theirs.inner), (ours.outer, theirs.outer)):
        largest = np.abs(expected).max(axis=1)
        error = np.abs(field - expected).max(axis=1) / largest
        assert np.all(error < 1e-4), error


@pytest.mark.parametrize("parity", [1, -1])
def test_join_takes_images_with_the_sign_of_their_parity(parity):
    """Three pairs, the third the image of the first: sum of w (p_i G_o - p_o G_i), by hand."""
    columns = np.array([[0, 1, 0], [2, 3, 2]])
    across = np.array([[[False, False, True], [False, False, True]]])
    recorded = Recording(np.arange(4), columns, across, np.array([2.0, 3.0, 5.0]))
    pressure, inner, outer = np.array([7.0, 11.0, 13.0, 17.0]), [1.0, -4.0, 6.0], [9.0, 8.0, -2.0]
    expected = 2.0 * (7.0 * 9.0 - 13.0 * 1.0) + 3.0 * (11.0 * 8.0 + 17.0 * 4.0)
    expected += 5.0 * parity * (7.0 * -2.0 - 13.0 * 6.0)
    assert pressure @ (recorded.join_matrix((parity,)) @ [*inner, *outer]) == expected


def test_one_run_for_a_motion_along_an_axis():
    """And a quarter of the cells; a rocking body free of the floor needs two runs of an eighth."""
    runs = []
    near = NearField(CAN, 0.02, 1000.0, (floor(-0.15),))
    radiated(near, rigid_body("tx"), FREQUENCY_HZ, lambda name, step, steps: runs.append(step))
    assert runs.count(0) == 1
    assert 4 * np.prod(near.grid.upper_half.shape) == np.prod(near.grid.shape)
