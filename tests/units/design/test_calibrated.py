"""Designs over the weighted samples of a machine agree with runs of the same options."""

import re

import numpy as np
import pytest
from design_studies import design_table, study_with
from sources_study import SOURCES_STUDY, made_up_modes
from support import made_up_radiation

from vibroacoustics import report
from vibroacoustics.base.constants import REFERENCE_PRESSURE_PA
from vibroacoustics.base.decibel import mean_square_level
from vibroacoustics.base.quantiles import weighted_quantiles
from vibroacoustics.base.vocabulary import WEIGHTINGS
from vibroacoustics.design.engine.needs import Need
from vibroacoustics.design.optimising import optimise
from vibroacoustics.design.problem import Problem
from vibroacoustics.design.total_change import lowering_words
from vibroacoustics.levels.nominal import NominalSound, by_source
from vibroacoustics.levels.sample_levels import lines_of
from vibroacoustics.machine.cases import Cases
from vibroacoustics.pipeline import run
from vibroacoustics.pipeline.study import chain_with
from vibroacoustics.results.estimates import QUANTILES, estimate
from vibroacoustics.transfer.contributions import Transmission
from vibroacoustics.uncertainty.discrepancy import Discrepancy
from vibroacoustics.uncertainty.sampled_cases import sampled_cases

ONE_MICROPHONE = {"receivers.left_1m": None}
SHARE = {"options.counterweight-half.share_ratio": "range = [0, 1]"}
MORE = """
[design.objectives.change]
figure = "total_change_db"

[design.objectives.total]
figure = "level_total_dba"

[design.objectives.order]
figure = "order_level_db"

[design.objectives.audibility]
figure = "audibility_db"

[design.objectives.feet]
figure = "foot_force_n"

[design.objectives.force]
figure = "force_n"
"""
VARIABLES = ("level_modelled", "change_total", "level_total", "order_level", "decisive_audibility",
             "largest_foot_force", "force_amplitude")  # fmt: skip
CLOSE_DB = 1e-5
"""Levels by order are kept in single precision."""


def radiation(study, *_):
    return made_up_modes(study), False


def calibrated(variables, option='"counterweight-half"', more=MORE):
    """The made-up sources with a table of designs and one microphone."""
    return study_with(design_table(option, variables) + more, SOURCES_STUDY).replace(ONE_MICROPHONE)


@pytest.fixture(scope="module")
def results():
    return run(calibrated(SHARE), radiation=radiation)


@pytest.fixture(scope="module")
def problem():
    return Problem(calibrated(SHARE), radiation)


def intervals(problem, designs):
    """Low end, median and high end of every wanted value of the first design."""
    samples = problem.samples()
    by_sample = problem.by_sample(designs, samples)[0]
    shares = (QUANTILES[0], 0.5, QUANTILES[1])
    return weighted_quantiles(by_sample, problem.weight(samples), shares)


def expected(results, option):
    """The same of a run."""
    at = {"speed": 2900.0, "option": option, "receiver": "front_1m", "order": 1}
    weightings = {"level_modelled": "A", "order_level": "Z"}
    each = [estimate(results, name, **at, weighting=weightings.get(name)) for name in VARIABLES]
    return np.array(each).T


@pytest.mark.slow
def test_estimates_of_an_option_are_those_of_its_run(problem, results):
    ends = intervals(problem, np.array([[0.5]]))
    of_run = expected(results, "counterweight-half")
    assert problem.is_sampled
    assert problem.is_linear
    assert of_run[2, 1] - of_run[0, 1] > 100.0 * CLOSE_DB  # the interval of the change is one
    levels = slice(0, 5)  # forces have a weight by sample in the run, and by pair here
    assert np.abs(ends - of_run)[:, levels].max() < CLOSE_DB, ends - of_run


@pytest.mark.slow
def test_values_are_medians_and_those_without_an_option_too(problem, results):
    values = problem.evaluate(np.array([[0.5]])).values[0]
    np.testing.assert_allclose(values, expected(results, "counterweight-half")[1], rtol=1e-5)
    np.testing.assert_allclose(
        problem.without_option(), expected(results, "none")[1], rtol=1e-5, atol=CLOSE_DB
    )


MOUNTS = {"machine.mounts.vertical_stiffness_n_per_mm": "range = [5, 50]"}


SHELL = {
    "machine.structure.thickness_mm": "range = [3.0, 3.6]",
    "machine.structure.loss_factor_ratio": "range = [0.005, 0.03]",
    "machine.gas.equalisation_angle_deg": "range = [10, 40]",
}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("variables", "design"),
    [(MOUNTS, [2e4]), (SHELL, [3.3e-3, 0.02, 0.5])],
    ids=["mounts", "shell and gas"],
)
def test_values_of_designs_take_the_place_of_sampled_ones(variables, design):
    """Against the stages of a run with the sample and the values of the design."""
    option = "counterweight-half"
    problem = Problem(calibrated(SHARE | variables), radiation)
    design, one = np.array([[0.3, *design]]), problem.machines[1]
    study = problem.space.study_of(design[0])
    sample = one.machine.without(problem.space.machine_values)
    changed = sound_of(study, sample)
    before = sound_of(problem.space.study, one.machine.values)[2900.0, "none"][1]
    parts = one.machine.deviation
    deviation = Discrepancy(parts.gain, parts.added, np.ones((len(parts.added), 1)))
    received, sound = changed[2900.0, option]
    gain = deviation.gains({(2900.0, option): sound, (2900.0, "none"): before})[2900.0, option]
    expected = lines_of(received, gain, 17)
    seen = one.engine.outcome(design).results
    np.testing.assert_allclose(
        seen[Need("sound")][0, :, 0], expected.weighted[..., WEIGHTINGS.index("A")], rtol=1e-9
    )
    order = mean_square_level(seen[Need("sound", 1)][0, :, 0], REFERENCE_PRESSURE_PA)
    np.testing.assert_allclose(order, expected.order[..., 1], rtol=0.0, atol=1e-8)


