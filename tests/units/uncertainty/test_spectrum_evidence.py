"""Weights by a measured spectrum, beside posteriors in closed form and by quadrature."""

from types import SimpleNamespace

import numpy as np
import pytest
from test_sample_evidence import NONE, SPEED, evidence_of

from vibroacoustics.base.vocabulary import REFERENCE_OPTION
from vibroacoustics.levels.agreement import LEVELS_DB
from vibroacoustics.levels.by_source import GAIN_BANDS, SourceSound, gain_band_number
from vibroacoustics.levels.spectrum_data import rows_by_octave, spectrum_data
from vibroacoustics.study.uncertainty import Uncertainty
from vibroacoustics.uncertainty.discrepancy import DISCREPANCIES, WITH_SPECTRUM, Discrepancy
from vibroacoustics.uncertainty.evidence import PAIRS
from vibroacoustics.uncertainty.posterior import spectrum_variables

BAND_HZ = (400.0, 500.0, 630.0, 1600.0, 2000.0)
COLUMN = gain_band_number(np.array(BAND_HZ))
PATH_DB, SOURCE_DB, BAND_DB, DEVIATION_DB = 8.0, 5.0, 6.0, 2.0
FAST = 2.0 * SPEED
PATH_ALONE = NONE.model_copy(update={"path_deviation_db": PATH_DB})


def spectrum_evidence(settings, level_dba, receiver="front", speed_rpm=SPEED):
    """Published 56 ± 2 dB(A), with a measured spectrum; unmodelled noise at 5 kHz alone."""
    evidence, machine = evidence_of(settings)
    study, axes = evidence.nominal.study, evidence.nominal.axes
    machine.remainder.speed_factor = lambda speed, published: (speed / published) ** 3
    study.operation = SimpleNamespace(point=None)
    spectrum = SimpleNamespace(
        microphone=receiver, speed_rpm=speed_rpm, operating_point=None,
        deviation_db=DEVIATION_DB, band_hz=BAND_HZ, level_dba=level_dba,
    )  # fmt: skip
    spectrum.within = lambda _: spectrum
    study.radiation = SimpleNamespace(maximum_frequency_hz=1e4)
    study.evidence = SimpleNamespace(spectrum=spectrum)
    axes.receivers = ["front", "side"]
    return evidence, machine


def sound_of(level_dba, front_db=0.0):
    """A source "low" with levels in `BAND_HZ` at the side; as much and `front_db` at the front."""
    mutual = np.zeros((2, 2, 2, len(GAIN_BANDS)))
    for column, level in zip(COLUMN.tolist(), level_dba, strict=True):
        mutual[0, 0, 1, column] = 4e-10 * 10.0 ** (level / 10.0)
    mutual[:, :, 0] = mutual[:, :, 1] * 10.0 ** (front_db / 10.0)
    alone = np.einsum("ssri->sr", mutual)
    return SourceSound(np.zeros((2, 2, 1)), alone, alone[None], mutual)


def total(level_dba):
    return 10.0 * np.log10(np.sum(10.0 ** (np.asarray(level_dba) / 10.0)))


MODELLED = (50.0, 53.0, 47.0, 49.0, 45.0)
MEASURED = (47.0, 44.0, 52.0, 46.0, 41.0)
FIRST, SECOND = slice(0, 3), slice(3, 5)
OFF_DB = (
    56.0 - total(MODELLED),
    total(MEASURED[FIRST]) - total(MODELLED[FIRST]),
    total(MEASURED[SECOND]) - total(MODELLED[SECOND]),
)
"""Level, 500 Hz octave and 2 kHz octave over those modelled."""


def test_third_octaves_weigh_as_sums_over_octaves():
    evidence, _ = spectrum_evidence(PATH_ALONE, MEASURED)
    data = spectrum_data(evidence.nominal.study).data
    assert [datum.name for datum in data] == ["octave 500 Hz", "octave 2000 Hz"]
    values = [total(MEASURED[FIRST]), total(MEASURED[SECOND])]
    assert [datum.value for datum in data] == pytest.approx(values)
    bands = sound_of(MODELLED).mutual[0, 0, 1]
    found = [float(datum.predicted(bands)) for datum in data]
    assert found == pytest.approx([total(MODELLED[FIRST]), total(MODELLED[SECOND])])


