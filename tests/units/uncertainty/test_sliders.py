"""Sliders: choice of parameters, interpolation and addition, agreement with the chain."""

import numpy as np
import pytest
from sources_study import SOURCES_STUDY, made_up_modes, run_made_up

from vibroacoustics.levels.changes import change_at, total_change
from vibroacoustics.levels.nominal import NominalSound, by_source
from vibroacoustics.levels.remainder import remaining
from vibroacoustics.levels.sample_levels import lines_of
from vibroacoustics.machine.cases import Cases
from vibroacoustics.stages.chain import Chain
from vibroacoustics.stages.forces import with_published
from vibroacoustics.stages.stage import advanced, applying
from vibroacoustics.study.loading import load_study
from vibroacoustics.study.samples import with_sample
from vibroacoustics.study.sampling import sample_at
from vibroacoustics.study.uncertainty import Range
from vibroacoustics.transfer.contributions import Transmission
from vibroacoustics.uncertainty.alternative_sounds import ComputedSamples
from vibroacoustics.uncertainty.evidence import Evidence
from vibroacoustics.uncertainty.prior_ensemble import PriorEnsemble
from vibroacoustics.uncertainty.slider_variables import HOOD, slider_variables
from vibroacoustics.uncertainty.sliders import (
    LEAST_DB,
    MOST_CANDIDATES,
    MOST_ERROR_DB,
    NODES,
    TRIED,
    band_levels,
    candidates,
    chosen_sliders,
    spread_pairs,
)

LOUD, RESONANT, WEAK, UNSOLVED = (
    Range(table="", field=name, lowest=0.0, highest=12.0)
    for name in ("loud", "resonant", "weak", "unsolved")
)
OWN = (3.5, 5.0, 2.0)
"""Values of all parameters in each sample."""

GAIN = 10.0
"""Of the made-up radiation: the sources are heard beside unmodelled noise."""


def made_up(settings):
    """Mean squares of two bands at one microphone: smooth, sharp and weak changes in dB."""
    squares = []
    for number, values in settings:
        at = {
            name: values.get(("", name), OWN[number])
            for name in ("loud", "resonant", "weak", "unsolved")
        }
        sharp = 8.0 * np.exp(-((at["resonant"] - 7.4) ** 2))
        gain = np.array([0.4 * at["loud"] + sharp, 0.02 * at["weak"] - 0.1 * at["loud"]])
        solved = at["unsolved"] < 8.0
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
    sliders = chosen_sliders([WEAK, RESONANT, UNSOLVED, LOUD], len(OWN), 0, made_up)
    (loud,) = sliders
    assert loud.limits.field == "loud"
    np.testing.assert_allclose(loud.nodes, np.linspace(0.0, 12.0, NODES))
    expected = 0.4 * (loud.nodes[:, None] - np.array(OWN))
    np.testing.assert_allclose(loud.change_db[:, :, 0, 0], expected, atol=1e-9)
    assert loud.error_db < 1e-9  # straight in dB by band


def test_the_error_of_a_slider_is_that_halfway_between_its_nodes():
    def curved(settings):
        at = [values.get(("", "loud"), OWN[number]) for number, values in settings]
        return [10.0 ** (np.array([[[0.02 * one**2]]]) / 10.0) for one in at]

    (slider,) = chosen_sliders([LOUD], len(OWN), 0, curved)
    assert slider.error_db == pytest.approx(0.02 * 1.0**2)  # h²/4 of a parabola, h = 2


def test_added_changes_are_compared_with_those_of_all_at_once():
    other = LOUD.model_copy(update={"field": "other"})

    def product(settings):
        """With the number of bands of the vocabulary, others silent."""
        squares = []
        for number, values in settings:
            one, two = (values.get(("", name), OWN[number]) for name in ("loud", "other"))
            change = np.array([0.3 * one, 0.2 * two]) + 0.01 * one * two
            squares.append(np.pad(10.0 ** (change / 10.0), (0, 32))[None, None])
        return squares

    sliders = chosen_sliders([LOUD, other], len(OWN), 0, product)
    coords = {"speed": [2900.0], "option": ["none"], "receiver": ["front"]}
    starts = {".loud": 3.5, ".other": 3.5}
    results = slider_variables(sliders, starts, len(OWN), 6, product, coords)
    assert sorted(results["slider"].values) == [".loud", ".other", HOOD]
    own = np.array(OWN)[results["slider_setting_machine"].values - 1]
    at = dict(zip(results["slider"].values, results["slider_setting_value"].values.T, strict=True))
    one, two = at[".loud"], at[".other"]
    levels = np.array([[0.3 * x, 0.2 * y] + 0.01 * x * y for x, y in zip(one, two, strict=True)])
    before = np.array([[0.3 * x, 0.2 * x] + 0.01 * x**2 for x in own])
    total = [10.0 * np.log10(np.sum(10.0 ** (each / 10.0), axis=1)) for each in (levels, before)]
    np.testing.assert_allclose(
        results["slider_setting_change"].values[:, 0, 0], total[0] - total[1], atol=1e-6
    )
    # Each slider alone moves a band by 0.01 times the other's own value: their sum lacks a product.
    error = 0.01 * (one - own) * (two - own)
    factor = 1.959964 * np.sqrt(12.0 / 5.226029)  # 5 % of chi squared with 12 degrees of freedom
    expected = factor * np.sqrt(np.mean(error**2))
    assert float(results["slider_addition_error"].values[0, 0]) == pytest.approx(expected, rel=1e-5)


