"""Counterweights by least squares, by the worst speed, and in bolt holes."""

from itertools import permutations, product

import numpy as np
import pytest

from vibroacoustics.mechanics.balancing.moments import (
    chosen_moments,
    least_squares_moments,
    sums_of_squares,
    worst_speed_moments,
)

SEED = 1964


def case(weights, speeds=3, rows=6):
    """Random response and influence, of the sizes of forces and of rotors."""
    rng = np.random.default_rng(SEED + weights)

    def normal(*shape):
        return rng.standard_normal(shape) + 1j * rng.standard_normal(shape)

    return 50.0 * normal(speeds, rows), 1e5 * normal(speeds, rows, weights)


def determinant(matrix):
    """Determinant by its definition."""
    size, total = len(matrix), 0.0
    for order in permutations(range(size)):
        swaps = sum(order[i] > order[j] for i in range(size) for j in range(i + 1, size))
        total += (-1.0) ** swaps * np.prod([matrix[i, j] for i, j in enumerate(order)])
    return total


@pytest.mark.parametrize("weights", [1, 2, 3, 4])
def test_least_squares_are_the_closed_form(weights):
    """Cramer's rule for the normal equations."""
    response, influence = case(weights)
    rows, b = influence.reshape(-1, weights), response.ravel()
    normal, right = rows.conj().T @ rows, -rows.conj().T @ b
    moment = least_squares_moments(response, influence)
    for number in range(weights):
        replaced = normal.copy()
        replaced[:, number] = right
        expected = determinant(replaced) / determinant(normal)
        assert moment[number] == pytest.approx(expected, rel=1e-9)


def test_one_weight_at_two_speeds_is_the_closed_form():
    """|b1 + a1 u| = |b2 + a2 u| on the line between the two roots."""
    rng = np.random.default_rng(SEED)
    (b1, b2), (a1, a2) = rng.standard_normal((2, 2)) + 1j * rng.standard_normal((2, 2))
    first, second = -b1 / a1, -b2 / a2
    share = abs(a2) / (abs(a1) + abs(a2))
    response, influence = np.array([[b1], [b2]]), np.array([[[a1]], [[a2]]])
    (moment,) = worst_speed_moments(response, influence)
    assert moment == pytest.approx(first + share * (second - first), rel=1e-6)
    worst = np.sqrt(sums_of_squares(response, influence, np.array([moment])).max())
    expected = abs(a1) * abs(a2) * abs(second - first) / (abs(a1) + abs(a2))
    assert worst == pytest.approx(expected, rel=1e-7)


@pytest.mark.parametrize("weights", [1, 2, 3, 4])
def test_worst_speed_is_least(weights):
    """No direction lowers it, and least squares of all speeds are no better."""
    response, influence = case(weights, speeds=5)
    moment = worst_speed_moments(response, influence)
    worst = sums_of_squares(response, influence, moment).max()
    squares = least_squares_moments(response, influence)
    assert worst < sums_of_squares(response, influence, squares).max()
    rng = np.random.default_rng(SEED)
    size = 1e-3 * np.abs(moment).max()
    for step in rng.standard_normal((200, weights)) + 1j * rng.standard_normal((200, weights)):
        near = sums_of_squares(response, influence, moment + size * step).max()
        assert near > worst * (1.0 - 1e-7)


def test_dependent_planes_have_the_same_worst_speed():
    response, influence = case(2, speeds=4)
    twice = np.concatenate([influence, influence[..., :1]], axis=-1)
    moment = worst_speed_moments(response, twice)
    worst = sums_of_squares(response, twice, moment).max()
    alone = sums_of_squares(response, influence, worst_speed_moments(response, influence)).max()
    assert worst == pytest.approx(alone, rel=1e-6)


@pytest.mark.parametrize(("weights", "rows"), [(1, 6), (2, 6), (3, 6), (4, 6), (3, 2)])
@pytest.mark.parametrize("speeds", [1, 4])
def test_bolt_holes_are_those_of_trying_all(weights, rows, speeds):
    response, influence = case(weights, speeds, rows)
    least = np.abs(least_squares_moments(response, influence)).mean()
    hole = np.exp(2j * np.pi * np.arange(6) / 6)
    positions = [np.append(least * factor * hole, 0.0) for factor in (0.5, 1.0, 1.5, 0.8)[:weights]]
    numbers = chosen_moments(response, influence, positions)
    every = [np.array(each) for each in product(*positions)]
    sums = np.array([sums_of_squares(response, influence, one).max() for one in every])
    chosen = np.array(
        [position[number] for position, number in zip(positions, numbers, strict=True)]
    )
    found = sums_of_squares(response, influence, chosen).max()
    assert found == pytest.approx(sums.min(), rel=1e-12)
    if len(np.flatnonzero(sums <= sums.min() * (1.0 + 1e-9))) == 1:
        np.testing.assert_array_equal(chosen, every[int(sums.argmin())])


@pytest.mark.parametrize("speeds", [1, 5])
def test_limited_moments_are_within_and_no_other_is_better(speeds):
    response, influence = case(3, speeds)
    free = np.abs(worst_speed_moments(response, influence))
    largest = np.array([0.5, 0.7, np.inf]) * free
    moment = worst_speed_moments(response, influence, largest)
    size = np.abs(moment)
    assert np.all(size <= largest * (1.0 + 1e-6))
    assert size[0] == pytest.approx(largest[0], rel=1e-5)
    worst = sums_of_squares(response, influence, moment).max()
    rng = np.random.default_rng(SEED)
    for step in rng.standard_normal((300, 3)) + 1j * rng.standard_normal((300, 3)):
        near = moment + 1e-3 * free * step
        near /= np.maximum(np.abs(near) / largest, 1.0)
        assert sums_of_squares(response, influence, near).max() > worst * (1.0 - 1e-6)


def test_limits_above_the_moments_change_nothing():
    response, influence = case(2)
    free = worst_speed_moments(response, influence)
    limited = worst_speed_moments(response, influence, 2.0 * np.abs(free))
    np.testing.assert_allclose(limited, free, rtol=1e-5)
