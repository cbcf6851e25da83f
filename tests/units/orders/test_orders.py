"""Order spectra: amplitude, phase, revolutions, limits."""

import numpy as np
import pytest
from support import CRANK_ANGLE

from vibroacoustics.orders import order_spectra, order_spectrum, order_spectrum_at_speed


def test_amplitude_and_phase_of_a_tone():
    spectrum = order_spectrum(2.0 + 3.0 * np.cos(2.0 * CRANK_ANGLE + 0.5), 5)
    exact = np.zeros(6, complex)
    exact[0], exact[2] = 2.0, 3.0 * np.exp(0.5j)
    np.testing.assert_allclose(spectrum, exact, atol=1e-14)


def test_highest_order_is_the_last():
    assert order_spectrum(np.zeros((2, 3, 256)), 40).shape == (2, 3, 41)


@pytest.mark.parametrize("revolutions", [1, 2, 5])
def test_several_revolutions(revolutions):
    angle = 2.0 * np.pi * np.arange(256 * revolutions) / 256
    signal = np.cos(angle) + 0.2 * np.sin(3.0 * angle) + 0.7
    spectrum = order_spectrum(signal, 10, revolutions)
    expected = np.zeros(11, complex)
    expected[[0, 1, 3]] = 0.7, 1.0, -0.2j
    np.testing.assert_allclose(spectrum, expected, atol=1e-14)


def test_too_few_samples():
    with pytest.raises(ValueError, match="maximum_order 40 needs more than 80 samples, got 80"):
        order_spectrum(np.zeros(80), 40)
    assert order_spectrum(np.zeros(81), 40).shape == (41,)


def test_signal_is_not_changed():
    signal = np.random.default_rng(0).standard_normal((3, 256))
    kept = signal.copy()
    order_spectrum(signal, 40)
    np.testing.assert_array_equal(signal, kept)


def test_same_bits_every_time():
    signal = np.random.default_rng(0).standard_normal((8, 3, 256))
    np.testing.assert_array_equal(order_spectrum(signal, 40), order_spectrum(signal.copy(), 40))


def test_signal_that_is_not_contiguous():
    signal = np.random.default_rng(0).standard_normal((256, 6))
    np.testing.assert_allclose(
        order_spectrum(signal.T, 40), order_spectrum(signal.T.copy(), 40), atol=1e-15
    )


@pytest.mark.parametrize("swing", [0.0, 0.1])
def test_spectra_of_many_cases_are_those_of_each(swing):
    """Of constant speed all at once, of varying speed one after the other."""
    generator = np.random.default_rng(1)
    signal = generator.standard_normal((2, 3, 4, CRANK_ANGLE.size))
    speed = 300.0 + np.zeros((2, 3, 1)) + swing * np.cos(CRANK_ANGLE)
    spectra = order_spectra(signal, speed, 20)
    assert spectra.shape == (2, 3, 4, 21)
    for case in np.ndindex(2, 3):
        each = order_spectrum_at_speed(signal[case], speed[case], 20)
        np.testing.assert_allclose(spectra[case], each, atol=1e-14)
