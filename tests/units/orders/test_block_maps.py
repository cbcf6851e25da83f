"""Order map of a recording in blocks: the same as of the whole."""

from itertools import pairwise

import numpy as np
import pytest

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.orders import angular_resample, from_speed, order_map, order_map_of_blocks

RATE_HZ = 4096.0
MOTION = from_speed(np.linspace(0.0, 8.0, 9), np.linspace(20.0, 45.0, 9))
SIGNAL = np.random.default_rng(3).standard_normal((2, int(8.0 * RATE_HZ)))


def in_blocks(lengths):
    edges = np.cumsum([0, *lengths])
    return (SIGNAL[:, first:last] for first, last in pairwise(edges))


@pytest.mark.parametrize("lengths", [[32768], [1, 8191, 16384, 8192], [1024] * 32])
def test_blocks_make_the_map_of_the_whole(lengths):
    whole = order_map(angular_resample(SIGNAL, RATE_HZ, MOTION, 30.0), 0.25)
    spectra = order_map_of_blocks(in_blocks(lengths), SIGNAL.shape[1], RATE_HZ, MOTION, 30.0, 0.25)
    np.testing.assert_array_equal(spectra.starts, whole.starts)
    np.testing.assert_allclose(spectra.time_s, whole.time_s, rtol=1e-12)
    np.testing.assert_allclose(spectra.amplitude, whole.amplitude, atol=1e-15)
    np.testing.assert_allclose(spectra.shaft_frequency_hz, whole.shaft_frequency_hz, rtol=1e-12)
    assert spectra.revolutions == whole.revolutions


def test_blocks_that_end_early_are_refused():
    with pytest.raises(ParameterError, match="hold fewer than the 32768 samples stated"):
        order_map_of_blocks(in_blocks([16384]), SIGNAL.shape[1], RATE_HZ, MOTION, 30.0, 0.25)
