"""Bodies of every kind of shape and surroundings radiate fields of monopoles inside them."""

import numpy as np
import pytest
from manufactured import Field, errors
from radiation_parts import floor

from vibroacoustics.radiation.bodies import Body, block, checked_mesh, cylinder, sphere
from vibroacoustics.radiation.mirrors import Mirror

AROUND = np.array([[0.9, 0.3, 0.2], [-0.4, 0.8, 0.5], [0.2, -0.7, 0.9], [0.1, 0.2, 1.1]])
CORNER = (floor(-0.22), Mirror(0, -1, -0.25), Mirror(1, -1, -0.3))


def turned(body: Body, angle: float) -> Body:
    """About the y axis."""
    cosine, sine = np.cos(angle), np.sin(angle)
    turn = np.array([[cosine, 0.0, sine], [0.0, 1.0, 0.0], [-sine, 0.0, cosine]])
    return Body(body.vertices @ turn.T, body.faces)


def ellipsoid() -> Body:
    ball = sphere(1.0)
    return turned(Body(ball.vertices * np.array([0.14, 0.1, 0.12]), ball.faces), 0.4)


def prism() -> Body:
    """Shaped like an L, tilted; its sides are fans about the inner corner."""
    outline = [
        (-0.02, -0.02),
        (-0.02, 0.12),
        (-0.12, 0.12),
        (-0.12, -0.12),
        (0.12, -0.12),
        (0.12, -0.02),
    ]
    vertices = np.array([(x, y, z) for y in (-0.08, 0.08) for x, z in outline])
    near = [(0, first, first + 1) for first in range(1, 5)]
    far = [(6 + a, 6 + c, 6 + b) for a, b, c in near]
    edges = [(first, (first + 1) % 6) for first in range(6)]
    sides = [face for a, b in edges for face in ((b, a, a + 6), (b, a + 6, b + 6))]
    body = checked_mesh(Body(vertices, np.array([*near, *far, *sides])), "prism")
    return turned(body, 0.3)


BOX = block(np.array([-0.12, -0.09, -0.14]), np.array([0.12, 0.09, 0.14]))
DOMED = cylinder(0.1, -0.14, 0.15, 0.04)
SHAPES = {
    "sphere": (sphere(0.12, (0.004, -0.003, 0.002)), (), (0.0, 0.0, 0.0)),
    "domed cylinder on the floor": (DOMED, (floor(-0.16),), (0.0, 0.0, 0.0)),
    "box": (BOX, (), (0.0, 0.0, 0.0)),
    "L-shaped prism": (prism(), (), (-0.06, 0.0, -0.06)),
    "ellipsoid in a corner": (ellipsoid(), CORNER, (0.0, 0.0, 0.0)),
}


@pytest.mark.slow
@pytest.mark.parametrize("shape", SHAPES)
def test_radiates_the_field_of_what_it_holds(shape):
    """A monopole and a weaker one beside it, 20 and 30 mm: 2 % of the largest, 0.17 dB."""
    body, walls, middle = SHAPES[shape]
    sources = np.array(middle) + np.array([[0.01, 0.0, 0.01], [-0.02, 0.02, -0.01]])
    field = Field(sources, np.array([1.0, -0.6]), walls)
    error, estimated = errors(body, field, np.array([100.0, 700.0]), 0.02, AROUND)
    assert np.all(error < 0.02), (error, estimated)
    assert np.all(estimated > 0.0)
