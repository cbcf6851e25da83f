"""Branches of a recording, from the speed of its blocks."""

import numpy as np
import pytest

from vibroacoustics.orders.branches import branch_of_blocks, load_levels, states_of_blocks


def block_speeds(points, revolutions=6.0):
    """Mean speed, rpm, of half-overlapping blocks of a speed history of times, s, and rpm."""
    time_s = np.linspace(0.0, points[-1][0], 40001)
    hertz = np.interp(time_s, *zip(*points, strict=True)) / 60.0
    turned = np.concatenate([[0.0], np.cumsum(0.5 * (hertz[1:] + hertz[:-1]) * np.diff(time_s))])
    edges = np.arange(0.0, turned[-1], revolutions / 2.0)
    at = np.interp(edges, turned, time_s)
    return 60.0 * revolutions / (at[2:] - at[:-2])


def names(speed_rpm):
    branch = branch_of_blocks(speed_rpm, np.ones_like(speed_rpm))
    return list(dict.fromkeys(branch[branch != ""].tolist())), branch


@pytest.mark.parametrize(
    ("points", "expected"),
    [
        ([(0, 3000), (20, 3000)], ["dwell"]),
        ([(0, 3000), (20, 3200)], ["dwell"]),  # 6 %: several speeds of one state
        ([(0, 900), (20, 3000)], ["run-up"]),
        ([(0, 600), (40, 6000)], ["run-up"]),
        ([(0, 3000), (20, 900)], ["coast-down"]),
        ([(0, 900), (20, 3000), (40, 900)], ["run-up", "coast-down"]),
        ([(0, 900), (20, 3000), (40, 3000)], ["run-up", "dwell"]),
        ([(0, 900), (5, 3000), (10, 900), (15, 3000)], ["run-up 1", "coast-down", "run-up 2"]),
        (
            [(0, 3000), (9, 3000), (12, 900), (15, 3000), (24, 3000)],
            ["dwell 1", "coast-down", "run-up", "dwell 2"],
        ),
    ],
)
def test_branches_of_a_speed_history(points, expected):
    speed_rpm = block_speeds(points)
    scatter = 1.0 + 0.001 * np.random.default_rng(0).standard_normal(speed_rpm.size)
    assert names(speed_rpm)[0] == expected
    assert names(speed_rpm * scatter)[0] == expected


@pytest.mark.parametrize(
    "speed_rpm",
    [
        6000.0 / (1.0 + np.linspace(0.0, 10.0, 400)),
        3600.0 * np.exp(-np.linspace(0.0, 2.0, 400)),
        900.0 + np.linspace(0.0, 2100.0, 400),
    ],
)
def test_a_slow_change_is_one_branch(speed_rpm):
    assert len(names(speed_rpm)[0]) == 1


def test_the_vertex_of_a_parabola_is_no_dwell():
    time_s = np.linspace(-1.0, 1.0, 600)
    assert names(3000.0 - 1500.0 * time_s**2)[0] == ["run-up", "coast-down"]


def test_a_speed_that_swings_has_a_branch_of_each_direction():
    speed_rpm = 3000.0 * (1.0 + 0.1 * np.sin(np.linspace(0.0, 60.0, 2000)))
    assert sorted(names(speed_rpm)[0]) == ["coast-down", "run-up"]


def test_blocks_at_a_border_have_no_branch():
    """A block at the turn, of which half is in each branch, and those that overlap it."""
    speed_rpm = block_speeds([(0, 900), (20, 3000), (40, 900)])
    turn = int(np.argmax(speed_rpm))
    assert set(names(speed_rpm)[1][turn - 1 : turn + 2]) == {""}
    assert np.count_nonzero(names(speed_rpm)[1] == "") == 4


def test_few_blocks_have_a_branch():
    assert names(np.array([900.0, 1300.0, 900.0]))[0] != []


def states(square):
    return states_of_blocks(np.asarray(square)).tolist()


def test_idle_is_a_state_of_many_blocks():
    square = [1e-3] * 20 + [1.0] * 40 + [1e-3] * 20
    assert states(square) == ["idle"] * 20 + [""] * 4 + ["dwell"] * 32 + [""] * 4 + ["idle"] * 20
    assert set(states([1e-3] * 5 + [1.0] * 40)) == {"dwell"}
    assert set(states([0.2] * 20 + [1.0] * 40)) == {"dwell"}  # 7 dB: a load, not a stop


def test_a_start_is_no_state():
    """Five blocks at -6 dB on the way from idle to running belong to neither."""
    assert states([1e-3] * 20 + [0.25] * 5 + [1.0] * 40)[20:25] == [""] * 5


@pytest.mark.parametrize("seed", range(5))
def test_noise_and_beats_are_not_idle(seed):
    rng = np.random.default_rng(seed)
    assert set(states(rng.chisquare(4, 500))) == {"dwell"}
    assert set(states(np.cos(np.linspace(0.0, 6.0 + seed, 400)) ** 2)) == {"dwell"}


def test_two_loads_have_two_levels():
    """Half of the blocks at half the amplitude: 6 dB."""
    noise = 1.0 + 0.05 * np.random.default_rng(0).standard_normal(200)
    low, high, louder = load_levels(np.where(np.arange(200) < 80, 1.0, 0.25) * noise)
    assert high / low == pytest.approx(4.0, rel=0.05)
    assert louder == pytest.approx(80, abs=1)


@pytest.mark.parametrize("seed", range(5))
def test_noise_beats_and_drifts_have_one_level(seed):
    rng = np.random.default_rng(seed)
    assert load_levels(rng.chisquare(4, 500)) is None
    assert load_levels(rng.chisquare(40, 30)) is None
    assert load_levels(np.cos(np.linspace(0.0, 6.0 + seed, 400)) ** 2) is None
    assert load_levels(np.linspace(1.0, 2.0 + seed, 300)) is None
    assert load_levels(np.ones(40)) is None