def test_the_change_is_the_median_of_the_samples_with_its_interval():
    (loud,) = chosen_sliders([LOUD], len(OWN), 0, made_up)

    def filled(settings):
        return [np.pad(one, ((0, 0), (0, 0), (0, 32))) for one in made_up(settings)]

    (loud,) = chosen_sliders([LOUD], len(OWN), 0, filled)
    coords = {"speed": [2900.0], "option": ["none"], "receiver": ["front"]}
    results = slider_variables([loud], {".loud": 3.5}, len(OWN), 6, filled, coords)
    squares = np.array([[filled([(n, {("", "loud"): value})])[0] for value in loud.nodes]
                        for n in range(len(OWN))])[:, :, 0, 0].sum(axis=-1)  # fmt: skip
    own = np.array([filled([(n, {})])[0].sum() for n in range(len(OWN))])
    change = 10.0 * np.log10(squares / own[:, None])
    for name, share in (("_10_percent", 0.1), ("", 0.5), ("_90_percent", 0.9)):
        found = results[f"slider_total_change{name}"].values[0, :, 0]
        np.testing.assert_allclose(found, np.quantile(change, share, axis=0), atol=1e-6)


def test_a_hood_takes_the_same_from_all_bands(chain):
    hood = chain.results.sel(slider=HOOD)
    loss = hood["slider_value"].values
    assert (loss[0], loss[-1]) == (0.0, 20.0)
    np.testing.assert_allclose(hood["slider_total_change"].values[:, 0], -loss, atol=1e-9)


def test_sliders_are_of_weighted_samples(chain):
    """Each sample's level is that of the run; they are in the order of the modelled level."""
    results = chain.results
    bands = results["slider_band_level"]
    total = 10.0 * np.log10((10.0 ** (bands / 10.0)).sum("noise_band")).isel(
        speed=0, missing_dims="ignore"
    )
    of_run = results["level_total_by_sample"].isel(speed=0)
    for machine in results["slider_machine"].values:
        one = total.sel(slider_machine=machine, drop=True).transpose("option", "receiver")
        distance = abs(of_run.transpose("sample", "option", "receiver") - one).max(
            ("option", "receiver")
        )
        assert float(distance.min()) < 1e-5
        assert float(results["sample_weight"][0, int(np.argmin(distance.values))]) > 0.0
    for name in results["slider"].values[:-1]:
        at = results.sel(slider=name)
        nodes = at["slider_value"].values
        assert nodes[0] <= float(at["slider_start"]) <= nodes[-1]
        swing = np.ptp(at["slider_band_change"].values, axis=0)
        assert swing.max() >= LEAST_DB - 0.01


def chain_total(chain, pair, changed):
    """A-weighted level without an option of a sample with other values, dB(A).

    By the lines and noise of the sampled chain, not by pairs of sources.
    """
    evidence, ensemble = chain[Evidence], chain[PriorEnsemble]
    study, axes, full = chain.study, chain[NominalSound].axes, with_published(chain)
    number, row = pair
    sample = {**ensemble.samples[number], **changed}
    key = study.catalogue_case
    received = full[Transmission].received(full.at(sample)[Cases])
    batch = ensemble.batch
    pairs = evidence.pairs_of(batch.sounds[number], batch.machines[number], number)
    gains = pairs.discrepancy.some(slice(row, row + 1)).gains(by_source(study, axes, received))
    lines = lines_of(received[key], gains[key], 1).weighted[0, :, 1]
    machine = with_sample(study.machine, study.machine, sample)
    rest = remaining(study, axes, machine, evidence.unmodelled_pa2(pairs, machine)[row])
    at = axes.speeds.index(key[0]), axes.options.index(key[1]), 0
    return 10.0 * np.log10((lines + rest[at].sum()) / 4e-10)


