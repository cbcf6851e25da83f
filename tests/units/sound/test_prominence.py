"""Tones of arrays of spectra: one at a time by the formulas, silence, gains, a baseline."""

import numpy as np
import pytest
import xarray as xr
from sampled_chain import SampledChain
from sources_study import SOURCES_STUDY, made_up_modes, sources_run
from tonal_spectra import tonal_spectrum

from vibroacoustics.levels.bands import bands_between
from vibroacoustics.levels.hearing import hearing_threshold_db
from vibroacoustics.levels.sample_levels import Deviating, line_squares
from vibroacoustics.machine.cases import Cases
from vibroacoustics.sound.critical_bands import (
    critical_band,
    noise_criterion_db,
    prominence_criterion_db,
)
from vibroacoustics.sound.ingredients import Ingredients, SoundBands, SoundLines, ingredients
from vibroacoustics.sound.prominence import judged_tones
from vibroacoustics.sound.tonality import tones
from vibroacoustics.sound.tone_spectra import ToneSpectra, nominal_spectra, tone_levels
from vibroacoustics.study.loading import load_study
from vibroacoustics.transfer.contributions import Transmission

CENTRE_HZ = np.array([band.middle_hz for band in bands_between(3, 20.0, 16000.0)])
REFERENCE = 4e-10
GAIN = 1.7


def excess_of(tone) -> float:
    """By the formulas of the standard, of a tone that `tones` judges."""
    if tone.level_db < hearing_threshold_db(tone.frequency_hz):
        return -60.0
    over = max(
        tone.noise_ratio_db - noise_criterion_db(tone.frequency_hz),
        tone.prominence_db - prominence_criterion_db(tone.frequency_hz),
    )
    return float(np.clip(over, -60.0, 60.0))


def judged_one_by_one(hertz, square, noise):
    """Levels and excesses by `tones`, one spectrum at a time."""
    names = tuple(map(str, range(hertz.size)))
    level, excess = np.full(square.shape, -300.0), np.full(square.shape, -60.0)
    for number, (lines, bands) in enumerate(zip(square, noise, strict=True)):
        sound = Ingredients(
            SoundLines(hertz, np.sqrt(2.0 * lines).astype(complex), names),
            SoundBands(CENTRE_HZ, np.sqrt(bands)),
        )
        for tone in tones(tonal_spectrum(sound)):
            level[number, int(tone.name)] = tone.level_db
            excess[number, int(tone.name)] = excess_of(tone)
    return level, excess


def test_many_spectra_are_judged_as_one():
    rng = np.random.default_rng(5)
    hertz = np.append(np.arange(1.0, 80.0) * 48.3, [100.0, 200.0])
    square = REFERENCE * 10.0 ** rng.uniform(-1.0, 6.0, (40, hertz.size))
    noise = REFERENCE * 10.0 ** rng.uniform(0.0, 4.0, (40, CENTRE_HZ.size))
    judged = judged_tones(hertz, square, noise, CENTRE_HZ)
    level, excess = judged_one_by_one(hertz, square, noise)
    np.testing.assert_allclose(judged.level_db, level, atol=1e-9)
    np.testing.assert_allclose(judged.excess_db, excess, atol=1e-9)
    assert 0.05 < np.mean(judged.excess_db >= 0.0) < 0.5


def test_excess_in_even_noise_is_that_of_the_formula():
    """50 dB at 1 kHz in 30 dB a third octave: noise of 162 of 231 Hz, over the logarithm."""
    noise = np.full((1, CENTRE_HZ.size), REFERENCE * 1e3)
    judged = judged_tones(np.array([1000.0]), np.full((1, 1), REFERENCE * 1e5), noise, CENTRE_HZ)
    band = critical_band(1000.0)
    part = np.log(band.upper / band.lower) / np.log(10.0**0.1)
    assert judged.level_db.item() == pytest.approx(50.0)
    by_noise = 50.0 - 30.0 - 10.0 * np.log10(part) - 8.0
    assert judged.excess_db.item() == pytest.approx(by_noise, abs=1e-9)  # by the bands: less


def test_a_tone_is_not_judged_without_noise_in_its_critical_band():
    hertz, square = np.array([300.0, 4000.0]), np.full((1, 2), REFERENCE * 1e6)
    noise = np.where(CENTRE_HZ > 1000.0, REFERENCE * 1e3, 0.0)[None]
    judged = judged_tones(hertz, square, noise, CENTRE_HZ)
    assert judged.level_db[0] == pytest.approx([60.0, 60.0])
    assert judged.excess_db[0, 0] == -60.0
    assert 0.0 < judged.excess_db[0, 1] < 60.0


def test_a_tone_that_nobody_hears_is_none():
    quiet = judged_tones(
        np.array([1000.0]),
        np.full((1, 1), REFERENCE * 10.0**-0.8),
        np.full((1, CENTRE_HZ.size), REFERENCE * 1e-6),
        CENTRE_HZ,
    )
    assert quiet.excess_db.item() == -60.0


def test_excess_is_finite_where_neighbouring_bands_are_silent():
    near = (CENTRE_HZ > 900.0) & (CENTRE_HZ < 1100.0)
    noise = np.where(near, REFERENCE * 1e-3, 0.0)[None]
    loud = judged_tones(np.array([1000.0]), np.full((1, 1), 1.0), noise, CENTRE_HZ)
    assert loud.excess_db.item() == 60.0


