"""Sliders: choice of parameters, interpolation and addition, agreement with the chain."""

import numpy as np
import pytest
from sources_study import SOURCES_STUDY, made_up_modes

from vibroacoustics.levels.changes import change_at, total_change
from vibroacoustics.levels.nominal import NominalSound, by_source
from vibroacoustics.levels.remainder import remaining
from vibroacoustics.levels.sample_levels import lines_of
from vibroacoustics.machine.cases import Cases
from vibroacoustics.stages.chain import Chain
from vibroacoustics.stages.forces import with_published
from vibroacoustics.stages.representative import Representative
from vibroacoustics.stages.stage import advanced, applying
from vibroacoustics.study.loading import load_study
from vibroacoustics.study.samples import with_sample
from vibroacoustics.study.sampling import sample_at
from vibroacoustics.study.uncertainty import Range
from vibroacoustics.transfer.contributions import Transmission
from vibroacoustics.uncertainty.evidence import Evidence
from vibroacoustics.uncertainty.prior_ensemble import PriorEnsemble
from vibroacoustics.uncertainty.representative import nearest_row
from vibroacoustics.uncertainty.slider_variables import HOOD, SETTINGS, slider_variables
from vibroacoustics.uncertainty.sliders import (
    LEAST_DB,
    MOST_CANDIDATES,
    NODES,
    band_levels,
    candidates,
    chosen_sliders,
)

LOUD, RESONANT, WEAK, UNSOLVED = (
    Range(table="", field=name, lowest=0.0, highest=12.0)
    for name in ("loud", "resonant", "weak", "unsolved")
)
OWN = {("", name): 3.5 for name in ("loud", "resonant", "weak", "unsolved")}

GAIN = 10.0
"""Of the made-up radiation: the sources are heard beside unmodelled noise."""


def made_up(samples):
    """Mean squares of two bands at one microphone: smooth, sharp and weak changes in dB."""
    squares = []
    for sample in samples:
        at = {field: sample.get(("", field), 3.5) - 3.5 for _, field in OWN}
        sharp = 8.0 * np.exp(-((sample.get(("", "resonant"), 3.5) - 7.4) ** 2))
        gain = np.array([0.4 * at["loud"] + sharp, 0.02 * at["weak"] - 0.1 * at["loud"]])
        solved = at["unsolved"] < 5.0
        squares.append(10.0 ** (gain / 10.0)[None, None] if solved else None)
    return squares


@pytest.fixture(scope="module")
def chain():
    study = load_study(SOURCES_STUDY).replace({"uncertainty.random_samples": 8})
    chain = Chain(study, lambda study, *_: (made_up_modes(study, GAIN), False))
    for stage in applying(study):
        if stage.name not in ("stopping", "contributions", "scores"):
            chain = advanced(chain, stage)
    return chain


def test_changes_are_linear_between_nodes():
    nodes, change = np.array([1.0, 2.0, 6.0]), np.array([[0.0, 1.0], [2.0, 1.0], [6.0, -3.0]])
    np.testing.assert_allclose(change_at(1.5, nodes, change), [1.0, 1.0])
    np.testing.assert_allclose(change_at(3.0, nodes, change), [3.0, 0.0])
    np.testing.assert_allclose([change_at(one, nodes, change) for one in nodes], change)


def test_the_total_follows_from_the_energy_of_the_bands():
    found = total_change(np.array([50.0, 50.0]), np.array([10.0, 0.0]))
    assert found == pytest.approx(10.0 * np.log10((10.0 + 1.0) / 2.0))


def test_candidates_are_continuous_and_go_with_the_level_by_rank():
    generator = np.random.default_rng(2)
    fields = [f"p{number}" for number in range(MOST_CANDIDATES + 5)]
    ranges = [Range(table="", field=name, lowest=0.0, highest=1.0) for name in fields]
    ranges[2] = ranges[2].model_copy(update={"integer": True})
    values = generator.random((60, len(fields)))
    modelled = np.exp(-6.0 * values[:, 4]) + 1e-6 * values[:, 2]
    modelled[0] = np.nan
    samples = [{("", name): v for name, v in zip(fields, row, strict=True)} for row in values]
    found = [limits.field for limits in candidates(ranges, modelled, samples)]
    assert found[0] == "p4"
    assert "p2" not in found
    assert len(found) == MOST_CANDIDATES


