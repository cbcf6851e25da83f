"""Loads and paths of designs are computed once per values that they read; products are runs."""

from itertools import product

import numpy as np
import pytest
from design_studies import NEEDS, design_table, engine_of, study_with
from pydantic import PrivateAttr
from sources_study import SOURCES_STUDY, made_up_modes

import vibroacoustics as va
from vibroacoustics.base.constants import REFERENCE_PRESSURE_PA
from vibroacoustics.base.decibel import mean_square_level
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.design.engine.contraction import keeps_values
from vibroacoustics.design.engine.memo import Budget, Memo
from vibroacoustics.design.engine.needs import Need
from vibroacoustics.design.engine.on_mounts import random_squares
from vibroacoustics.design.engine.sound_path import RandomResponse
from vibroacoustics.design.sweep_values import listed_grid
from vibroacoustics.levels.by_source import GAIN_BANDS
from vibroacoustics.levels.nominal import NominalSound
from vibroacoustics.pipeline.study import chain_with

CLOSE_DB = 1e-9
"""Products and runs sum in other orders: some hundred terms of 1e-16, with cancellation."""
SOUND = Need("sound")
GAS = "machine.gas.equalisation_angle_deg"
SHELL = {
    "machine.structure.thickness_mm": "list = [3.0, 3.4]",
    "machine.structure.loss_factor_ratio": "list = [0.01, 0.02, 0.03]",
}
SOURCES = {
    "machine.keys.clearance_um": "list = [10.0, 30.0]",
    GAS: "list = [10.0, 30.0]",
}
SHARE = {"options.counterweight-half.share_ratio": "range = [0, 1], points = 40"}
OPTION = "counterweight-half"


class Counted:
    """Made-up radiation that is counted."""

    def __init__(self):
        self.number = 0

    def __call__(self, study, *_):
        self.number += 1
        return made_up_modes(study), False


def engine_with(variables, needs=(SOUND,)):
    """Engine of designs of the made-up sources, and its radiation."""
    study = study_with(design_table(f'"{OPTION}"', variables), SOURCES_STUDY)
    radiation = Counted()
    return engine_of(study, needs, radiation), study, radiation


def level_of_run(engine, study, design):
    """Levels by microphone of the stages of a run, dB(A)."""
    changed = study.replace(engine.space.written(design))
    radiation = Counted()
    level = chain_with(changed, NominalSound, radiation=radiation).results["level_modelled"]
    return level.sel(weighting="A", option=OPTION).values[0]


def largest_difference_db(engine, study, designs, seen):
    levels = mean_square_level(seen[SOUND][:, 0, 0], REFERENCE_PRESSURE_PA)
    runs = np.array([level_of_run(engine, study, design) for design in designs])
    return np.abs(levels - runs).max()


@pytest.mark.slow
def test_shells_and_sources_cost_their_sum():
    engine, study, radiation = engine_with(SHELL | SOURCES)
    contraction = engine.of_option(OPTION).contraction
    routes = engine.routes(OPTION)
    assert not any(route.linear for route in routes.values())
    known, radiated = contraction.loads.computed, radiation.number
    listing = listed_grid(engine.space.axes(), ())
    designs = listing.designs(np.arange(listing.count))
    outcome = engine.outcome(designs)
    assert len(designs) == 24
    assert not outcome.failed
    assert contraction.loads.computed - known == 4  # of the sources
    assert radiation.number - radiated == 2  # of the thicknesses; the loss changes no mode
    (paths,) = contraction._paths.values()
    assert paths.computed <= 6 + 1  # of the shells, and one that finds what they depend on
    rows = [0, 7, 14, 23]
    some = {SOUND: outcome.results[SOUND][rows]}
    assert largest_difference_db(engine, study, designs[rows], some) < CLOSE_DB
    assert np.ptp(outcome.results[SOUND], axis=0).min() > 0.0


@pytest.mark.slow
def test_counterweights_of_each_shell_and_source_are_fitted_once():
    engine, study, _ = engine_with({**SHELL, GAS: SOURCES[GAS], **SHARE}, (SOUND, *NEEDS[3:]))
    contraction = engine.of_option(OPTION).contraction
    linear = [route.linear for route in engine.routes(OPTION).values()]
    assert linear == [False, False, False, True]
    listing = listed_grid(engine.space.axes(), ())
    designs = listing.designs(np.arange(listing.count))
    assert len(designs) == 6 * 2 * 40
    known = contraction.loads.computed
    outcome = engine.outcome(designs)
    assert contraction.loads.computed - known < 2 * 40  # not those of six shells
    rows = [3, 250, 479]
    some = {SOUND: outcome.results[SOUND][rows]}
    assert largest_difference_db(engine, study, designs[rows], some) < CLOSE_DB


@pytest.mark.long
def test_fifty_random_designs_are_those_of_runs():
    variables = {
        "machine.structure.loss_factor_ratio": "range = [0.003, 0.03]",
        "machine.stator_yoke.loss_factor_ratio": "range = [0.01, 0.06]",
        "machine.keys.clearance_um": "range = [8, 40]",
        "machine.keys.friction_ratio": "range = [0.02, 0.15]",
        "machine.gas.polytropic_index": "range = [1.03, 1.16]",
        "machine.mounts.vertical_stiffness_n_per_mm": "range = [30, 100]",
        **SHARE,
    }
    engine, study, _ = engine_with(variables)
    designs = engine.space.sample("latin-hypercube", 50)
    outcome = engine.outcome(designs)
    assert largest_difference_db(engine, study, designs, outcome.results) < CLOSE_DB