def test_lines_without_a_frequency_are_no_tones():
    hertz = np.array([np.nan, 1000.0])
    judged = judged_tones(
        hertz,
        np.array([[1.0, REFERENCE * 1e5]]),
        np.full((1, CENTRE_HZ.size), REFERENCE * 1e2),
        CENTRE_HZ,
    )
    assert judged.excess_db[0, 0] == -60.0
    assert judged.excess_db[0, 1] > 0.0


def as_arrays(results, option, microphone, speed):
    """Excess of the tones of a sound that is listened to, by name."""
    spectrum = tonal_spectrum(ingredients(results, option, microphone, speed))
    return {
        tone.name: excess_of(tone) if np.isfinite(tone.noise_ratio_db) else -60.0
        for tone in tones(spectrum)
    }


def test_with_a_baseline_tones_are_those_of_the_sound(results):
    """Lines and noise are those of `ingredients`: measured orders, and bands less their lines."""
    spectra, names = nominal_spectra(results)
    for s, speed in enumerate(results["speed"].values.tolist()):
        for r, microphone in enumerate(results["receiver"].values.tolist()):
            sound = ingredients(results, "none", microphone, speed)
            squares = dict(zip(names, spectra.square[s, 0, r], strict=True))
            for name, peak in zip(sound.lines.name, sound.lines.pressure_pa, strict=True):
                assert squares[name] == pytest.approx(0.5 * abs(peak) ** 2, rel=1e-9)
            of_noise = spectra.noise[s, 0, r][spectra.noise[s, 0, r] > 0.0]
            np.testing.assert_allclose(of_noise, sound.bands.pressure_pa**2, rtol=1e-9)


@pytest.fixture(scope="module")
def sampled() -> xr.Dataset:
    return sources_run()


def test_nominal_tones_are_those_of_the_nominal_sound(tmp_path):
    study = load_study(SOURCES_STUDY)
    chain = SampledChain.of(study, lambda study, *_: (made_up_modes(study), False)).chain
    results = chain.results
    (speed,) = study.operation.speed_rpm
    spectra, names = nominal_spectra(results)
    levels = tone_levels(spectra)
    assert (levels["tone_excess"] > -60.0).any()
    receiver = list(results["receiver"].values).index(study.catalogue_receiver)
    for o, option in enumerate(results["option"].values):
        expected = as_arrays(results, str(option), study.catalogue_receiver, speed)
        found = dict(zip(names, levels["tone_excess"][0, o, receiver], strict=True))
        assert {name: found[name] for name in expected} == pytest.approx(expected, abs=1e-6)


def test_lines_of_a_sample_have_its_gains():
    """With the nominal loads and one gain of all sources."""
    study = load_study(SOURCES_STUDY)
    chain = SampledChain.of(study, lambda study, *_: (made_up_modes(study), False))
    received = chain.chain[Transmission].received(chain.chain[Cases])
    shape = (2, len(chain.axes.sources), len(chain.axes.receivers), 34)
    gains = np.ones(shape) * np.array([1.0, GAIN])[:, None, None, None]
    sample = Deviating(received, dict.fromkeys(received, gains), [], study.machine, np.zeros(2))
    spectra, names = nominal_spectra(chain.chain.results)
    frequency, square = line_squares(chain.axes, sample, names)
    row = list(chain.chain.results["receiver"].values).index(study.catalogue_receiver)
    np.testing.assert_allclose(frequency, spectra.frequency_hz)
    nominal = spectra.square[:, :, [row]]
    np.testing.assert_allclose(square, nominal * np.array([1.0, GAIN]).reshape(2, 1, 1, 1, 1))


def test_tones_of_samples_are_listed_by_their_probability(sampled):
    """The median of the excess is above zero just where more than half of the samples are."""
    chance, excess = sampled["tone_probability"].values, sampled["tone_excess"].values
    assert np.all((chance >= 0.0) & (chance <= 1.0))
    assert np.all(np.abs(excess) <= 60.0)
    clear = np.abs(chance - 0.5) > 0.1
    assert np.array_equal((chance > 0.5)[clear], (excess >= 0.0)[clear])
    assert np.all(sampled["any_tone_probability"].values >= chance.max(axis=-1) - 1e-12)
    ends = [sampled[f"tone_excess_{end}_percent"].values for end in (10, 90)]
    assert np.all(ends[0] <= excess)
    assert np.all(excess <= ends[1])
    assert np.ptp(chance) > 0.0


def test_measured_bands_and_orders_are_in_place_of_modelled_ones():
    """An order of 80 dB in a band of 83 dB leaves noise of 80 dB; others stay."""
    spectra = ToneSpectra(
        np.array([[100.0, 200.0]]),
        np.full((1, 1, 1, 2), REFERENCE),
        np.full((1, 1, 1, 34), REFERENCE),
    )
    band_db, order_db = np.full((1, 1, 1, 34), np.nan), np.array([[[[80.0]]]])
    band_db[..., 10] = 10.0 * np.log10(2e8)  # the band of 100 Hz
    measured = spectra.with_measured(["order 1", "order 2"], [1.0], order_db, band_db)
    assert measured.square.ravel() == pytest.approx(REFERENCE * np.array([1e8, 1.0]))
    assert measured.noise[0, 0, 0, 10] == pytest.approx(REFERENCE * 1e8)
    others = np.delete(measured.noise.ravel(), 10)
    assert others == pytest.approx(np.full(33, REFERENCE))
