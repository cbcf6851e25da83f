"""Counterweights of a study: the closed form of one, runs of several, bolt holes by trying all."""

from itertools import product

import numpy as np
import pytest
from support import PIPELINES, made_up_radiation

import vibroacoustics as va
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.design.balance import counterweights_of, influence_of_weights
from vibroacoustics.design.engine.sound_path import SoundPaths
from vibroacoustics.mechanics.balancing.moments import sums_of_squares
from vibroacoustics.mechanics.capabilities import OldhamRing
from vibroacoustics.results.estimates import nominal_values
from vibroacoustics.study.loading import load_study

BOTH = "upper + lower"
WEIGHT = {"kind": "counterweight", "mass_g": 10.0, "radius_mm": 20.0, "angle_deg": 25.0}


@pytest.fixture(scope="module")
def study():
    read = load_study(PIPELINES / "copeland_thesis.toml")
    return read.replace({
        **{f"options.{name}": None for name in read.options if name != "none"},
        "scoring.published_table": None,
        "evidence": None,
        "operation.speed_rpm": [2000.0, 2900.0],
        "operation.maximum_order": 3,
        "options.upper": {**WEIGHT, "height_mm": 60.0},
        "options.lower": {**WEIGHT, "height_mm": -60.0},
        f"options.{BOTH}": {},
    })  # fmt: skip


@pytest.mark.parametrize("speeds", ["worst", "all"])
def test_one_weight_is_the_half_counterweight(study, speeds):
    """A force along one line is half balanced: m r = m_ring r_ring / 2, at 180°."""
    best = va.balance(study, "upper", "force_n", speeds, radiation=made_up_radiation)
    ring = study.machine.require(OldhamRing)
    half = 0.5 * ring.mass_kg * ring.stroke_m
    assert abs(best.moment_kg_m[0]) == pytest.approx(half, rel=1e-6 if speeds == "worst" else 1e-9)
    np.testing.assert_allclose(best.after / best.before, np.sqrt(0.5), rtol=1e-6)


def levels(study, values):
    """Mean square pressure at 1x over the microphones, shape (speed,), Pa²."""
    changed = study.replace({**values, "options.upper": {}, "options.lower": {}})
    results = nominal_values(va.run(changed, radiation=made_up_radiation))
    level_db = results["order_level"].sel(option=BOTH, order=1, weighting="Z")
    return (4e-10 * 10.0 ** (level_db / 10.0)).mean("receiver").values


def test_pressure_after_balancing_is_that_of_a_run(study):
    best = va.balance(study, BOTH, "pressure_pa", radiation=made_up_radiation)
    square = levels(study, best.values)
    np.testing.assert_allclose(square, best.after**2, rtol=1e-5)  # levels in single precision


def test_bolt_holes_are_those_of_trying_all(study):
    masses_kg = [0.01, 0.02]
    holes = {"upper": (4, masses_kg), "lower": (3, masses_kg)}
    best = va.balance(study, BOTH, holes=holes, radiation=made_up_radiation)
    weights = counterweights_of(study, BOTH)
    rows = influence_of_weights(
        study, BOTH, weights, ("foot_force_n",), SoundPaths(made_up_radiation)
    )
    first = 0.02 * np.exp(1j * np.deg2rad(25.0))  # radius at the angle as given
    positions = [
        [first * mass_kg * np.exp(2j * np.pi * hole / count) for mass_kg in masses_kg for hole in
         range(count)] for count in (4, 3)
    ]  # fmt: skip
    worst = [sums_of_squares(*rows, np.array(each)).max() for each in product(*positions)]
    assert best.after.max() ** 2 == pytest.approx(min(worst), rel=1e-12)
    turned = (best.values["options.lower.angle_deg"] - 25.0) / 120.0
    assert turned == pytest.approx(round(turned), abs=1e-9)


def test_refusals_are_one_line(study):
    for option, figure, holes, words in (
        ("none", "force_n", None, "options.none: has no counterweight"),
        ("middle", "force_n", None, "option = middle: there is no such option"),
        (BOTH, "level_dba", None, "figure = level_dba: unknown; allowed force_n"),
        (BOTH, "force_n", {"upper": (3, [0.1])}, "holes.lower: give at least one hole"),
    ):
        with pytest.raises(ParameterError, match=words):
            va.balance(study, option, figure, holes=holes, radiation=made_up_radiation)