def test_a_memo_computes_once_per_values_read_and_keeps_errors(monkeypatch):
    from vibroacoustics.base.field_reads import watched
    from vibroacoustics.machine.feet import Mounts

    names = ["pitch", "stiffness", "loss"]
    fields = ("pitch_m", "vertical_stiffness_n_per_m", "loss_factor_ratio")
    labels = {(field,): name for field, name in zip(fields, names, strict=True)}
    calls = []

    def study_of(design):
        values = dict(zip(fields, design.tolist(), strict=True))
        return watched(Mounts(lateral_stiffness_n_per_m=1e4, **values), labels)

    def compute(mounts):
        calls.append(mounts)
        if mounts.pitch_m > 0.25:
            raise ParameterError("too wide")
        if mounts.pitch_m > 0.15:  # reads more
            return np.float64(mounts.vertical_stiffness_n_per_m)
        return np.float64(0.0)

    memo = Memo(names, study_of, compute)
    axes = (0.1, 0.2), (0.1, 0.2, 0.3), (1e4, 2e4)
    designs = np.array([[pitch, stiffness, loss] for loss, pitch, stiffness in product(*axes)])
    results, number = memo.of_each(designs)
    values = [results[n] if isinstance(results[n], float) else np.nan for n in number]
    expected = [0.0, 0.0, 1e4, 2e4, np.nan, np.nan] * 2
    np.testing.assert_array_equal(values, expected)
    assert len(calls) == memo.computed == 4  # once for 0.1, twice for 0.2, once for 0.3
    assert memo.reads == [0, 1]
    with pytest.raises(ParameterError, match="too wide"):
        memo(designs[4])
    assert len(calls) == 4


def test_unwatched_values_count_as_read_and_a_refused_design_fails_alone():
    memo = Memo(["word"], lambda design: design[0], np.float64, unwatched=frozenset({0}))
    assert [memo(np.array([word])) for word in (1.0, 2.0)] == [1.0, 2.0]

    def refuses(design):
        if design[0] > 1.0:
            raise ParameterError("too large")
        return design[0]

    memo = Memo(["value"], refuses, lambda _: np.float64(0.0))
    results, of_row = memo.of_each(np.array([[2.0], [0.5]]))
    assert isinstance(results[of_row[0]], ParameterError)
    assert results[of_row[1]] == 0.0


def test_a_table_that_keeps_values_is_not_watched():
    """What it keeps may be used again without a read of the fields."""

    class Kept(va.Parameters):
        mass_kg: float
        _double: float = PrivateAttr(0.0)

        def model_post_init(self, _):
            self._double = 2.0 * self.mass_kg

    assert keeps_values(Kept(mass_kg=1.0))
    machine = va.load_study(SOURCES_STUDY).machine
    assert not keeps_values(machine)
    assert not keeps_values(machine.mounts)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("key", "values"),
    [
        ("machine.shell.outer_diameter_mm", [165.1, 180.0]),
        ("machine.variation.frequency_factor_ratio", [1.0, 1.2]),
    ],
)
def test_designs_of_one_engine_have_paths_of_their_own(key, values):
    engine, study, _ = engine_with({key: f"list = {values}"})
    designs = np.array([[value] for value in engine.space.variables[-1].values])
    outcome = engine.outcome(designs)
    assert not outcome.failed
    assert np.ptp(outcome.results[SOUND], axis=0).max() > 0.0
    assert largest_difference_db(engine, study, designs, outcome.results) < CLOSE_DB


def test_random_loads_add_by_source():
    """Against a loop, with two loads of other sizes and densities."""
    rng = np.random.default_rng(1)
    bands = len(GAIN_BANDS)
    loads = [
        RandomResponse(
            source, rng.random((lines, pairs, 3)) + 0j, rng.random((lines, bands)),
            rng.random((lines, bands)),
        )
        for source, lines, pairs in ((1, 4, 2), (0, 5, 1), (1, 2, 3))
    ]  # fmt: skip
    densities = rng.random((2, 4 * 2 + 5 + 2 * 3)) + 0j
    weighted, unweighted = random_squares(loads, densities, 2, 3)
    expected = np.zeros((2, 2, 2, 3, bands))
    first = 0
    for load in loads:
        lines, pairs, receivers = load.per_density.shape
        for design, line, pair, receiver in np.ndindex(2, lines, pairs, receivers):
            density = densities[design, first + line * pairs + pair].real
            square = density * load.per_density[line, pair, receiver].real
            for kind, band in enumerate((load.a_weight, load.member)):
                expected[kind, design, load.source, receiver] += square * band[line]
        first += lines * pairs
    np.testing.assert_allclose(weighted, expected[0], rtol=1e-12)
    np.testing.assert_allclose(unweighted, expected[1], rtol=1e-12)


def test_results_beyond_the_memory_are_let_go_oldest_first():
    budget, known, others = Budget(3 * 80), {}, {}
    for number in range(4):
        budget.keep(known if number % 2 else others, bytes([number]), np.zeros(10))
    assert (list(known), list(others)) == ([b"\x01", b"\x03"], [b"\x02"])
    budget.keep(known, b"large", np.zeros(100))
    assert (list(known), list(others)) == ([b"large"], [])