def test_octaves_hold_their_three_third_octaves():
    """IEC 61260-1: the octave at 1 kHz is that of 800, 1000 and 1250 Hz."""
    hertz = np.array([25.0, 31.5, 40.0, 50.0, 800.0, 1000.0, 1250.0, 1600.0])
    rows = rows_by_octave(gain_band_number(hertz))
    assert rows == {-5: [0, 1, 2], -4: [3], 0: [4, 5, 6], 1: [7]}


def test_posterior_of_a_linear_gaussian_case_is_that_in_closed_form():
    """One source with a common deviation d ~ N(0, 8²), three data of ± 2 dB, no other noise."""
    evidence, machine = spectrum_evidence(PATH_ALONE, MEASURED)
    sound = {(SPEED, REFERENCE_OPTION): sound_of(MODELLED)}
    evidence.__dict__["published"] = evidence.published._replace(
        priors=(SimpleNamespace(log_density=np.where(LEVELS_DB[0] < LEVELS_DB, -np.inf, 0.0)),)
    )  # 40 dB below the published level: 1e-3 dB
    weight, deviation_db = [], []
    for number in range(300):
        log_weight = evidence.log_weights(sound, machine, number, evidence.published)[0, :, 0]
        weight.append(np.exp(log_weight))
        deviation_db.append(10.0 * np.log10(evidence.discrepancy(number).gain[:, 0, COLUMN[0]]))
    weight, deviation_db = np.concatenate(weight), np.concatenate(deviation_db)
    mean = np.average(deviation_db, weights=weight)
    spread = np.sqrt(np.average((deviation_db - mean) ** 2, weights=weight))
    precision = 1.0 / PATH_DB**2 + 3.0 / DEVIATION_DB**2
    effective = weight.sum() ** 2 / (weight**2).sum()
    error = 4.0 / np.sqrt(precision * effective)
    assert mean == pytest.approx(sum(OFF_DB) / DEVIATION_DB**2 / precision, abs=error)
    assert spread == pytest.approx(precision**-0.5, rel=4.0 / np.sqrt(2.0 * effective))
    # Evidence of the sample: the normal density of the data with a common deviation.
    covariance = PATH_DB**2 * np.ones((3, 3)) + DEVIATION_DB**2 * np.eye(3)
    off = np.array(OFF_DB)
    exact = np.exp(-0.5 * off @ np.linalg.solve(covariance, off)) / np.sqrt(
        np.linalg.det(covariance) / DEVIATION_DB**6
    )
    assert weight.mean() == pytest.approx(exact, rel=4.0 / np.sqrt(effective))


def test_posterior_with_unmodelled_noise_is_that_by_quadrature():
    """Unmodelled noise lies in no measured band: it fills the level, not the octaves."""
    evidence, machine = spectrum_evidence(PATH_ALONE, MEASURED)
    sound = {(SPEED, REFERENCE_OPTION): sound_of(MODELLED)}
    found = sum(
        np.exp(evidence.log_weights(sound, machine, number, evidence.published)[0]).sum(axis=0)
        for number in range(400)
    )
    deviation_db = np.linspace(-40.0, 40.0, 8001)[:, None]
    level = 10.0 * np.log10(
        10.0 ** ((total(MODELLED) + deviation_db) / 10.0) + 10.0 ** ((56.0 + LEVELS_DB) / 10.0)
    )
    off = (level - 56.0) ** 2 + (deviation_db - OFF_DB[1]) ** 2 + (deviation_db - OFF_DB[2]) ** 2
    density = np.exp(-0.5 * (deviation_db / PATH_DB) ** 2 - 0.5 * off / DEVIATION_DB**2)
    exact = (density * np.exp(evidence.published.priors[0].log_density)).sum(axis=0)
    np.testing.assert_allclose(found / found.sum(), exact / exact.sum(), atol=0.005)


def test_a_spectrum_weighs_at_its_own_microphone_and_speed():
    """Level at the front and 2900 rpm, spectrum at the side and twice the speed."""
    evidence, machine = spectrum_evidence(NONE, MEASURED, "side", FAST)
    sound = {
        (SPEED, REFERENCE_OPTION): sound_of(MODELLED, 6.0),
        (FAST, REFERENCE_OPTION): sound_of(np.add(MODELLED, -3.0), 20.0),
    }
    found = evidence.log_weights(sound, machine, 0, evidence.published)[0]
    alone = evidence.published._replace(spectrum=None)
    before = evidence.log_weights(sound, machine, 0, alone)[0]
    off = (OFF_DB[1] + 3.0) ** 2 + (OFF_DB[2] + 3.0) ** 2
    known = np.isfinite(before)
    np.testing.assert_allclose(
        found[known] - before[known], -0.5 * off / DEVIATION_DB**2, atol=1e-9
    )
    assert evidence.growth(machine, evidence.published.spectrum) == pytest.approx(8.0)
    assert evidence.growth(machine, None) == 1.0


