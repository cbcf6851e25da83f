"""Levels: silence, sums, weightings at special frequencies."""

import numpy as np
import pytest

from vibroacoustics.base.vocabulary import WEIGHTINGS
from vibroacoustics.levels import (
    SILENCE_DB,
    WEIGHTING,
    a_weighting,
    c_weighting,
    energy_difference,
    energy_sum,
    sound_pressure_level,
)


def test_level_of_a_complex_peak():
    # |3 + 4j| Pa peak = 5/√2 Pa rms: 20 lg(5/√2/20e-6)
    assert sound_pressure_level(np.array(3.0 + 4.0j)) == pytest.approx(104.948500, abs=1e-6)


def test_reference_pressure_is_zero_db():
    assert sound_pressure_level(np.sqrt(2.0) * 20e-6) == pytest.approx(0.0, abs=1e-12)


def test_silence_is_finite():
    assert sound_pressure_level(0.0) == pytest.approx(SILENCE_DB)
    assert energy_sum(np.array([-np.inf, -np.inf]), axis=0) == pytest.approx(SILENCE_DB)
    assert np.isfinite(a_weighting(0.0))
    assert np.isfinite(c_weighting(0.0))


def test_weightings_are_zero_at_1_khz():
    assert a_weighting(1000.0) == 0.0
    assert c_weighting(1000.0) == 0.0


def test_weighting_of_every_name_of_the_vocabulary():
    assert tuple(WEIGHTING) == WEIGHTINGS


def test_a_weighting_of_the_shaft_lines():
    """Formula E.6 of IEC 61672-1 by hand at 50 Hz."""
    f2 = 50.0**2
    gain = 12194.217**2 * f2**2 / (
        (f2 + 20.598997**2) * (f2 + 12194.217**2)
        * np.sqrt((f2 + 107.65265**2) * (f2 + 737.86223**2))
    )  # fmt: skip
    # The standard's constant: A at 1 kHz before normalising is -2.000 dB.
    assert a_weighting(50.0) == pytest.approx(20.0 * np.log10(gain) + 2.0, abs=5e-4)


def test_sum_of_two_equal_levels():
    assert energy_sum(np.array([56.0, 56.0]), axis=0) == pytest.approx(59.0103, abs=5e-5)


def test_sum_over_several_axes():
    levels = np.zeros((2, 5, 3))
    np.testing.assert_allclose(energy_sum(levels, axis=(0, 1)), np.full(3, 10.0))


@pytest.mark.parametrize(
    ("line", "change"),
    [(40.0, -0.11), (45.0, -0.36), (50.0, -1.26)],  # 10 lg(10^5.6 - 10^(L/10)) - 56
)
def test_what_a_line_is_worth(line, change):
    assert energy_difference(56.0, line) - 56.0 == pytest.approx(change, abs=0.005)
