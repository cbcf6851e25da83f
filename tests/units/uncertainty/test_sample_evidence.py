"""Discrepancies, pairs that go on, and prior-data conflict."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.stats import norm

from vibroacoustics.base.vocabulary import REFERENCE_OPTION
from vibroacoustics.levels.agreement import LEVELS_DB, Datum, log_weight_of_points
from vibroacoustics.levels.by_source import GAIN_BANDS, SourceSound, gain_band_number, source_sound
from vibroacoustics.mechanics.received_sound import NoisePower
from vibroacoustics.study.uncertainty import Uncertainty
from vibroacoustics.uncertainty.discrepancy import Discrepancy
from vibroacoustics.uncertainty.evidence import PAIRS, Evidence, systematic, with_gain
from vibroacoustics.uncertainty.posterior import _model_alone, conflict_variables

SETTINGS = Uncertainty()
NONE = Uncertainty(
    path_deviation_db=0.0, source_deviation_db=0.0, band_deviation_db=0.0, added_deviation_db=0.0
)
SPEED = 2900.0


def levels_of(settings, samples=400, sources=3):
    """Levels of discrepancies, shape (all discrepancies, source, band), and of what is added."""
    sampled = [Discrepancy.of(settings, sources, number) for number in range(samples)]
    return (
        10.0 * np.log10(np.concatenate([one.gain for one in sampled])),
        10.0 * np.log10(np.concatenate([one.added for one in sampled])),
    )


def test_discrepancies_have_the_deviations_and_correlations_that_are_given():
    """Of 20 000: 1 % of a deviation is two standard errors."""
    level, added = levels_of(SETTINGS)
    assert level.mean() == pytest.approx(0.0, abs=0.2)
    assert level.std(axis=0) == pytest.approx(np.sqrt(8.0**2 + 5.0**2 + 6.0**2), rel=0.03)
    between = np.mean(level[:, 0] * level[:, 1], axis=0)
    assert between == pytest.approx(8.0**2, rel=0.06)  # the path alone
    for thirds in (1, 3, 9):
        along = np.mean(level[:, 0, 10] * level[:, 0, 10 + thirds])
        exact = 8.0**2 + 5.0**2 + 6.0**2 * np.exp(-thirds / 3.0)
        assert along == pytest.approx(exact, rel=0.04)
    assert added.std() == pytest.approx(8.0, rel=0.02)
    assert abs(np.corrcoef(added, level[:, 0, 0])[0, 1]) < 0.03


def test_discrepancies_of_a_sample_are_the_same_at_each_call_and_none_without_deviations():
    first, again, other = (Discrepancy.of(SETTINGS, 2, number).gain for number in (3, 3, 4))
    np.testing.assert_array_equal(first, again)
    assert not np.any(first == other)
    np.testing.assert_array_equal(Discrepancy.of(NONE, 2, 3).gain, 1.0)


def two_sources(phase=np.pi, hertz=(50.0, 500.0)):
    """A line each at two frequencies, of one source against the other; noise of the second."""
    pressure = np.array([[[1.0, 2.0]], [[0.5, 1.5]]]) * np.array([[[1.0]], [[np.exp(1j * phase)]]])
    noise = NoisePower(1, np.array([2000.0]), np.array([[0.3]]))
    return pressure, source_sound(pressure, np.array(hertz), (noise,), GAIN_BANDS)


def test_gains_scale_pressures_so_that_lines_that_cancel_stay_sums_of_phasors():
    pressure, sound = two_sources()
    gain = np.random.default_rng(1).uniform(0.1, 10.0, (2, 1, len(GAIN_BANDS)))
    scaled = sound.scaled(gain)
    column = gain_band_number(np.array([50.0, 500.0]))
    by_hand, noise = (
        source_sound(
            pressure * np.sqrt(gain[:, :, column]), np.array([50.0, 500.0]), (), GAIN_BANDS
        ),
        sound.energy[1, 0, gain_band_number(np.array(2000.0))],
    )
    of_noise = noise * gain[1, 0, gain_band_number(np.array(2000.0))]
    assert scaled.total[0, 0] == pytest.approx(by_hand.total[0, 0] + of_noise)
    assert scaled.alone[:, 0] == pytest.approx(by_hand.alone[:, 0] + [0.0, of_noise])
    assert sound.mutual.sum() == pytest.approx(sound.total[0].sum())
    assert sound.energy.sum(axis=-1) == pytest.approx(sound.alone)
    bands = with_gain(sound.mutual[:, :, 0], gain[None, :, 0])
    assert bands.sum() == pytest.approx(scaled.total[0, 0])


def sound_at(low, high, added=0.0):
    """Energies of a low and of a high source; an option adds to the high one."""
    mutual = np.zeros((2, 2, 1, len(GAIN_BANDS)))
    for source, (energy, hertz) in enumerate(((low, 500.0), (high + added, 2000.0))):
        mutual[source, source, 0, gain_band_number(np.array(hertz))] = energy
    alone = np.einsum("ssri->sr", mutual)
    return SourceSound(np.zeros((2, 1, 1)), alone, alone[None], mutual)


def test_what_an_option_adds_deviates_besides_and_what_it_takes_away_does_not():
    sound = {
        (SPEED, REFERENCE_OPTION): sound_at(4.0, 2.0),
        (SPEED, "louder"): sound_at(4.0, 2.0, added=3.0),
        (SPEED, "quieter"): sound_at(1.0, 2.0),
    }
    gain, even = np.full((1, 2, len(GAIN_BANDS)), 10.0), np.ones((1, len(GAIN_BANDS)))
    discrepancy = Discrepancy(gain, np.array([100.0]), even)
    (heard,) = discrepancy.sounds(sound)
    assert heard[SPEED, REFERENCE_OPTION].alone[:, 0] == pytest.approx([40.0, 20.0])
    assert heard[SPEED, "louder"].alone[:, 0] == pytest.approx([40.0, 10.0 * (2.0 + 300.0)])
    assert heard[SPEED, "quieter"].alone[:, 0] == pytest.approx([10.0, 20.0])


SQUARE = 4e-10 * 10.0**5.6
LEVEL = Datum("level", 56.0, 2.0, lambda bands: 10.0 * np.log10(bands.sum(axis=-1) / 4e-10))


def evidence_of(settings):
    remainder = SimpleNamespace(
        flat_lowest_db=-26.0, flat_highest_db=4.0, near_level_db=-2.0, near_deviation_db=3.0,
        spectrum=lambda hertz: np.where(np.abs(hertz - 5000.0) < 50.0, 1.0, 0.0),
    )  # fmt: skip
    noise = SimpleNamespace(likely_level_dba=56.0, likely_deviation_db=2.0, spectral_share=None)
    machine = SimpleNamespace(overall_noise=noise, remainder=remainder)
    study = SimpleNamespace(
        machine=machine, uncertainty=settings, baseline=None, catalogue_receiver="front",
        catalogue_case=(SPEED, REFERENCE_OPTION), evidence=SimpleNamespace(spectrum=None),
        catalogue_speed_rpm=SPEED,
    )  # fmt: skip
    axes = SimpleNamespace(receivers=["front"], sources=["low", "high"])
    return Evidence(SimpleNamespace(study=study, axes=axes, points={})), machine


def test_pairs_are_picked_as_their_weights_say():
    """Without discrepancy, modelled 6 dB below: the rest of 56 dB(A) is at -1.3 dB."""
    evidence, machine = evidence_of(NONE)
    sound = {(SPEED, REFERENCE_OPTION): sound_at(0.25 * SQUARE, 0.0)}
    published = evidence.published
    exact = np.exp(evidence.log_weights(sound, machine, 0, published))[0].sum(axis=0)
    sampled = [
        evidence.pairs(evidence.log_weights(sound, machine, number, published), number)
        for number in range(200)
    ]
    levels = np.concatenate([one.unmodelled_db for one in sampled])
    mean = np.average(LEVELS_DB, weights=exact)
    deviation = np.sqrt(np.average((LEVELS_DB - mean) ** 2, weights=exact))
    assert levels.size == 200 * PAIRS
    assert levels.mean() == pytest.approx(mean, abs=4.0 * deviation / np.sqrt(levels.size))
    assert levels.std() == pytest.approx(np.hypot(deviation, 1.0 / np.sqrt(12.0)), rel=0.05)
    assert sampled[0].weight[0].tolist() == [1.0] * PAIRS


def test_a_sample_without_solution_has_no_weight_beside_a_baseline():
    """Its bands are not numbers; beside it, one whose weights sum to its likelihood."""
    evidence, machine = evidence_of(NONE)
    evidence.nominal.points = {"front": None}
    evidence.nominal.relative_to_measured = lambda _: np.array([0.0])
    evidence.nominal.study.baseline = SimpleNamespace(tolerance_db=2.0)
    published, weight = evidence.published, {}
    for energy in (np.nan, 0.25 * SQUARE):
        sound = {(SPEED, REFERENCE_OPTION): sound_at(energy, 0.0)}
        weight[energy] = np.exp(evidence.log_weights(sound, machine, 0, published))
    found, without = weight[0.25 * SQUARE], weight[np.nan]
    assert without.tolist() == np.zeros(without.shape).tolist()
    measured = [
        np.exp(log_weight_of_points(np.zeros((1, 1)), 2.0, prior)) for prior in published.priors
    ]
    expected = np.broadcast_to(measured, found.shape[:2])
    np.testing.assert_allclose(found.sum(axis=2), expected, rtol=1e-12)


def test_systematic_picks_count_as_the_weights():
    weight = np.array([1.0, 0.0, 2.0, 5.0])
    assert np.bincount(systematic(weight, 80, 0.3)).tolist() == [10, 0, 20, 50]


def test_conflict_is_the_tail_of_the_prior_predictive():
    """Levels of 60 ± 3 dB beside 56 ± 2: the predictive is normal, and so is its density."""
    rng = np.random.default_rng(0)
    bands = 4e-10 * 10.0 ** (rng.normal(60.0, 3.0, (4000, 1)) / 10.0)
    expected_db = LEVEL.predicted(bands)[None]
    found = conflict_variables([LEVEL], expected_db, np.ones(4000), rng)
    tail = norm.cdf(-4.0 / np.hypot(3.0, 2.0))
    assert found["datum_tail"].values == pytest.approx([tail], rel=0.05)
    assert found["conflict_tail"].item() == pytest.approx(2.0 * tail, abs=0.05)  # both sides
    expected = 60.0 + 3.0 * norm.ppf([0.1, 0.5, 0.9])
    assert found["datum_expected"].values[0] == pytest.approx(expected, abs=0.2)


def test_level_of_the_model_alone_has_the_discrepancy():
    """Samples of 60 ± 4 dB whose path deviates by 3 dB: a normal level of 60 ± 5 dB."""
    rng = np.random.default_rng(1)
    settings = Uncertainty(
        path_deviation_db=3.0, source_deviation_db=0.0, band_deviation_db=0.0, seed=1
    )
    sounds = 4e-10 * 10.0 ** (rng.normal(60.0, 4.0, 6000) / 10.0)
    evidence = SimpleNamespace(
        mutual=lambda square: np.full((1, 1, len(GAIN_BANDS)), square / len(GAIN_BANDS)),
        discrepancy=lambda number: Discrepancy.of(settings, 1, number),
    )
    found = _model_alone(evidence, sounds, np.arange(6000), np.ones(6000))
    expected = 60.0 + 5.0 * norm.ppf([0.1, 0.5, 0.9])
    assert found["model_level"].values == pytest.approx(expected, abs=0.4)  # 3.5 sampling errors


def test_data_that_exclude_each_other_conflict_together_only():
    """Two data that are always equal in the model: both in the middle, then on either side."""
    rng = np.random.default_rng(0)
    bands = rng.normal(0.0, 3.0, (2000, 1))
    for values, low, high in (((0.0, 0.0), 0.9, 1.0), ((3.0, -3.0), 0.0, 0.001)):
        data = [Datum(str(n), one, 0.5, lambda b: b[:, 0]) for n, one in enumerate(values)]
        found = conflict_variables(data, np.repeat(bands.T, 2, axis=0), np.ones(2000), rng)
        assert found["datum_tail"].min() > 0.1
        assert low <= found["conflict_tail"].item() <= high
