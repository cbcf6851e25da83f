"""Weights of samples by published data, whatever the unmodelled noise is."""

import numpy as np
import pytest
from scipy.integrate import quad

from vibroacoustics.levels.agreement import (
    LEVELS_DB,
    data_of,
    effective_samples,
    log_weight_of_points,
    log_weights,
    priors_of,
)
from vibroacoustics.levels.by_source import GAIN_BANDS
from vibroacoustics.machine.remainder import OverallNoise, SpectralShare, UnmodelledNoise

DEVIATION_DB = 2.0
NOISE = OverallNoise(level_dba=56.0, speed_rpm=2900.0, distance_m=1.0, deviation_db=DEVIATION_DB)
WITH_SHARE = NOISE.model_copy(
    update={"spectral_share": SpectralShare(below_hz=900.0, share_ratio=0.3, deviation_ratio=0.15)}
)
PRIORS = priors_of(UnmodelledNoise())
FLAT, NEAR = PRIORS
SQUARE = 4e-10 * 10.0**5.6
"""Of 56 dB(A), Pa²."""
MIDDLE_HZ = np.array([band.middle_hz for band in GAIN_BANDS])
LOW, HIGH = (np.argmin(np.abs(MIDDLE_HZ - hertz)) for hertz in (500.0, 2000.0))


def bands_at(column, *relative_db):
    """Energy in one band, relative to the published level."""
    bands = np.zeros((len(relative_db), len(GAIN_BANDS)))
    bands[:, column] = SQUARE * 10.0 ** (np.array(relative_db) / 10.0)
    return bands


def weights(relative_db, prior=FLAT, noise=NOISE):
    """Of samples whose sound is low, with unmodelled noise that is high."""
    found = log_weights(bands_at(LOW, *relative_db), bands_at(HIGH, 0.0)[0], data_of(noise), prior)
    return np.exp(found)


def integrand(level_db, modelled_db, prior, share):
    low, high = 10.0 ** (modelled_db / 10.0), 10.0 ** (level_db / 10.0)
    off = 10.0 * np.log10(low + high) / DEVIATION_DB
    if share is not None:
        off = np.hypot(off, (low / (low + high) - share) / 0.15)
    return float(prior.density(np.array(level_db))) * np.exp(-0.5 * off**2)


@pytest.mark.parametrize("prior", PRIORS, ids=lambda prior: prior.name)
@pytest.mark.parametrize("noise", [NOISE, WITH_SHARE], ids=["level", "both"])
def test_weights_are_the_integrals_over_the_prior(prior, noise):
    """The step of 1 dB, half a deviation, costs the trapezium rule the ends of the flat prior:
    half a step of thirty, where the likelihood is not nothing."""
    modelled = [-40.0, -10.0, -3.0, 0.0, 2.0, 6.0]
    share = None if noise.spectral_share is None else 0.3
    exact = np.array(
        [
            quad(integrand, -26.5, 4.5, (level, prior, share), points=[-26.0, 4.0], limit=200)[0]
            for level in modelled
        ]
    )
    lowest, highest = (-26.0, 4.0) if prior is FLAT else (-40.0, 10.0)
    scale = quad(lambda level: float(prior.density(np.array(level))), lowest, highest)[0]
    weight = weights(modelled, prior, noise).sum(axis=1)
    assert weight == pytest.approx(exact / scale, rel=0.06, abs=1e-6)


def test_share_is_that_below_its_frequency():
    """The third octave at 1 kHz lies from 891 to 1122 Hz; 4 % of it below 900 Hz."""
    _, share = data_of(WITH_SHARE)
    one_khz = int(np.argmin(np.abs(MIDDLE_HZ - 1000.0)))
    assert share.predicted(bands_at(LOW, 0.0) + bands_at(HIGH, 0.0)) == pytest.approx(0.5)
    assert share.predicted(bands_at(LOW + 2, 0.0)) == pytest.approx(1.0)
    part = np.log(900.0 / 891.25) / np.log(1122.02 / 891.25)
    assert share.predicted(bands_at(one_khz, 0.0)) == pytest.approx(part, rel=1e-4)


def test_the_share_moves_energy_from_the_sample_to_unmodelled_noise():
    """A low sample at the published level: the level alone allows it, the share does not."""
    alone, both = (weights([0.0], noise=noise)[0] for noise in (NOISE, WITH_SHARE))
    assert both.sum() < 0.1 * alone.sum()
    quiet = weights([-5.2], noise=WITH_SHARE)[0]  # 0.3 of the energy
    assert LEVELS_DB[quiet.argmax()] == pytest.approx(-1.5, abs=1.0)


def test_priors_are_settings_of_the_machine():
    """Their words and densities follow; limits that are no range are refused in one line."""
    given = UnmodelledNoise(flat_lowest_db=-10.0, flat_highest_db=0.0, near_level_db=1.0)
    flat, near = priors_of(given)
    assert flat.words == "anywhere from 10 dB below to 0 dB above the published level"
    assert near.words == "1 dB above the published level, give or take 3 dB"
    level = np.array([-11.0, -9.0, 1.0])
    assert flat.density(level).tolist() == [0.0, 1.0, 0.0]
    assert near.density(level).argmax() == 2
    assert np.exp(flat.log_density).sum() == pytest.approx(1.0)
    with pytest.raises(ValueError, match=r"flat_lowest_db = 3\.5 dB: must be at least 1 dB below"):
        UnmodelledNoise(flat_lowest_db=3.5)


def test_a_loud_sample_counts_less_and_one_without_solution_not_at_all():
    weight = weights([0.0, 4.0, 8.0, np.nan]).sum(axis=1)
    assert np.all(np.diff(weight) < 0.0)
    assert weight[3] == 0.0


def test_unmodelled_noise_completes_a_sample_to_the_published_level():
    weight = weights([-40.0, -3.0])
    assert LEVELS_DB[weight[0].argmax()] == pytest.approx(0.0)
    assert LEVELS_DB[weight[1].argmax()] == pytest.approx(-3.0)


def test_points_weigh_together_as_one_measurement():
    over = np.array([-10.0, -1.0, 3.0, np.nan])
    alone = log_weight_of_points(over[None], 2.0, FLAT)
    np.testing.assert_allclose(log_weight_of_points(np.array([over] * 30), 2.0, FLAT), alone)
    np.testing.assert_allclose(np.exp(alone), weights(over).sum(axis=1))
    other = over[::-1] - 2.0
    pair = log_weight_of_points(np.array([over, other]), 2.0, FLAT)
    np.testing.assert_allclose(pair, 0.5 * (alone + log_weight_of_points(other[None], 2.0, FLAT)))


def test_effective_samples():
    assert effective_samples(np.ones(7)) == pytest.approx(7.0)
    assert effective_samples(np.array([0.5, 0.0])) == pytest.approx(1.0)
    assert effective_samples(np.full(5, 1e-9)) == pytest.approx(5.0)
    assert effective_samples(np.zeros(3)) == 0.0


@pytest.mark.parametrize(
    ("kind", "likely_dba", "deviation_db"),
    [("measured", 56.0, 2.0), ("declared", 53.5, 2.5), ("series", 55.0, np.sqrt(8.0))],
)
def test_a_declared_level_stands_for_a_quieter_machine(kind, likely_dba, deviation_db):
    """The datum lies the bias of its kind below the published level and scatters as much more."""
    noise = OverallNoise(level_dba=56.0, speed_rpm=2900.0, distance_m=1.0, kind=kind)
    (level,) = data_of(noise)
    assert (level.value, level.deviation) == pytest.approx((likely_dba, deviation_db))