def sound_of(study, sample):
    """Sound of every case of a sample by the stages of a run: received, and by source."""
    chain = chain_with(study, NominalSound, radiation=radiation)
    cases = sampled_cases(chain[Cases], study, sample)
    received = chain[Transmission].received(cases)
    sounds = by_source(study, chain[NominalSound].axes, received)
    return {key: (received[key], sounds[key]) for key in received}


ONLY_TOTAL = """
[design.search]
population = 8
generations = 2
fresh_samples = 100
"""


@pytest.mark.slow
@pytest.mark.parametrize(("level_db", "is_said"), [(20.0, True), (1e-3, False)])
def test_no_best_designs_where_nothing_changes_the_total(problem, level_db, is_said):
    objective = design_table('"counterweight-half"', SHARE).replace("level_dba", "level_total_dba")
    study = study_with(objective + ONLY_TOTAL, SOURCES_STUDY).replace(
        {**ONE_MICROPHONE, "scoring.measurable.level_db": level_db}
    )
    search = optimise(study, radiation=radiation)
    words = search.attrs["no_change"]
    assert bool(words) == is_said
    analysis = report.analysis_of_designs(search)
    assert ("Nothing in this space" in analysis.text()) == is_said
    assert ("best.csv" not in analysis.tables) == is_said
    page = analysis.html().decode()
    assert ("Nothing in this space changes the total by 20 dB" in page) == is_said
    assert ("The best few designs" in page) != is_said
    if is_said:
        largest = float(words.rpartition(": ")[2].removesuffix(" dB)"))
        changes = problem.evaluate(np.linspace(0.0, 1.0, 201)[:, None]).values[:, 1]
        assert largest == pytest.approx(changes[np.argmax(np.abs(changes))], rel=0.05)
    assert "medians over" in search.attrs["method"]
    lowering = search.attrs["lowering"]
    assert "lowers the total by 3 dB(A) with 90 % confidence" in lowering
    assert f"{lowering[:1].upper()}{lowering[1:]}." in page
    by_sample = problem.by_sample(np.linspace(0.0, 1.0, 201)[:, None], problem.samples())[..., 1]
    weight = problem.weight(problem.samples())
    median, confident = weighted_quantiles(by_sample.T, weight, (0.5, 0.9))
    numbers = [float(number) for number in re.findall(r"([+-][\d.e-]+) dB", lowering)]
    best = int(np.argmin(median))
    assert numbers[0] == pytest.approx(median[best], rel=0.06, abs=2e-3)
    assert numbers[1] == pytest.approx(confident[best], rel=0.3, abs=5e-3)


@pytest.mark.slow
def test_the_first_design_that_lowers_the_total_surely_is_named(problem):
    designs = np.array([[0.1], [0.2], [0.3]])
    changes = np.array([[[-5.0, -2.9], [np.nan, np.nan], [-4.0, -3.1]]])
    words = lowering_words(problem, designs, changes)
    assert "share_ratio = 0.3 is the first design that lowers the total by 3 dB(A)" in words
    assert words.endswith("with 90 % confidence: median -4.0 dB")
    none = lowering_words(problem, designs[:2], changes[:, :2])
    assert none.startswith("none of 2 designs lowers the total by 3 dB(A) with 90 % confidence")
    assert none.endswith("-5 dB in the median, -2.9 dB or lower with 90 % confidence")
    assert lowering_words(problem, designs, None) == ""


def test_a_study_without_uncertainty_says_that_its_machine_is_nominal():
    study = study_with(design_table('"counterweight-half"', SHARE) + ONLY_TOTAL)
    search = optimise(study, radiation=made_up_radiation)
    analysis = report.analysis_of_designs(search)
    assert analysis.text().count("nominal machine") == 1
    assert "95 % limits" in analysis.html().decode()


@pytest.mark.slow
def test_changes_are_against_the_same_samples_and_pieces(problem):
    """A design that changes nothing has no change in any sample; 0 % of a counterweight is none."""
    changes = problem.by_sample(np.array([[0.0]]), problem.samples())[0, :, 1]
    assert np.abs(changes).max() < 1e-9


@pytest.mark.slow
def test_tolerances_that_no_design_chooses_are_those_of_the_reference_too():
    tolerances = (
        '[design.tolerances]\n"machine.mounts.vertical_stiffness_n_per_mm" = { ratio = 0.2 }\n'
    )
    problem = Problem(calibrated(SHARE, more=MORE + tolerances), radiation)
    values = problem.by_sample(np.array([[0.0]]), problem.samples())[0]
    assert np.abs(values[:, 1]).max() < 1e-9
    assert np.ptp(values[:, 4]) > 0.0  # the feet feel the mounts
