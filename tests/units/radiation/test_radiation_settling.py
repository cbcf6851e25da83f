"""Runs of the machine side end by what they still change at the microphones."""

import numpy as np
import pytest
from support import radiated

from vibroacoustics.base.errors import SolverError
from vibroacoustics.base.revolution import capped_cylinder
from vibroacoustics.radiation import near_run
from vibroacoustics.radiation.bodies import turned
from vibroacoustics.radiation.cut_cells import Settling, spread_points, watched_frequencies
from vibroacoustics.radiation.exact import Mirror
from vibroacoustics.radiation.machine_side import MachineSide, near_fields
from vibroacoustics.radiation.near_field import NearField
from vibroacoustics.radiation.patterns import rigid_body
from vibroacoustics.radiation.scene import Scene
from vibroacoustics.radiation.task import Microphones

FREQUENCY_HZ = np.array([50.0, 117.0, 500.0, 1000.0])
CAN = turned(capped_cylinder(0.083, -0.11, 0.14, 0.03))


def settled(decay, blocks, other=0.0):
    """What remains of a pressure of 1 whose distance falls by a factor a block, as estimated."""
    settling = Settling(np.full(1, other))
    for block in range(blocks):
        settling.add(np.array([[1.0 - 0.5 * decay**block]], dtype=complex))
    return settling.remaining()[0]


class TestEstimate:
    @pytest.mark.parametrize("decay", [0.3, 0.7, 0.85])
    def test_covers_what_an_exponential_leaves(self, decay):
        left = 0.5 * decay**14
        assert left < settled(decay, 15) < 12.0 * left / decay**2

    def test_nothing_is_known_at_first(self):
        assert settled(0.5, 5) == np.inf

    def test_a_part_counts_against_the_others(self):
        assert settled(0.7, 12, other=100.0) == pytest.approx(settled(0.7, 12) / 100.0, rel=0.02)


def test_points_are_spread():
    points = np.array(
        [[0.0, 0, 0], [0.1, 0, 0], [0, 0.1, 0], [5, 0, 0], [0, 5, 0], *np.zeros((9, 3))]
    )
    assert {tuple(point) for point in spread_points(points)[:3]} == {
        (0, 0, 0),
        (5, 0, 0),
        (0, 5, 0),
    }


def test_the_lowest_and_the_highest_frequency_are_watched():
    frequency = np.concatenate([np.arange(25.0, 2501.0, 25.0), [48.3, 10.0]])
    watched = frequency[watched_frequencies(frequency)]
    assert {10.0, 25.0, 48.3, 50.0, 2500.0} <= set(watched)
    assert watched.size < 30


@pytest.mark.parametrize(
    "dof", ["tx", *(pytest.param(dof, marks=pytest.mark.long) for dof in ("tz", "ry"))]
)
def test_ends_early_and_changes_no_level(dof, monkeypatch):
    """Against runs to 3e-8 of the peak: 0.01 dB at the loudest, fewer steps."""
    steps, results = [], []
    for settled_share in (0.0, near_run.SETTLED):
        monkeypatch.setattr(near_run, "SETTLED", settled_share)
        told = []
        side = _side([rigid_body(dof)], lambda name, step, number, told=told: told.append(step))
        steps.append(len(told))
        results.append(side.closed[0].pressure)
    long, short = results
    change = np.abs(short - long).max(axis=0) / np.abs(long).max(axis=0)
    assert change.max() < 0.0012, change
    assert steps[1] < 0.8 * steps[0], steps


def _side(patterns, progress=lambda *_: None):
    scene = Scene(CAN, (), (Mirror(2, -1, -0.15),))
    points = np.array([[1.0, 0.2, 0.1], [-0.5, 0.8, 0.6], [0.2, -0.3, 1.0]])
    near = near_fields(scene, 0.02, 1000.0)
    return MachineSide(scene, near, patterns, FREQUENCY_HZ, [Microphones(points)], progress)


@pytest.mark.long
def test_fields_are_joined_a_few_at_a_time(monkeypatch):
    """One pattern at a time gives what all at once give, and only some are asked for somewhere."""
    patterns = [rigid_body(dof) for dof in ("tx", "rz", "tz")]
    together = _side(patterns).closed[0]
    monkeypatch.setattr("vibroacoustics.radiation.machine_side.FIELDS_BYTES", 1.0)
    alone = _side(patterns).closed[0]
    np.testing.assert_allclose(alone.finer, together.finer, rtol=1e-12)
    np.testing.assert_allclose(alone.coarser, together.coarser, rtol=1e-12)
    assert np.all(np.abs(alone.finer[:, [0, 2]]).max(axis=0) > 0.0)
    assert not alone.finer[:, 1].any()


@pytest.mark.parametrize(
    ("mean", "swing", "words"),
    [
        (1.0, 0.0, "keeps its sign"),
        (-1.0, 0.5, "keeps its sign"),
        (0.0, 1.0, "changes its sign"),
        (0.2, 1.0, "changes its sign"),
    ],
)
def test_a_refusal_names_what_is_left(mean, swing, words):
    """Pressures after many passages: a rest keeps its sign, a mode changes it."""
    peaks = near_run._Peaks(0.9)
    for passage in range(80):
        for step in range(10):
            turn = 2.0 * np.pi * 0.37 * (10 * passage + step)
            peaks.add(np.array([0.01, mean + swing * np.cos(turn)]))
        peaks.expected(100)
    assert words in peaks.reason()


def test_a_mode_that_rings_on_is_refused_soon(monkeypatch):
    """As if a share of the pressure stayed: refused by its decay long before the last passage."""
    monkeypatch.setattr(near_run._Peaks, "share", lambda _: 0.02)
    monkeypatch.setattr(near_run, "SETTLED", 0.0)
    steps = []
    with pytest.raises(
        SolverError, match=r"tx: the pressure has not died down: what is left changes its sign"
    ):
        radiated(
            NearField(CAN, 0.03, 1000.0),
            rigid_body("tx"),
            FREQUENCY_HZ,
            lambda name, step, number: steps.append(step / number),
        )
    assert max(steps) < 0.5
