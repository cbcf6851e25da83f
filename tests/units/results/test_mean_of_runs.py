"""Several runs of several specimens as one result: means, deviations, what is refused."""

import numpy as np
import pytest
from test_order_comparison import recorded

from vibroacoustics import compare, mean_of_runs
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.results.mean_of_runs import runs_of, with_scatter
from vibroacoustics.results.scatter import scatter


def test_mean_is_of_energies_and_deviation_of_levels():
    found = scatter(np.array([60.0, 62.0, 64.0]), ["a", "a", "a"])
    assert found.mean == pytest.approx(10.0 * np.log10(np.mean(10.0 ** np.array([6.0, 6.2, 6.4]))))
    assert found.run_deviation == pytest.approx(2.0)
    assert np.isnan(found.specimen_deviation)
    assert found.uncertainty == pytest.approx(2.0 / np.sqrt(3.0))


def test_runs_and_specimens_are_told_apart():
    """Two specimens 4 dB apart, runs ±1 dB: s_w² = 2, s_m² = 8, s_b² = 8 - 2/2."""
    found = scatter(np.array([59.0, 61.0, 63.0, 65.0]), ["a", "a", "b", "b"])
    assert found.run_deviation == pytest.approx(np.sqrt(2.0))
    assert found.specimen_deviation == pytest.approx(np.sqrt(7.0))
    assert found.uncertainty == pytest.approx(2.0)


def test_one_run_each_tells_both_together():
    found = scatter(np.array([60.0, 64.0]), ["a", "b"])
    assert np.isnan(found.run_deviation)
    assert found.specimen_deviation == pytest.approx(np.sqrt(8.0))
    assert np.isnan(scatter(np.array([60.0]), ["a"]).uncertainty)


def test_variances_sampled_are_found_again():
    """Of 400 sets of 6 specimens with 4 runs the mean estimates are what was sampled."""
    generator = np.random.default_rng(2)
    specimen = generator.normal(0.0, 1.5, (6, 1, 400))
    level = (60.0 + specimen + generator.normal(0.0, 0.5, (6, 4, 400))).reshape(24, 400)
    found = scatter(level, np.repeat(list("abcdef"), 4).tolist())
    assert np.mean(found.run_deviation**2) == pytest.approx(0.25, rel=0.05)
    assert np.mean(found.specimen_deviation**2) == pytest.approx(2.25, rel=0.1)
    assert np.mean(found.uncertainty**2) == pytest.approx(2.25 / 6.0 + 0.25 / 24.0, rel=0.1)


@pytest.mark.parametrize(("deviation_db", "least"), [(1.0, 0.94), (2.0, 0.93), (3.0, 0.92)])
def test_interval_covers_the_energy_mean(deviation_db, least):
    """Levels of a normal distribution: true energy mean ln(10)/20 s² above their mean.

    The share of 20,000 sets is uncertain by 0.0036 at two standard errors.
    """
    generator = np.random.default_rng(5)
    true_db = np.log(10.0) / 20.0 * deviation_db**2
    level = generator.normal(0.0, deviation_db, (5, 20_000))
    for specimens in (list("abcde"), ["a"] * 5):
        found = scatter(level, specimens)
        covered = np.mean(np.abs(found.mean - true_db) <= found.interval)
        assert least - 0.0036 <= covered <= 0.95 + 0.0036


def test_runs_at_almost_the_same_speed_are_one():
    first = recorded({"front": ("Pa", 1.0), "shell": ("m/s²", 2.0)})
    second = recorded({"front": ("Pa", 3.0)}, speeds=(2905.0,), orders=(1.0, 2.0, 3.0))
    mean = mean_of_runs([first, second])
    assert mean["channel"].values.tolist() == ["front"]
    assert mean["speed"].item() == 2900.0
    np.testing.assert_allclose(np.abs(mean["channel_order"]), np.sqrt(5.0))
    assert [run["specimen"] for run in runs_of(mean)] == ["1", "1"]
    compared = with_scatter(compare(first, mean), mean)
    expected = 20.0 * np.log10(3.0) / np.sqrt(2.0)
    np.testing.assert_allclose(compared["order_run_deviation"], expected)


@pytest.mark.parametrize(
    ("other", "specimens", "words"),
    [
        (recorded({"back": ("Pa", 1.0)}), (), "no channel of one name and unit"),
        (recorded({"front": ("m/s²", 1.0)}), (), "no channel of one name and unit"),
        (recorded({"front": ("Pa", 1.0)}, speeds=(1000.0,)), (), "no speed in common"),
        (recorded({"front": ("Pa", 1.0)}, orders=(5.0,)), (), "no order in common"),
        (recorded({"front": ("Pa", 1.0)}), ("a",), "specimens: 1 for 2 runs"),
    ],
)
def test_runs_that_do_not_go_together(other, specimens, words):
    with pytest.raises(ParameterError, match=words):
        mean_of_runs([recorded({"front": ("Pa", 1.0)}), other], specimens)
