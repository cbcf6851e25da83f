"""Propagation by ISO 9613-2: printed cases of ISO/TR 17534-3, and limits that follow by hand."""

import numpy as np
import pytest

from vibroacoustics.permits.iso_9613_2 import (
    A_WEIGHTING_DB,
    Ground,
    Path,
    Screen,
    alternative_ground_db,
    ground_db,
    octave_levels_db,
    reflection_db,
    screen_db,
)

PATH = Path(float(np.hypot(190.0, 40.0)), 1.0, 4.0)
"""From (10, 10, 1) m to (200, 50, 4) m."""


@pytest.mark.parametrize(
    ("ground", "printed_db", "printed_dba"),
    [
        (Ground(0.0, 0.0, 0.0), "39.90 39.86 39.70 39.37 38.95 38.17 35.47 25.04", 44.29),
        (Ground(0.5, 0.5, 0.5), "39.90 36.17 33.02 33.20 36.11 36.33 33.63 23.20", 41.53),
        (Ground(1.0, 1.0, 1.0), "39.90 32.48 26.33 27.03 33.27 34.49 31.79 21.36", 39.14),
        (Ground(0.2, 0.43, 0.67), "39.90 36.24 35.23 36.04 36.95 36.57 33.87 23.45", 42.23),
        (None, "34.90 34.86 34.71 34.38 33.95 33.17 30.48 20.05", 39.30),
    ],
)
def test_printed_cases(ground, printed_db, printed_dba):
    """ISO/TR 17534-3, T01 to T05: 93 dB in each octave, 20 °C, 70 %; 0.05 dB are allowed."""
    level = octave_levels_db(np.full(8, 93.0), PATH, ground, 293.15, 0.7)
    np.testing.assert_allclose(level, [float(each) for each in printed_db.split()], atol=0.015)
    total = 10.0 * np.log10(np.sum(10.0 ** ((level + A_WEIGHTING_DB) / 10.0)))
    assert total == pytest.approx(printed_dba, abs=0.01)


def test_hard_ground_near_the_source_doubles_the_energy():
    """Without the middle region both regions of hard ground reflect: 3 dB in every octave."""
    np.testing.assert_allclose(ground_db(Path(20.0, 1.0, 1.0), Ground(0, 0, 0)), -3.0)


def test_far_away_the_middle_region_of_hard_ground_adds_its_share():
    """q = 1 - 30 (h_s + h_r)/d, and 3 q dB more."""
    np.testing.assert_allclose(ground_db(Path(240.0, 1.0, 1.0), Ground(0, 0, 0)), -3.0 - 3.0 * 0.75)


def test_the_alternative_method_by_hand():
    """d = 100 m, h_m = 2 m: 4.8 - 0.04 (17 + 3) = 4.0 dB; never below zero."""
    assert alternative_ground_db(Path(100.0, 2.0, 2.0)) == pytest.approx(4.0)
    assert alternative_ground_db(Path(5.0, 2.0, 2.0)) == 0.0
    assert reflection_db(Path(1000.0, 1.0, 1.0)) == pytest.approx(10.0 * np.log10(2.0), abs=1e-4)


def test_a_screen_by_hand():
    """Source and receiver at 1 m, edge of 3 m half way of 20 m: z = 2 (√104 - 10) = 0.396 m."""
    longer = 2.0 * (np.sqrt(104.0) - 10.0)
    weather = np.exp(-np.sqrt(104.0 * 20.0 / (2.0 * longer)) / 2000.0)
    ratio = 3.0 + 20.0 * longer * weather * np.array([63.0, 500.0]) / 340.0
    found = screen_db(Path(20.0, 1.0, 1.0), Screen(10.0, 3.0))
    np.testing.assert_allclose(found[[0, 3]], 10.0 * np.log10(ratio))
    assert found.max() == 20.0


def test_an_edge_on_the_line_of_sight_takes_4_8_db_and_one_far_below_none():
    np.testing.assert_allclose(screen_db(Path(20.0, 1.0, 1.0), Screen(10.0, 1.0)), 4.77, atol=0.01)
    low = screen_db(Path(20.0, 5.0, 5.0), Screen(10.0, 0.1))
    assert np.all(low[2:] == 0.0)


def test_a_screen_takes_the_place_of_porous_ground_and_keeps_the_reflection_of_hard_ground():
    """Attenuation in all: D_z or A_gr, the larger, of porous ground; A_gr + D_z of hard ground."""
    path, screen = Path(50.0, 1.0, 1.5), Screen(5.0, 2.5)
    over_edge = screen_db(path, screen)
    for factor in (0.0, 1.0):
        ground = Ground(factor, factor, factor)
        free, behind = (
            octave_levels_db(np.zeros(8), path, ground, 283.15, 0.7, each)
            for each in (None, screen)
        )
        of_ground = ground_db(path, ground)
        expected = np.where(of_ground > 0.0, np.maximum(over_edge - of_ground, 0.0), over_edge)
        np.testing.assert_allclose(free - behind, expected, atol=1e-9)
