"""Loudness and audibility of designs agree with runs, and give a front with level and mass."""

import numpy as np
import pytest
from design_studies import WEIGHT, design_table, study_with
from support import PIPELINES

import vibroacoustics as va
from vibroacoustics.design.engine.hearing import loudness_sone
from vibroacoustics.design.problem import Problem
from vibroacoustics.design.search.front import nondominated
from vibroacoustics.results.estimates import nominal_values

CLOSE = 1e-9
"""Engine and run share their formulas: what differs is rounding."""
REFITTED = 1e-6
"""A run on other mounts also has other unmodelled noise: what they leave of the published level."""
VARIABLES = {
    "options.weight.mass_g": "range = [1, 100]",
    "options.weight.angle_deg": "range = [-180, 180]",
}
MOUNTS = {"machine.mounts.vertical_stiffness_n_per_mm": "range = [5, 50]"}
MORE = """
[design.objectives.loudness]
figure = "loudness_sone"

[design.objectives.tone]
figure = "audibility_db"
receivers = "worst"

[design.objectives.mass]
figure = "added_mass_kg"
"""


def problem_of(variables):
    """Counterweights at shaft frequencies above 90 Hz, and radiation that makes 1x audible."""
    table = design_table('"weight"', variables) + MORE
    study = study_with(WEIGHT + table, PIPELINES / "copeland_thesis.toml")
    others = {f"options.{name}": None for name in study.options if name not in ("none", "weight")}
    study = study.replace({
        **others,
        "scoring.published_table": None,
        "evidence": None,
        "operation.speed_rpm": [6000.0, 7200.0],
        "operation.maximum_order": 12,
    })  # fmt: skip
    hertz = np.arange(25.0, study.radiation.maximum_frequency_hz + 1.0, 25.0)
    parts = np.random.default_rng(3).standard_normal((2, len(study.receivers), 6, 1))
    vectors = 0.002 * (parts[0] + 1j * parts[1]) * hertz
    radiation = va.given_radiation(vectors, hertz)
    return Problem(study, radiation), radiation


@pytest.mark.parametrize(
    ("variables", "close"),
    [(VARIABLES, CLOSE), (VARIABLES | MOUNTS, REFITTED)],
    ids=["fixed", "free"],
)
def test_values_are_those_of_a_run(variables, close):
    problem, radiation = problem_of(variables)
    designs = problem.space.sample("sobol", 4)
    values = problem.evaluate(designs).values
    assert problem.is_linear
    for design, (_, loudness, audibility, _) in zip(designs[1:3], values[1:3], strict=True):
        run = va.run(problem.study.replace(problem.space.written(design)), radiation=radiation)
        results = nominal_values(run).sel(option="weight")
        sone = results["loudness"].mean("receiver").max("speed").item()
        assert loudness == pytest.approx(sone, rel=close)
        decisive = results["decisive_audibility"].max().item()
        assert decisive > -10.0  # a tone is rated
        assert audibility == pytest.approx(decisive, rel=1e-6)


def test_front_of_level_loudness_audibility_and_mass():
    problem, _ = problem_of(VARIABLES)
    objectives = problem.evaluate(problem.space.sample("sobol", 2048)).objectives
    front = objectives[nondominated(objectives)]
    assert 5 < len(front) < 500
    lightest = front[np.argmin(front[:, 3])]
    assert lightest[3] == objectives[:, 3].min()
    assert np.ptp(objectives[:, 1]) > 0.1  # sone
    assert np.ptp(objectives[:, 2]) > 10.0  # dB


def test_a_sound_too_loud_for_the_standard_has_no_loudness():
    level_db = np.full((3, 28), 40.0)
    level_db[1, 3] = 121.0
    square = 4e-10 * 10.0 ** (level_db / 10.0)
    loud = loudness_sone(square)
    assert np.isfinite(loud).tolist() == [True, False, True]
    with pytest.raises(va.ParameterError, match="holds up to 120 dB"):
        loudness_sone(square[1:2])
