"""Numbers of arrays with as many digits as their text."""

import numpy as np

from vibroacoustics.base import rounding


def test_digits_of_many_values_are_those_of_their_text():
    """At a half of the last digit rounding of the product may decide, by one unit."""
    generator = np.random.default_rng(1)
    values = generator.uniform(-1.0, 1.0, 20_000) * 10.0 ** generator.uniform(-40.0, 30.0, 20_000)
    values[:2] = 0.0, 1e-30
    by_text = np.array([float(f"{value:.14g}") for value in values])
    rounded = rounding.to_digits(values, 14)
    np.testing.assert_allclose(rounded, by_text, rtol=1e-13)
    assert np.mean(rounded == by_text) > 0.99
    short = np.array([float(f"{value:.12g}") for value in values])
    np.testing.assert_array_equal(rounding.to_digits(short * (1.0 + 1e-16), 14), short)