def test_unmodelled_noise_of_a_spectrum_grows_with_speed():
    """Noise in a measured band: eight times as much at twice the speed."""
    evidence, machine = spectrum_evidence(NONE, MEASURED, "front", FAST)
    machine.remainder.spectrum = lambda hertz: np.where(np.abs(hertz - 2000.0) < 50.0, 1.0, 0.0)
    quiet = {(speed, REFERENCE_OPTION): sound_of((-200.0,) * 5) for speed in (SPEED, FAST)}
    only = evidence.published._replace(data=())
    noise_db = 56.0 + LEVELS_DB + 10.0 * np.log10(8.0)
    without = evidence.published.spectrum._replace(data=evidence.published.spectrum.data[1:])
    found = evidence.log_weights(quiet, machine, 0, only._replace(spectrum=without))[0, 0]
    expected = -0.5 * ((noise_db - total(MEASURED[SECOND])) / DEVIATION_DB) ** 2
    known = np.isfinite(found)
    prior = evidence.published.priors[0].log_density
    np.testing.assert_allclose(found[known] - prior[known], expected[known], atol=1e-9)


def test_bands_of_unmodelled_noise_deviate_only_beside_a_spectrum():
    settings = Uncertainty()
    plain, beside = (Discrepancy.of(settings, 2, 3, which) for which in (False, True))
    assert plain.unmodelled.shape == (DISCREPANCIES, len(GAIN_BANDS))
    assert np.all(plain.unmodelled == 1.0)
    levels = 10.0 * np.log10(
        np.concatenate([Discrepancy.of(settings, 2, n, True).unmodelled for n in range(100)])
    )
    assert beside.gain.shape == (WITH_SPECTRUM, 2, len(GAIN_BANDS))
    assert levels.std(axis=0) == pytest.approx(BAND_DB, rel=0.04)
    along = np.mean(levels[:, 10] * levels[:, 13])  # an octave on
    assert along == pytest.approx(BAND_DB**2 * np.exp(-1.0), rel=0.08)


def test_bands_after_the_data_are_nearer_to_those_measured():
    """Of one sample with all deviations; unmodelled noise is elsewhere."""
    settings = Uncertainty(
        path_deviation_db=PATH_DB, source_deviation_db=SOURCE_DB, band_deviation_db=BAND_DB
    )
    evidence, machine = spectrum_evidence(settings, MEASURED)
    sound = {(SPEED, REFERENCE_OPTION): sound_of(MODELLED)}
    batch = SimpleNamespace(sounds=[sound], machines=[machine])
    ensemble = SimpleNamespace(batch=batch, weight=np.ones((1, 1)))
    spectrum = evidence.published.spectrum
    before = evidence.expected(sound, machine, 1.0, spectrum)[None]
    found = spectrum_variables(evidence, spectrum, ensemble, before, np.ones(1))
    assert found["spectrum_band"].values.tolist() == list(BAND_HZ)
    assert found["spectrum_measured"].values.tolist() == list(MEASURED)
    np.testing.assert_allclose(found["spectrum_before"].sel(datum_quantile=0.5), MODELLED)
    pairs = evidence.pairs_of(sound, machine, 0)
    bands = 10.0 * np.log10(
        pairs.discrepancy.gain[:, 0, COLUMN]
        * sound[SPEED, REFERENCE_OPTION].mutual[0, 0, 0, COLUMN]
        / 4e-10
    )
    assert bands.shape == (PAIRS, len(BAND_HZ))
    for rows in (FIRST, SECOND):
        octave = 10.0 * np.log10(np.sum(10.0 ** (bands[:, rows] / 10.0), axis=1))
        assert np.abs(octave - total(MEASURED[rows])).mean() < 2.0 * DEVIATION_DB
    low, high = (found["spectrum_after"].sel(datum_quantile=q).values for q in (0.1, 0.9))
    assert np.all((bands.min(axis=0) <= low) & (high <= bands.max(axis=0)))
