"""A tone between two lines: what its band loses under each window, and when that is warned of."""

import warnings

import numpy as np
import pytest

from vibroacoustics.orders import (
    OrderResolutionWarning,
    order_cut,
    order_map,
    whole_revolutions,
)
from vibroacoustics.orders.order_cut import order_bands, tone_loss_db
from vibroacoustics.orders.windows import WINDOWS

REVOLUTION = np.arange(200 * 64) / 64


def cut_of_tone(order, window, bandwidth_order=None, signal=None):
    """RMS of a sine of peak 1 in its band, largest error over the blocks in dB, and warnings."""
    sine = np.cos(2.0 * np.pi * order * REVOLUTION) if signal is None else signal
    spectra = order_map(
        whole_revolutions(sine, 200, 25.0), WINDOWS[window].noise_bandwidth_lines / 10, window
    )
    assert spectra.revolutions == 10
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        rms = order_cut(spectra, [order], bandwidth_order).rms[..., 0]
        loss_db = tone_loss_db(spectra, order, order_bands(spectra, [order], bandwidth_order)[0])
    return 20.0 * np.log10(rms * np.sqrt(2.0)), loss_db, caught[: len(caught) // 2]


@pytest.mark.parametrize("window", list(WINDOWS))
@pytest.mark.parametrize("order", [1.0, 2.5, 2.6])
def test_a_tone_on_a_line_reads_its_rms(window, order):
    error_db, loss_db, caught = cut_of_tone(order, window)
    np.testing.assert_allclose(error_db, 0.0, atol=1e-12)
    assert loss_db == pytest.approx(0.0, abs=1e-12)
    assert not caught


@pytest.mark.parametrize(
    ("order", "loss_db"), [(12.55, 0.912), (12.525, 0.4545), (12.51, 0.0), (12.505, 0.0)]
)
def test_a_rectangular_window_names_what_a_tone_between_lines_loses(order, loss_db):
    """Σ sinc² of two lines, 8/π² midway: 0.912 dB.

    The sine's other half, at -12.5, adds up to 1/(π 250) of the amplitude: 0.011 dB.
    """
    lines = 10.0 * order
    within = np.array([np.floor(lines), np.ceil(lines)])
    exact_db = -10.0 * np.log10(np.sum(np.sinc(within - lines) ** 2))
    error_db, stated_db, caught = cut_of_tone(order, "rectangular")
    assert stated_db == pytest.approx(exact_db, abs=1e-9)
    np.testing.assert_allclose(error_db, -stated_db, atol=0.02)
    if loss_db:
        assert stated_db == pytest.approx(loss_db, abs=1e-3)
    assert bool(caught) == (stated_db > 0.05)
    for one in caught:
        assert one.category is OrderResolutionWarning
        assert one.filename == __file__
        words = str(one.message)
        assert f"window rectangular: a tone of order {order:g} lies between lines 0.1" in words
        assert f"{stated_db:.2f} dB low" in words
        assert "\n" not in words


@pytest.mark.parametrize(("window", "bound_db"), [("hann", 0.004), ("flat_top", 1e-4)])
def test_other_windows_lose_next_to_nothing(window, bound_db):
    error_db, loss_db, caught = cut_of_tone(12.55, window)
    assert loss_db <= bound_db
    np.testing.assert_allclose(error_db, -loss_db, atol=1e-4)
    assert not caught


def test_a_wider_band_loses_less():
    """Of 42 lines about a tone midway the others hold 2/π² Σ 1/(n + 1/2)² = 1 % of it."""
    _, loss_db, caught = cut_of_tone(12.55, "rectangular", 4.1)
    beyond = 2.0 / np.pi**2 * np.sum(1.0 / (np.arange(21, 10**6) + 0.5) ** 2)
    assert loss_db == pytest.approx(-10.0 * np.log10(1.0 - beyond), abs=1e-3)
    assert not caught


@pytest.mark.parametrize("window", list(WINDOWS))
def test_noise_has_no_such_loss(window):
    """Bands of noise are right, so tones are not corrected: 5 standard errors."""
    noise = np.random.default_rng(2).standard_normal(REVOLUTION.size)
    error_db, _, _ = cut_of_tone(16.05, window, 24.0, noise)
    # 24 of 32 orders up to half the samples; RMS √2 above is of a sine's peak
    power = np.mean(10.0 ** (error_db / 10.0)) / 2.0
    assert power == pytest.approx(24.0 / 32.0, rel=5.0 * np.sqrt(2.0 / (2 * 24 * 200)))
