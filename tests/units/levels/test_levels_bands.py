"""Bands of IEC 61260-1: frequencies, Fourier band sums, and the class 1 filter bank."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.signal import sosfreqz

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.levels import (
    Band,
    band_filter,
    band_mean_square,
    band_signal,
    bands_between,
    class_1_limits_db,
    measurable_bands,
)

RATES = (51_200.0, 48_000.0, 44_100.0)
G = 10.0**0.3

# --- frequencies ---------------------------------------------------------------------------------


def test_nominal_third_octaves_are_the_preferred_numbers():
    """Annex E (ISO 266): 25 Hz to 20 kHz."""
    nominal = [band.nominal_hz for band in bands_between(3, 25.0, 20e3)]
    assert nominal == [
        25, 31.5, 40, 50, 63, 80, 100, 125, 160, 200, 250, 315, 400, 500, 630, 800, 1000, 1250,
        1600, 2000, 2500, 3150, 4000, 5000, 6300, 8000, 10000, 12500, 16000, 20000,
    ]  # fmt: skip


def test_nominal_octaves_are_the_preferred_numbers():
    nominal = [band.nominal_hz for band in bands_between(1, 16.0, 16e3)]
    assert nominal == [16, 31.5, 63, 125, 250, 500, 1000, 2000, 4000, 8000, 16000]


@pytest.mark.parametrize(("bands_per_octave", "span"), [(1, range(-6, 5)), (3, range(-17, 14))])
def test_exact_frequencies(bands_per_octave, span):
    """Mid-band frequencies 10^(n/10) and edges halfway to the next, on a logarithmic scale."""
    tenths = 3 // bands_per_octave
    for index in span:
        band = Band(bands_per_octave, index)
        assert band.middle_hz == pytest.approx(10.0 ** (3.0 + tenths * index / 10.0), rel=1e-14)
        assert band.middle_hz == pytest.approx(band.nominal_hz, rel=0.0162)  # 15.849 is called 16
        assert band.lower_hz * band.upper_hz == pytest.approx(band.middle_hz**2, rel=1e-14)
        following = Band(bands_per_octave, index + 1)
        assert band.upper_hz == pytest.approx(following.lower_hz, rel=1e-14)


def test_bands_hold_the_frequencies_that_ask_for_them():
    bands = bands_between(3, 24.3, 902.0)
    assert (bands[0].nominal_hz, bands[-1].nominal_hz) == (25.0, 1000.0)
    assert bands[0].lower_hz < 24.3 < bands[0].upper_hz
    assert bands[-1].lower_hz < 902.0 < bands[-1].upper_hz


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((2, 100.0, 200.0), "bands_per_octave = 2: must be 1"),
        ((3, 0.0, 200.0), "bands from 0 to 200 Hz"),
        ((3, 200.0, 100.0), "bands from 200 to 100 Hz"),
        ((3, np.nan, 100.0), "bands from nan to 100 Hz"),
    ],
)
def test_bands_refuse(arguments, words):
    with pytest.raises(ParameterError, match=words):
        bands_between(*arguments)


# --- Fourier band sums ---------------------------------------------------------------------------


@settings(max_examples=30, deadline=None)
@given(
    samples=st.integers(200, 3000),
    rate=st.sampled_from(RATES),
    bands_per_octave=st.sampled_from([1, 3]),
)
def test_bands_add_up_to_what_lies_between_their_edges(samples, rate, bands_per_octave):
    """Parseval: bands, what is below them and what is above them make the mean square.

    Below and above come from the transform's lines by hand, the cut ones in proportion.
    """
    signal = np.random.default_rng(samples).standard_normal(samples) + 0.3
    bands = measurable_bands(bands_between(bands_per_octave, 25.0, 20e3), rate)
    inside = np.sum(band_mean_square(signal, rate, bands))
    lines = np.abs(np.fft.fft(signal) / samples) ** 2
    distance = np.abs(np.fft.fftfreq(samples, 1.0 / rate))
    half = 0.5 * rate / samples
    below = np.clip((bands[0].lower_hz - (distance - half)) / (2.0 * half), 0.0, 1.0)
    below[0] = min(1.0, bands[0].lower_hz / half)  # of 0 Hz, which is its own mirror image
    above = np.clip((distance + half - bands[-1].upper_hz) / (2.0 * half), 0.0, 1.0)
    if samples % 2 == 0:  # so is half the sample rate
        above[samples // 2] = min(1.0, (0.5 * rate - bands[-1].upper_hz) / half)
    outside = np.sum(lines * (below + above))
    assert inside + outside == pytest.approx(np.mean(signal**2), rel=1e-12)


def test_a_tone_on_a_line_is_in_its_band_alone():
    time = np.arange(8000) / 8000.0
    signal = np.array([[2.0], [1.0]]) * np.cos(2.0 * np.pi * 1000.0 * time)
    bands = bands_between(1, 250.0, 2000.0)
    energy = band_mean_square(signal, 8000.0, bands)
    expected = np.array([[0.0, 0.0, 2.0, 0.0], [0.0, 0.0, 0.5, 0.0]])
    np.testing.assert_allclose(energy, expected, atol=1e-15)


def test_a_line_on_a_band_edge_is_shared():
    """A line of 4 Hz width at 708 Hz, 0.0542 Hz below the edge at 707.946 Hz."""
    edge = Band(1, 0).lower_hz
    time = np.arange(2000) / 8000.0
    energy = band_mean_square(
        np.cos(2.0 * np.pi * 708.0 * time), 8000.0, bands_between(1, 500, 1000)
    )
    share = (710.0 - edge) / 4.0
    np.testing.assert_allclose(energy, [0.5 * (1.0 - share), 0.5 * share], rtol=1e-10)


def test_leakage_is_what_the_docstring_says():
    """A tone between two lines, seen a decade above it."""
    rate, duration, frequency = 8000.0, 2.0, 100.25
    time = np.arange(int(rate * duration)) / rate
    band = Band(3, 0)
    energy = band_mean_square(np.cos(2.0 * np.pi * frequency * time), rate, [band])[0]
    f = np.linspace(band.lower_hz, band.upper_hz, 1001)
    jump = np.trapezoid((0.5 / (f - frequency) + 0.5 / (f + frequency)) ** 2, f)
    # Half a line off and of phase 0, the ends miss each other by twice the peak: the worst case.
    # Sampling adds (x / sin x)² with x = π f / rate, 5 % here.
    assert energy / 0.5 == pytest.approx(4.0 * jump / (np.pi**2 * duration), rel=0.06)


def test_bands_above_half_the_sample_rate_are_refused_or_left_out():
    bands = bands_between(3, 25.0, 20e3)
    words = "band 20000 Hz: reaches up to 22387 Hz, must end below half the sample rate, 22050 Hz"
    with pytest.raises(ParameterError, match=words):
        band_mean_square(np.zeros(1000), 44_100.0, bands)
    with pytest.raises(ParameterError, match=words):
        band_filter(bands[-1], 44_100.0)
    assert measurable_bands(bands, 44_100.0) == bands[:-1]
    assert measurable_bands(bands, 48_000.0) == bands


# --- class 1 limits ------------------------------------------------------------------------------

TABLE_1 = [  # IEC 61260-1:2014, Table 1, class 1 (secondary source): power of G, least, greatest
    (0.0, -0.4, 0.4), (1 / 8, -0.4, 0.5), (1 / 4, -0.4, 0.7), (3 / 8, -0.4, 1.4),
    (0.5 - 1e-9, -0.4, 5.3), (0.5 + 1e-9, 1.2, np.inf), (1.0, 16.6, np.inf), (2.0, 40.5, np.inf),
    (3.0, 60.0, np.inf), (4.0, 70.0, np.inf), (6.0, 70.0, np.inf),
]  # fmt: skip
# Breakpoints of a third-octave filter above the mid-band frequency (Annex F; secondary source).
ANNEX_F = {
    1 / 8: 1.02667, 1 / 4: 1.05575, 3 / 8: 1.08746, 1.0: 1.29437, 2.0: 1.88173, 3.0: 3.05365,
    4.0: 5.39195,
}  # fmt: skip


@pytest.mark.parametrize(("power", "least", "greatest"), TABLE_1)
@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_class_1_limits_of_an_octave(power, least, greatest, side):
    limits = class_1_limits_db(np.array([G ** (side * power)]), 1)
    assert limits == (pytest.approx(least, abs=1e-6), pytest.approx(greatest, abs=1e-6))


@pytest.mark.parametrize(("power", "least", "greatest"), [r for r in TABLE_1 if r[0] in ANNEX_F])
@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_class_1_limits_of_a_third_octave(power, least, greatest, side):
    """At the breakpoints of Annex F, printed to five decimals: 40 dB an octave of a third."""
    limits = class_1_limits_db(np.array([ANNEX_F[power] ** side]), 3)
    assert limits == (pytest.approx(least, abs=2e-3), pytest.approx(greatest, abs=2e-3))


def test_limits_between_breakpoints_are_linear_over_the_logarithm():
    least, greatest = class_1_limits_db(np.array([G**1.5, G**0.3125]), 1)
    assert least[0] == pytest.approx((16.6 + 40.5) / 2.0)
    assert greatest[1] == pytest.approx((0.7 + 1.4) / 2.0)


# --- filter bank ---------------------------------------------------------------------------------


def bank(bands_per_octave, rate):
    return measurable_bands(bands_between(bands_per_octave, 1.0, 20e3), rate)


@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize(("bands_per_octave", "count"), [(1, 15), (3, 44)])
def test_every_filter_of_the_bank_is_class_1(bands_per_octave, count, rate):
    """1 Hz to 20 kHz, or the last whole band, all the way from G^-6 to half the sample rate."""
    bands = bank(bands_per_octave, rate)
    assert len(bands) == count - (rate == 44_100.0)
    for band in bands:
        ratio = G ** np.arange(-6.0, 6.0, 1e-3)
        ratio = ratio[ratio * band.middle_hz < 0.5 * rate]
        response = sosfreqz(band_filter(band, rate), ratio * band.middle_hz, fs=rate)[1]
        attenuation = -20.0 * np.log10(np.maximum(np.abs(response), 1e-15))
        least, greatest = class_1_limits_db(ratio, bands_per_octave)
        assert np.all(attenuation >= least), band
        assert np.all(attenuation <= greatest), band


@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize("bands_per_octave", [1, 3])
def test_effective_bandwidth_of_every_filter(bands_per_octave, rate):
    """Class 1 allows ±0.4 dB of the response integrated over the logarithm of the frequency.

    Butterworth of order 4: π/8 / sin(π/8) = +0.11 dB of a narrow band.
    """
    for band in bank(bands_per_octave, rate):
        frequency = np.geomspace(band.middle_hz / 200.0, 0.5 * rate * (1.0 - 1e-9), 50_000)
        response = np.abs(sosfreqz(band_filter(band, rate), frequency, fs=rate)[1]) ** 2
        width = np.trapezoid(response, np.log(frequency)) / np.log(band.upper_hz / band.lower_hz)
        assert abs(10.0 * np.log10(width)) < 0.4, band


def test_filter_that_would_not_be_class_1_is_refused():
    """A third octave that ends within 1 % of half the sample rate."""
    band = Band(3, 13)
    assert band_filter(band, 2.02 * band.upper_hz).shape == (4, 6)
    with pytest.raises(ParameterError, match="band 20000 Hz: too close to half the sample rate"):
        band_filter(band, 2.002 * band.upper_hz)


@pytest.mark.parametrize("nominal", [25.0, 1000.0, 16000.0])
def test_tone_at_mid_band_comes_through_at_its_size(nominal):
    rate = 51_200.0
    (band,) = bands_between(3, nominal, nominal)
    time = np.arange(int(4.0 * rate)) / rate
    passed = band_signal(np.cos(2.0 * np.pi * band.middle_hz * time), rate, band)
    settled = passed[int(2.0 * rate) :]
    # Order 4: flat at the middle but for the bilinear transform; 2 s of 25 Hz cut at half a turn.
    assert np.sqrt(2.0 * np.mean(settled**2)) == pytest.approx(1.0, abs=0.01)


@pytest.mark.parametrize("bands_per_octave", [1, 3])
def test_second_method_filter_bank_against_band_sums(bands_per_octave):
    """White noise: the two differ by the filters' effective bandwidth, and by chance.

    A band of width W over T seconds has W T independent values: their mean square scatters by
    1/√(W T), 0.7 % at 100 Hz; what the skirts let in of the neighbours is a part of that.
    """
    rate = 51_200.0
    signal = np.random.default_rng(6).standard_normal((1, int(20.0 * rate)))
    bands = bank(bands_per_octave, rate)[-10:]
    sums = band_mean_square(signal, rate, bands)[0]
    for band, expected in zip(bands, sums, strict=True):
        filtered = np.mean(band_signal(signal, rate, band) ** 2)
        width = band.upper_hz - band.lower_hz
        skirts = 1.0 / np.sqrt(width * 20.0)
        assert -3.0 * skirts < filtered / expected - 1.0 < 0.03 + 3.0 * skirts, band
