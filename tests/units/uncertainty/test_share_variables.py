"""Shares of unknowns in the level of a bank, and their information for a choice, labelled."""

import numpy as np
import pytest
import xarray as xr
from sources_study import SOURCES_STUDY

from vibroacoustics.base.vocabulary import stamp
from vibroacoustics.study.loading import load_study
from vibroacoustics.study.sampling import latin_hypercubes
from vibroacoustics.uncertainty.choices import (
    SOUND,
    SOUND_AND_FOOT_FORCE,
    choice_information,
)
from vibroacoustics.uncertainty.every_sample import sampled_values
from vibroacoustics.uncertainty.prior_ensemble import PriorEnsemble, Weighted
from vibroacoustics.uncertainty.share_variables import level_shares

SAMPLES = 400
GAIN, PITCH = "variation.mobility_change_db", "mounts.pitch_m"


@pytest.fixture(scope="module")
def study():
    return load_study(SOURCES_STUDY)


@pytest.fixture(scope="module")
def samples(study):
    settings = study.uncertainty.model_copy(update={"random_samples": SAMPLES})
    return next(latin_hypercubes(study.ranges, settings))


def values(study, samples, name):
    """From -1 to 1 in its range."""
    (limits,) = (one for one in study.ranges if one.name == name)
    sampled = np.array([sample[limits.table, limits.field] for sample in samples])
    return 2.0 * (sampled - limits.lowest) / (limits.highest - limits.lowest) - 1.0


def test_level_shares_before_and_after(study, samples):
    """The level is the gain, and the mounts' a little; without enough weight only before."""
    level = 10.0 * values(study, samples, GAIN) + 3.0 * values(study, samples, PITCH)
    alike, few = (
        PriorEnsemble(samples, Weighted([], [], level, np.full((2, SAMPLES), one)), SAMPLES)
        for one in (0.0, -np.inf)
    )
    labelled = level_shares(study.ranges, alike, np.ones(SAMPLES))
    for knowledge in ("before", "flat", "near"):
        here = labelled.sel(knowledge=knowledge)
        share = here["level_share"]
        assert float(share.sel(uncertain_parameter=GAIN)) == pytest.approx(100.0 / 109.0, abs=0.03)
        # A deviation of a share s of n samples: √(4 s (1 − s)² / n) = 0.026.
        assert float(share.sel(uncertain_parameter=PITCH)) == pytest.approx(9.0 / 109.0, abs=0.06)
        assert (
            float(here["level_share_low"].sel(uncertain_parameter=GAIN)) > here["level_share_floor"]
        )
    few = level_shares(study.ranges, few, np.ones(SAMPLES))
    assert np.isfinite(few["level_share_floor"].values).tolist() == [True, False, False]


def test_information_for_the_choice_among_options_to_be_built(study, samples):
    """Each choice at the worst speed: sound by one unknown, sound and foot force by another."""
    pairs, names = 2, ["none", "ring", "printed"]
    study = study.replace(
        {
            f"options.{name}": {
                "kind": kind,
                "stiffness_n_per_mm": 14.65,
                "tuned_speed_rpm": 3500.0,
                "damping_ratio": 0.05,
                "height_below_ring_mm": 0.0,
            }
            for name, kind in (("ring", "spring-mass"), ("printed", "spring-mass-printed"))
        }
    )
    axes = {"sample": np.arange(1, pairs * SAMPLES + 1), "speed": [3500.0, 2950.0]}
    axes |= {"option": names, "receiver": ["front_1m"]}
    gain, pitch = (np.repeat(values(study, samples, one), pairs) for one in (GAIN, PITCH))
    total = np.full((pairs * SAMPLES, 2, 3, 1), 56.0)
    total[:, :, 1, 0] += np.stack([4.0 * gain, 4.0 * gain - 1.0], axis=1)
    total[:, 0, 1, 0] += np.tile([0.5, -0.5], SAMPLES)  # evens out over the pairs of a sample
    total[:, :, 2, 0] -= 40.0
    force = np.full(total.shape[:3], 20.0)
    force[:, 1, 1] *= 10.0 ** ((8.0 * pitch + 1.0) / 20.0)
    force[:, 0, 1] *= 1e-4
    weight = np.full((2, pairs * SAMPLES), 1.0 / (pairs * SAMPLES))
    of_samples = {
        "level_total_by_sample": stamp("level_total_by_sample", total, axes),
        "foot_force_1x_by_sample": stamp(
            "foot_force_1x_by_sample",
            force,
            {key: axes[key] for key in ("sample", "speed", "option")},
        ),
        "sample_weight": stamp(
            "sample_weight", weight, {"prior": ["flat", "near"], "sample": axes["sample"]}
        ),
    }
    sampled = sampled_values(study.ranges, samples).isel(
        sample=np.repeat(np.arange(SAMPLES), pairs)
    )
    levels = xr.Dataset(of_samples).merge(sampled.assign_coords(sample=axes["sample"]))
    told = choice_information(study, levels, pairs)
    assert told["choice_option"].values.tolist() == ["none", "ring"]
    sound, both = (told.sel(choice=name) for name in (SOUND, SOUND_AND_FOOT_FORCE))
    # E max(-4 x, 0) of x from -1 to 1 is 1; at the other speed the option is 1 dB quieter.
    assert float(sound["parameter_information"].sel(uncertain_parameter=GAIN)) == pytest.approx(
        1.0, abs=0.1
    )
    assert float(sound["parameter_information_votes"].sel(uncertain_parameter=GAIN)) == 5.0
    # A quarter of a decibel of ±0.5 is known only with the pair: ±0.5 and 4 x overlap in 1/8.
    assert float(sound["perfect_information"]) == pytest.approx(1.0, abs=0.1)
    # 4 x + 8 y at the speed of the louder foot force, -1 + 1 + ...: y decides, E max = 2.
    assert float(both["parameter_information"].sel(uncertain_parameter=PITCH)) == pytest.approx(
        2.0, abs=0.25
    )
    assert float(both["choice_utility"].sel(choice_option="ring")) == pytest.approx(0.0, abs=0.3)
    alone = choice_information(study, levels.sel(option=["none", "printed"]), pairs)
    assert not alone.data_vars