def pairs_of(chain):
    """Number and pair of each sample of the sliders."""
    chosen = spread_pairs(chain.results, chain.study.uncertainty.random_samples)
    return [(chain[ComputedSamples].numbers[row], pair) for row, pair in chosen]


def interpolated(results, machine, setting):
    """Change of the level of a sample without an option, by numpy's interpolation."""
    bands = results["slider_band_level"].sel(option="none").isel(slider_machine=machine)
    change = np.zeros(bands.shape)
    for name, value in setting.items():
        at = results.sel(slider=name)
        nodes = at["slider_value"].values
        table = at["slider_band_change"].isel(slider_machine=machine).values
        weight = np.array([np.interp(value, nodes, row) for row in np.eye(nodes.size)])
        change += np.tensordot(weight, table, axes=1)
    after, before = (10.0 ** (one / 10.0) for one in (bands.values + change, bands.values))
    return 10.0 * np.log10(after.sum(axis=-1) / before.sum(axis=-1))


def random_settings(chain, count, seed):
    names = [str(name) for name in chain.results["slider"].values[:-1]]
    ranges = {limits.name: limits for limits in chain.study.ranges}
    generator = np.random.default_rng(seed)
    return [
        {name: sample_at([ranges[name]], generator.random(1)) for name in names}
        for _ in range(count)
    ]


def test_one_slider_is_within_a_decibel_of_the_chain(chain):
    """In the two samples with which its error was found."""
    for machine, pair in enumerate(pairs_of(chain)[:TRIED]):
        before = chain_total(chain, pair, {})
        for setting in random_settings(chain, 2, seed=11):
            for name, sample in setting.items():
                (value,) = sample.values()
                expected = (chain_total(chain, pair, sample) - before)[0]
                found = interpolated(chain.results, machine, {name: value})[0]
                assert found == pytest.approx(expected, abs=MOST_ERROR_DB), (name, value)


def test_the_error_of_several_sliders_covers_new_settings(chain):
    error = chain.results["slider_addition_error"].sel(option="none").values
    pairs, covered = pairs_of(chain), 0
    for number, setting in enumerate(random_settings(chain, 12, seed=12)):
        machine = number % len(pairs)
        together = {key: value for sample in setting.values() for key, value in sample.items()}
        values = {name: next(iter(sample.values())) for name, sample in setting.items()}
        before, after = (chain_total(chain, pairs[machine], each) for each in ({}, together))
        difference = interpolated(chain.results, machine, values) - (after - before)
        covered += abs(difference[0]) <= error[0] + 0.01
    assert covered >= 10


@pytest.mark.long
def test_the_band_of_a_slider_holds_redesigns_of_another_run():
    """The same change as an option, in samples of another seed: 16 of 20 medians at least."""
    study = load_study(SOURCES_STUDY).replace({"uncertainty.random_samples": 40})
    results = run_made_up(study, GAIN)
    ranges = {limits.name: limits for limits in study.ranges}
    generator = np.random.default_rng(3)
    names = [str(name) for name in results["slider"].values[:-1]]
    tried = [names[number % len(names)] for number in range(20)]
    values = [next(iter(sample_at([ranges[name]], generator.random(1)).values())) for name in tried]
    others = {f"options.{name}": None for name in study.options if name != "none"}
    options = {}
    for number, (name, value) in enumerate(zip(tried, values, strict=True)):
        *tables, field = name.split(".")
        change = {field: {"value": value, "source": "tried"}}
        for table in reversed(tables):
            change = {table: change}
        options[f"options.x{number}"] = {"kind": "redesign", "change": change}
    other = study.replace({**options, **others, "uncertainty.seed": 91})
    run, inside = run_made_up(other, GAIN), 0
    for number, (name, value) in enumerate(zip(tried, values, strict=True)):
        at = results.sel(slider=name, receiver="front_1m")
        low, high = (
            np.interp(value, at["slider_value"], at[f"slider_total_change_{end}_percent"])
            for end in (10, 90)
        )
        error = float(at["slider_interpolation_error"])
        found = float(run["change_total"].sel(option=f"x{number}", receiver="front_1m").item())
        inside += low - error <= found <= high + error
    assert inside >= 16


def test_a_sample_without_solution_gives_no_sliders():
    def none(settings):
        return [None for _ in settings]

    assert chosen_sliders([LOUD], 3, 0, none) == []
    assert not slider_variables([], {}, 3, 6, none, {})


def test_silent_bands_have_finite_levels():
    found = band_levels(np.array([1.0, 0.0]) * 4e-10)
    np.testing.assert_allclose(found, [0.0, -90.0], atol=1e-9)