def test_sliders_move_the_level_and_can_be_interpolated():
    sliders = chosen_sliders([WEAK, RESONANT, UNSOLVED, LOUD], OWN, 0, made_up)
    (loud,) = sliders
    assert loud.limits.field == "loud"
    assert loud.nodes.size == NODES + 1
    np.testing.assert_allclose(loud.nodes, sorted([0.0, 2.0, 3.5, 4.0, 6.0, 8.0, 10.0, 12.0]))
    np.testing.assert_allclose(loud.change_db[:, 0, 0], 0.4 * (loud.nodes - 3.5), atol=1e-9)
    assert loud.error_db < 1e-9  # straight in dB by band


def test_the_error_of_a_slider_is_that_halfway_between_its_nodes():
    def curved(samples):
        at = [sample.get(("", "loud"), 3.5) for sample in samples]
        return [10.0 ** (np.array([[[0.02 * one**2]]]) / 10.0) for one in at]

    (slider,) = chosen_sliders([LOUD], OWN, 0, curved)
    assert slider.error_db == pytest.approx(0.02 * 1.0**2)  # h²/4 of a parabola, h = 2


def test_added_changes_are_compared_with_those_of_all_at_once():
    other = LOUD.model_copy(update={"field": "other"})

    def product(samples):
        squares = []
        for sample in samples:
            one, two = (sample.get(("", name), 3.5) - 3.5 for name in ("loud", "other"))
            change = np.array([0.3 * one, 0.2 * two]) + 0.01 * one * two
            squares.append(10.0 ** (change / 10.0)[None, None])
        return squares

    own = {**OWN, ("", "other"): 3.5}
    sliders = chosen_sliders([LOUD, other], own, 0, product)
    coords = {"speed": [2900.0], "option": ["none"], "receiver": ["front"]}

    def filled(samples):
        """With the number of bands of the vocabulary, others silent."""
        return [np.pad(one, ((0, 0), (0, 0), (0, 32))) for one in product(samples)]

    wide = chosen_sliders([LOUD, other], own, 0, filled)
    results = slider_variables(wide, 6, filled, coords)
    assert results["slider"].values.tolist() == [".loud", ".other", HOOD]
    setting = results["slider_setting_value"].values - [3.5, 3.5, 0.0]
    together = 0.01 * setting[:, 0] * setting[:, 1]
    alone = 10.0 ** (setting[:, :2] * [0.3, 0.2] / 10.0)
    expected = 10.0 * np.log10(alone.mean(axis=1))
    np.testing.assert_allclose(
        results["slider_setting_change"].values[:, 0, 0], expected + together, atol=1e-6
    )
    error = float(results["slider_addition_error"].values[0, 0])
    factor = 1.959964 * np.sqrt(20.0 / 10.850811)  # 5 % of chi squared with 20 degrees of freedom
    assert error == pytest.approx(factor * np.sqrt(np.mean(together**2)), rel=1e-5)
    assert len(sliders) == 2


def test_a_hood_takes_the_same_from_all_bands(chain):
    hood = chain.results.sel(slider=HOOD)
    loss = hood["slider_value"].values
    assert (loss[0], loss[-1]) == (0.0, 20.0)
    np.testing.assert_allclose(hood["slider_total_change"].values[:, 0], -loss, atol=1e-9)


def test_sliders_begin_at_the_representative_sample(chain):
    results = chain.results
    own = results["level_total_by_sample"].isel(sample=nearest_row(results), speed=0)
    bands = results["slider_band_level"]
    total = 10.0 * np.log10((10.0 ** (bands / 10.0)).sum("noise_band"))
    for option in results["option"].values:
        np.testing.assert_allclose(total.sel(option=option), own.sel(option=option), atol=1e-5)
    names = results["slider"].values[:-1]
    assert len(names) >= 3
    for name in names:
        at = results.sel(slider=name)
        value = float(results["representative_value"].sel(uncertain_parameter=name))
        node = np.flatnonzero(at["slider_value"].values == value)
        assert not np.any(at["slider_band_change"].values[node])
        assert np.ptp(at["slider_total_change"].sel(receiver="front_1m").values) >= LEAST_DB - 0.01


