"""Gaussian process and expected improvement against closed forms, densities and quadrature."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import gamma, kv
from scipy.stats import multivariate_normal, norm

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.design.search.active import augmented_improvement, expected_improvement
from vibroacoustics.design.search.gaussian_process import Process, Runs, fitted, matern

SIGNAL, LENGTHS, NOISE = 1.7, np.array([0.4, 0.9]), 0.06
RNG = np.random.default_rng(3)
DESIGNS = RNG.random((5, 2))
ROWS = np.array([0, 1, 1, 2, 3, 3, 3, 4])
RUNS = RNG.normal(60.0, 1.3, ROWS.size)
"""Eight runs of five designs, of which two are repeated."""
PROCESS = Process(Runs.of(DESIGNS[ROWS], RUNS), SIGNAL, LENGTHS, NOISE)


def covariance(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Matérn's covariance of any smoothness by Bessel's function, RW (4.14), at 5/2."""
    smoothness = 2.5
    result = np.full((len(first), len(second)), SIGNAL)
    for row, one in enumerate(first):
        for column, other in enumerate(second):
            distance = np.sqrt(2.0 * smoothness * (((one - other) / LENGTHS) ** 2).sum())
            if distance > 0.0:
                result[row, column] *= (
                    2.0 ** (1.0 - smoothness)
                    / gamma(smoothness)
                    * distance**smoothness
                    * kv(smoothness, distance)
                )
    return result


def of_all_runs() -> np.ndarray:
    """Covariance of the eight runs, each by itself."""
    return covariance(DESIGNS[ROWS], DESIGNS[ROWS]) + NOISE * np.eye(ROWS.size)


def test_covariance_is_that_of_bessel_functions() -> None:
    """Rounding of K_5/2: 1e-12."""
    other = RNG.random((4, 2))
    np.testing.assert_allclose(
        matern(DESIGNS, other, SIGNAL, LENGTHS), covariance(DESIGNS, other), rtol=1e-12
    )


def test_posterior_is_the_conditional_normal_distribution_of_all_runs() -> None:
    """The mean's prior has the variance 1e6: its share of 1/(1e6 1ᵀK⁻¹1) is below 1e-6."""
    at, vague = RNG.random((6, 2)), 1e6
    joint = of_all_runs() + vague
    across = covariance(DESIGNS[ROWS], at) + vague
    solved = np.linalg.solve(joint, across)
    variance = SIGNAL + vague - np.einsum("ij,ij->j", across, solved)
    mean, deviation = PROCESS.posterior(at)
    np.testing.assert_allclose(mean, 60.0 + solved.T @ (RUNS - 60.0), rtol=1e-6)
    np.testing.assert_allclose(deviation**2, variance, rtol=1e-5)


def test_posterior_of_one_design_by_hand() -> None:
    """Two designs far apart: the level is their mean, each pulled to it by s/(s + n/2)."""
    far = Process(Runs(np.array([[0.0], [1.0]]), np.array([1.0, 3.0]), np.array([2.0, 2.0]), 0.0),
                  4.0, np.array([1e-3]), 2.0)  # fmt: skip
    mean, deviation = far.posterior(np.array([[0.0], [1.0], [0.5]]))
    np.testing.assert_allclose(mean, [2.0 - 0.8, 2.0 + 0.8, 2.0])
    # 4 - 16/5 and, of the level, (1 - 4/5)² 5/2; halfway 4 and all of the level's 5/2.
    np.testing.assert_allclose(deviation**2, [0.8 + 0.1, 0.8 + 0.1, 4.0 + 2.5])


def test_likelihood_is_that_of_all_runs() -> None:
    expected = multivariate_normal(np.full(ROWS.size, PROCESS.level), of_all_runs()).logpdf(RUNS)
    assert pytest.approx(expected, abs=1e-9) == PROCESS.log_likelihood


def test_level_is_that_of_generalised_least_squares() -> None:
    weight = np.linalg.solve(of_all_runs(), np.ones(ROWS.size))
    assert pytest.approx(weight @ RUNS / weight.sum(), rel=1e-12) == PROCESS.level


def test_slope_of_the_likelihood_by_differences() -> None:
    """Central differences of 1e-5: their error is of the order of 1e-10 and rounding 1e-10."""
    logarithms = np.log([SIGNAL, *LENGTHS, NOISE])

    def likelihood(step: np.ndarray) -> float:
        signal, *lengths, noise = np.exp(logarithms + step).tolist()
        return Process(PROCESS.runs, signal, np.array(lengths), noise).log_likelihood

    steps = 1e-5 * np.eye(logarithms.size)
    slope = [(likelihood(step) - likelihood(-step)) / 2e-5 for step in steps]
    np.testing.assert_allclose(PROCESS.slope, slope, rtol=1e-6, atol=1e-7)


def test_repeated_runs_give_the_pure_error() -> None:
    """Squares about the means of two and of three runs, over three degrees of freedom."""
    squares = RUNS[1:3].var() * 2 + RUNS[4:7].var() * 3
    assert PROCESS.runs.pure_error == pytest.approx(squares / 3.0)
    assert Runs.of(DESIGNS, RUNS[:5]).pure_error is None


def test_fit_finds_the_noise_of_repeated_runs() -> None:
    """40 designs twice, 0.24 dB about a wave: 99 % of √(χ²/40) are within 0.72 and 1.29."""
    designs = np.repeat(np.random.default_rng(0).random((40, 1)), 2, axis=0)
    noise = 0.24 * np.random.default_rng(1).standard_normal(80)
    process = fitted(Runs.of(designs, 3.0 * np.sin(6.0 * designs[:, 0]) + noise))
    assert 0.72 < np.sqrt(process.noise) / 0.24 < 1.29
    mean, deviation = process.posterior(np.linspace(0.05, 0.95, 50)[:, None])
    off = np.abs(mean - 3.0 * np.sin(6.0 * np.linspace(0.05, 0.95, 50)))
    assert (off < 4.0 * deviation).all()


def test_fit_of_one_design_is_refused() -> None:
    with pytest.raises(ParameterError, match="two designs or more"):
        fitted(Runs.of(np.zeros((3, 1)), np.arange(3.0)))


@pytest.mark.parametrize(("mean", "deviation"), [(60.0, 0.5), (61.0, 0.3), (58.5, 1.0)])
def test_expected_improvement_by_quadrature(mean: float, deviation: float) -> None:
    best = 60.2
    expected, _ = quad(
        lambda y: (best - y) * norm.pdf(y, mean, deviation), mean - 12.0 * deviation, best,
        epsabs=1e-12,
    )  # fmt: skip
    gain = expected_improvement(np.array([mean]), np.array([deviation]), best)
    assert gain[0] == pytest.approx(expected, rel=1e-8, abs=1e-12)


def test_expected_improvement_of_a_certain_design() -> None:
    gain = expected_improvement(np.array([59.0, 61.0]), np.zeros(2), 60.0)
    np.testing.assert_allclose(gain, [1.0, 0.0])


def test_noise_takes_its_share_of_the_expected_improvement() -> None:
    """None without noise; 1 - 3/5 with deviation 4 and noise 9; all at a certain design."""
    values = np.array([59.0]), np.array([4.0])
    plain = expected_improvement(*values, 60.0)
    np.testing.assert_allclose(augmented_improvement(*values, 60.0, 0.0), plain)
    np.testing.assert_allclose(augmented_improvement(*values, 60.0, 9.0), 0.4 * plain)
    assert augmented_improvement(np.array([59.0]), np.zeros(1), 60.0, 9.0)[0] == 0.0
