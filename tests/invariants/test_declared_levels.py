"""Declared sound power levels hold the truth of synthetic machines (ISO 4871).

A truth has random sources, a discrepancy of its own, unmodelled noise of a level from its prior,
and production scatter where it is one of a batch. Its published level is its own level at a
microphone with the deviation of the datum. The ensemble of other machines is weighted by it.
"""

from dataclasses import dataclass

import numpy as np
import pytest
from sources_study import SOURCES_STUDY

from vibroacoustics.declaration.sound import power_db
from vibroacoustics.levels.agreement import LEVELS_DB, data_of, log_weights, priors_of
from vibroacoustics.levels.by_source import GAIN_BANDS
from vibroacoustics.levels.declared_level import combined_deviation_db, upper_limit_db
from vibroacoustics.machine.remainder import OverallNoise, UnmodelledNoise
from vibroacoustics.results.data_sheet import SoundPower
from vibroacoustics.study.loading import load_study
from vibroacoustics.uncertainty.discrepancy import DISCREPANCIES, Discrepancy
from vibroacoustics.uncertainty.evidence import systematic

SURFACE_M2 = np.array([6.3, 7.9, 9.4, 14.1])
"""Of the hemispheres through four microphones; the level is published at the first."""
DEVIATION_DB = 2.0
SOURCES = {"moving_parts": (20.0, 3.0), "gas": (50.0, 6.0), "keys": (46.0, 8.0)}
"""Mean and standard deviation of A-weighted levels at a microphone."""
SAMPLES, PICKS = 200, 2000
REFERENCE = 4e-10


@dataclass(frozen=True)
class Machines:
    """Random machines.

    Attributes
    ----------
    modelled : mean square at each microphone, shape (machine, discrepancy, microphone), Pa²
    """

    modelled: np.ndarray

    @classmethod
    def of(cls, rng: np.random.Generator, count: int, first: int) -> "Machines":
        """Energies of machines whose discrepancies are those of numbers from `first` on."""
        settings = load_study(SOURCES_STUDY).uncertainty
        shape = (count, len(SOURCES), SURFACE_M2.size)
        mean, spread = np.array(list(SOURCES.values())).T[:, :, None]
        level = mean + spread * rng.standard_normal((count, len(SOURCES), 1))
        level = level + rng.normal(0.0, 2.0, shape)  # directivity
        band = rng.dirichlet(0.3 * np.ones(len(GAIN_BANDS)), (count, len(SOURCES)))
        energy = REFERENCE * 10.0 ** (level[..., None] / 10.0) * band[:, :, None]
        gains = np.array(
            [Discrepancy.of(settings, len(SOURCES), first + n).gain for n in range(count)]
        )
        return cls(np.einsum("nsmb,ndsb->ndm", energy, gains))


def power_of(modelled: np.ndarray, unmodelled: np.ndarray) -> np.ndarray:
    """L_WA of mean squares at the microphones, with unmodelled noise that is equal at all, dB."""
    level = 10.0 * np.log10((modelled + unmodelled[..., None]) / REFERENCE)
    return power_db(level, SURFACE_M2)


def posterior_db(ensemble: Machines, published_dba: float, rng: np.random.Generator) -> np.ndarray:
    """L_WA of samples with equal weights, picked by the likelihood of the published level."""
    noise = OverallNoise(
        level_dba=published_dba, speed_rpm=2900.0, distance_m=1.0, deviation_db=DEVIATION_DB
    )
    published = REFERENCE * 10.0 ** (published_dba / 10.0)
    modelled = ensemble.modelled.reshape(-1, SURFACE_M2.size)
    prior, _ = priors_of(UnmodelledNoise())
    weight = log_weights(modelled[:, :1], np.array([published]), data_of(noise), prior)
    picks = systematic(np.exp(weight - weight.max()).ravel(), PICKS, rng.uniform())
    sample, level = np.divmod(picks, LEVELS_DB.size)
    level_db = LEVELS_DB[level] + rng.uniform(-0.5, 0.5, PICKS)
    return power_of(modelled[sample], published * 10.0 ** (level_db / 10.0))


def declared_limits(
    truths: Machines, ensemble: Machines, batch_db: float | None, rng: np.random.Generator
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """True L_WA, L_WA + K_WA, and their sum in whole decibels, each of shape (machine,)."""
    middle = 10.0 * np.log10(np.median(ensemble.modelled[:, :, 0]) / REFERENCE)
    weight = np.full(PICKS, 1.0 / PICKS)
    rows = []
    for modelled in truths.modelled[:, 0]:
        unmodelled = np.array(REFERENCE * 10.0 ** ((middle + rng.uniform(-26.0, 4.0)) / 10.0))
        level = 10.0 * np.log10((modelled[0] + unmodelled) / REFERENCE)
        samples_db = posterior_db(ensemble, level + rng.normal(0.0, DEVIATION_DB), rng)
        median = float(np.median(samples_db))
        limit = upper_limit_db(samples_db, weight, combined_deviation_db(batch_db))
        sheet = SoundPower.model_construct(level_dba=median, uncertainty_k_db=limit - median)
        assert sheet.declared is not None
        true = float(power_of(modelled, unmodelled)) + rng.normal(0.0, batch_db or 0.0)
        rows.append((true, limit, sum(sheet.declared)))
    true, limits, whole = np.array(rows).T
    return true, limits, whole


@pytest.fixture(scope="module")
def ensemble() -> Machines:
    return Machines.of(np.random.default_rng(1), SAMPLES, 0)


@pytest.mark.parametrize("batch_db", [None, 2.0])
def test_declared_upper_limits_hold_the_truth(ensemble: Machines, batch_db: float | None) -> None:
    """In 90 to 99 of 100: four times 100 machines, so that chance is 1 % of them."""
    assert ensemble.modelled.shape == (SAMPLES, DISCREPANCIES, SURFACE_M2.size)
    rng = np.random.default_rng(9)
    truths = Machines.of(rng, 400, 100_000)
    true, limit, whole = declared_limits(truths, ensemble, batch_db, rng)
    held, held_whole = (100.0 * float(np.mean(true <= one)) for one in (limit, whole))
    measured = 100.0 * float(np.mean(true + rng.normal(0.0, 1.5, true.size) <= limit))
    print(f"batch {batch_db}: of 100 {held:.1f}, {held_whole:.1f} whole, {measured:.1f} measured")
    assert 93.0 <= held <= 99.0
    assert held <= held_whole <= 99.0
    assert 90.0 <= measured <= 98.0


def test_limits_are_not_far_above_the_truth(ensemble: Machines) -> None:
    """A limit that holds everything would say nothing: K_WA is a few decibels."""
    rng = np.random.default_rng(2)
    truths = Machines.of(rng, 100, 200_000)
    true, limit, _ = declared_limits(truths, ensemble, None, rng)
    assert 3.0 < float(np.median(limit - true)) < 6.0


def test_limits_without_production_do_not_hold_a_batch(ensemble: Machines) -> None:
    """The scatter of the machines counts: 95 % need it."""
    rng = np.random.default_rng(9)
    truths = Machines.of(rng, 400, 100_000)
    true, limit, _ = declared_limits(truths, ensemble, None, rng)
    scattered = true + rng.normal(0.0, 4.0, true.size)
    assert np.mean(scattered <= limit) < 0.90