def chain_total(chain, changed):
    """A-weighted level without an option of the representative sample with other values, dB(A).

    By the lines and noise of the sampled chain, not by pairs of sources.
    """
    chosen, evidence, ensemble = chain[Representative], chain[Evidence], chain[PriorEnsemble]
    study, axes, full = chain.study, chain[NominalSound].axes, with_published(chain)
    sample = {**chosen.sample, **changed}
    key = study.catalogue_case
    received = full[Transmission].received(full.at(sample)[Cases])
    batch, number = ensemble.batch, chosen.number
    pairs = evidence.pairs_of(batch.sounds[number], batch.machines[number], number)
    one = slice(chosen.pair, chosen.pair + 1)
    gains = pairs.discrepancy.some(one).gains(by_source(study, axes, received))
    lines = lines_of(received[key], gains[key], 1).weighted[0, :, 1]
    machine = with_sample(study.machine, study.machine, sample)
    noise = evidence.unmodelled_pa2(pairs, machine)[chosen.pair]
    rest = remaining(study, axes, machine, noise)
    at = axes.speeds.index(key[0]), axes.options.index(key[1]), 0
    return 10.0 * np.log10((lines + rest[at].sum()) / 4e-10)


def interpolated(results, setting):
    """Change of the level without an option by values of sliders, by numpy's interpolation."""
    change = np.zeros(results["slider_band_level"].sel(option="none").shape)
    for name, value in setting.items():
        at = results.sel(slider=name)
        nodes, table = at["slider_value"].values, at["slider_band_change"].values
        weight = np.array([np.interp(value, nodes, row) for row in np.eye(nodes.size)])
        change += np.tensordot(weight, table, axes=1)
    bands = results["slider_band_level"].sel(option="none").values
    after, before = (10.0 ** (one / 10.0) for one in (bands + change, bands))
    return 10.0 * np.log10(after.sum(axis=-1) / before.sum(axis=-1))


def random_settings(chain, count, seed):
    names = [str(name) for name in chain.results["slider"].values[:-1]]
    ranges = {limits.name: limits for limits in chain.study.ranges}
    generator = np.random.default_rng(seed)
    return [
        {name: sample_at([ranges[name]], generator.random(1)) for name in names}
        for _ in range(count)
    ]


def test_one_slider_is_within_half_a_decibel_of_the_chain(chain):
    before = chain_total(chain, {})
    for setting in random_settings(chain, 3, seed=11):
        for name, sample in setting.items():
            (value,) = sample.values()
            expected = (chain_total(chain, sample) - before)[0]
            found = interpolated(chain.results, {name: value})[0]
            assert found == pytest.approx(expected, abs=LEAST_DB), (name, value)


def test_the_error_of_several_sliders_covers_new_settings(chain):
    before = chain_total(chain, {})
    error = chain.results["slider_addition_error"].sel(option="none").values
    covered = 0
    for setting in random_settings(chain, SETTINGS, seed=12):
        together = {key: value for sample in setting.values() for key, value in sample.items()}
        values = {name: next(iter(sample.values())) for name, sample in setting.items()}
        difference = interpolated(chain.results, values) - (chain_total(chain, together) - before)
        covered += abs(difference[0]) <= error[0] + 0.01
    assert covered >= 18


def test_a_sample_without_solution_gives_no_sliders():
    assert chosen_sliders([LOUD], OWN, 0, lambda samples: [None for _ in samples]) == []
    results = slider_variables([], 6, lambda samples: [None for _ in samples], {})
    assert not results


def test_silent_bands_have_finite_levels():
    found = band_levels(np.array([1.0, 0.0]) * 4e-10)
    np.testing.assert_allclose(found, [0.0, -90.0], atol=1e-9)
