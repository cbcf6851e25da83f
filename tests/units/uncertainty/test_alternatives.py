"""Level and shares with less evidence or another prior, of ensembles made by hand."""

import numpy as np
import pytest
from test_sample_evidence import NONE, SPEED, SQUARE, evidence_of, sound_at

from vibroacoustics.base.vocabulary import REFERENCE_OPTION
from vibroacoustics.levels.agreement import LEVELS_DB, Datum, log_weights
from vibroacoustics.levels.by_source import gain_band_number
from vibroacoustics.uncertainty.alternatives import alternative_variables

KEY = (SPEED, REFERENCE_OPTION)
HIGH = gain_band_number(np.array(2000.0))


def published(evidence, **changes):
    """The evidence with other published data or priors."""
    evidence.__dict__["published"] = evidence.published._replace(**changes)
    return evidence


def variables(levels, before, evidence=None):
    """Of samples with energies of a low and of a high source, relative to the published one."""
    evidence, machine = evidence or evidence_of(NONE)
    sounds = [{KEY: sound_at(low * SQUARE, high * SQUARE)} for low, high in levels]
    return alternative_variables(evidence, sounds, [machine] * len(levels), np.array(before))


def test_the_second_prior_weighs_and_the_first_does_not():
    """One sample without discrepancy: shares over the levels of unmodelled noise alone."""
    evidence, machine = evidence_of(NONE)
    found = variables([(0.1, 0.3)], [1.0])
    assert found["alternative"].values.tolist() == ["other prior"]
    assert found["energy_part"].values.tolist() == ["low", "high", "unmodelled"]
    data, priors = evidence.published.data, evidence.published.priors
    mutual = evidence.mutual({KEY: sound_at(0.1 * SQUARE, 0.3 * SQUARE)}).sum(axis=(0, 1))
    weight = np.exp(log_weights(mutual[None], evidence.unmodelled(machine), data, priors[1]))[0]
    rest = 10.0 ** (LEVELS_DB / 10.0)
    total = 0.4 + rest
    mean = np.array([np.average(part / total, weights=weight) for part in (0.1, 0.3, rest)])
    # Ten pairs stand for the levels of unmodelled noise.
    np.testing.assert_allclose(found["alternative_share"].values[0], mean, atol=0.05)
    level = np.average(10.0 * np.log10(total), weights=weight) + 56.0
    assert found["alternative_level"].item() == pytest.approx(level, abs=0.5)
    flat = np.exp(log_weights(mutual[None], evidence.unmodelled(machine), data, priors[0]))[0]
    assert abs(np.average(rest / total, weights=flat) - mean[2]) > 0.1
    assert found["alternative_effective"].item() == pytest.approx(1.0)


def test_shares_add_up_and_keep_the_ratio_of_the_sources():
    found = variables([(0.01, 0.03)] * 3, [1.0, 1.0, 0.0])
    share = found["alternative_share"].values
    np.testing.assert_allclose(share.sum(axis=1), 1.0)
    assert share[0, 1] == pytest.approx(3.0 * share[0, 0])
    assert share[0, 2] > 0.9
    assert found["alternative_effective"].values == pytest.approx([2.0])
    for name in ("alternative_share", "alternative_level"):
        low, high = (found[f"{name}{end}"] for end in ("_10_percent", "_90_percent"))
        assert (low <= found[name]).all()
        assert (found[name] <= high).all()


def test_a_sample_counts_by_its_weight_before_the_data_and_by_its_likelihood():
    """A second sample 20 dB too loud has no weight; equal ones share theirs."""
    alone, beside = variables([(0.2, 0.0)], [1.0]), variables([(0.2, 0.0), (100.0, 0.0)], [1.0] * 2)
    np.testing.assert_allclose(beside["alternative_share"], alone["alternative_share"], atol=1e-6)
    assert beside["alternative_effective"].item() == pytest.approx(1.0, abs=1e-6)
    halves = variables([(0.2, 0.0), (0.0, 0.2)], [3.0, 1.0])["alternative_share"].values[0]
    assert halves[0] == pytest.approx(3.0 * halves[1], rel=0.3)


def test_without_a_second_prior_or_datum_there_is_none():
    evidence, machine = evidence_of(NONE)
    published(evidence, priors=evidence.published.priors[:1])
    assert not variables([(0.1, 0.3)], [1.0], (evidence, machine)).data_vars


def test_the_published_level_alone_is_an_alternative_where_there_is_more():
    evidence, machine = evidence_of(NONE)
    share = Datum("share", 0.9, 0.05, lambda bands: bands[..., HIGH] / bands.sum(axis=-1))
    published(evidence, data=[*evidence.published.data, share])
    levels = [(0.3, 0.001), (0.001, 0.3)]
    found = variables(levels, [1.0, 1.0], (evidence, machine))
    assert found["alternative"].values.tolist() == ["level alone", "other prior"]
    alone, both = found["alternative_share"].values
    assert alone[:2].min() > 0.1
    assert both[1] > 100.0 * both[0]
